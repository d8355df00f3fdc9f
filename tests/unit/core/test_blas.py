"""Whatever machine it is, products of matrices have the bits of one kernel."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from artgen.core import blas

PRODUCTS = """
import hashlib
import numpy as np
rng = np.random.default_rng(0)
made = [rng.standard_normal((n, 7)) @ rng.standard_normal((7, n)) for n in (3, 4, 50)]
made.append(np.linalg.lstsq(made[2][:, :5], made[2][:, 5], rcond=None)[0])
print(hashlib.sha256(b"".join(one.tobytes() for one in made)).hexdigest())
"""


def digest(before: str, **asked: str) -> str:
    """Of some products, by a fresh process that runs `before` first."""
    env = {name: value for name, value in os.environ.items() if name != blas.VARIABLE} | asked
    done = subprocess.run(
        [sys.executable, "-c", before + PRODUCTS], env=env, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_importing_artgen_first_chooses_the_kernel() -> None:
    flags = blas.CPU.read_text().split() if blas.CPU.is_file() else []
    asked = {blas.VARIABLE: blas.KERNEL} if {"avx2", "fma"} <= set(flags) else {}
    assert digest("import artgen") == digest("", **asked)
    assert digest("import model") == digest("", **asked)


def test_who_asks_for_another_kernel_gets_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(blas.VARIABLE, "Zen")
    blas.one_kernel()
    assert os.environ[blas.VARIABLE] == "Zen"


def test_a_processor_without_it_is_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(blas.VARIABLE, raising=False)
    (tmp_path / "cpuinfo").write_text("flags : fpu sse2 avx\n")
    for place in ("cpuinfo", "absent"):
        monkeypatch.setattr(blas, "CPU", tmp_path / place)
        blas.one_kernel()
        assert blas.VARIABLE not in os.environ
    (tmp_path / "cpuinfo").write_text("flags : fpu avx2 fma\n")
    monkeypatch.setattr(blas, "CPU", tmp_path / "cpuinfo")
    blas.one_kernel()
    assert os.environ[blas.VARIABLE] == blas.KERNEL
