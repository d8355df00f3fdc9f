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
    if {"avx2", "fma"} <= _flags():
        os.environ.setdefault(VARIABLE, KERNEL)


def _flags() -> set[str]:
    """Of the first core: a server's file lists hundreds."""
    if not CPU.is_file():
        return set()
    with CPU.open() as lines:
        return set(next((line for line in lines if line.startswith("flags")), "").split())
