"""The ART application: the only package that imports torch."""

import artgen  # noqa: F401  # Before numpy is: artgen.core.blas.
