"""The only package that imports bpy; started as a process, imported by nobody."""

import artgen  # noqa: F401  # Before numpy is: artgen.core.blas.
