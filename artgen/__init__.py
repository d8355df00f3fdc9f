"""artgen makes articulated objects from category rules: built, validated, rendered, packed."""

from artgen.core.blas import one_kernel

one_kernel()

__version__ = "0.1.0"
"""Stated here, where pyproject.toml reads it: render farms run this code without installing it."""
