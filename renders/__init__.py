"""Code that plans, launches and collects renders; rendered output goes elsewhere."""

import artgen  # noqa: F401  # Before numpy is: artgen.core.blas.
