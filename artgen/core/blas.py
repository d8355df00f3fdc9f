"""One kernel for matrix products on every machine, so that a seed gives the same bits anywhere.

OpenBLAS, which numpy and scipy bring along, picks its kernels by the processor, and these differ in
the last bit of a product. A spring's stiffness is then another number, and where a cut is nearly
degenerate, so is the number of triangles. The kernel is chosen when numpy is loaded.
"""

import os
from pathlib import Path

VARIABLE = "OPENBLAS_CORETYPE"
KERNEL = "Haswell"
"""Of every x86-64 processor since 2013 that has AVX2 and fused multiply-adds."""
CPU = Path("/proc/cpuinfo")


def one_kernel() -> None:
    """Ask OpenBLAS for `KERNEL` where the processor can run it and nobody asked for another."""
    flags = set(CPU.read_text().split()) if CPU.is_file() else set()
    if {"avx2", "fma"} <= flags:
        os.environ.setdefault(VARIABLE, KERNEL)
