"""Numbers next to nothing: gone within the block alone, and without a word from numpy."""

import subprocess
import sys

import torch

from model.precision import flushed_denormals

LEAST = 1e-40
"""Below 1.2e-38, where float32 keeps all its digits."""


def halved() -> float:
    return (torch.tensor(2.0 * LEAST) * 0.5).item()


def test_denormals_are_zero_inside_and_what_they_were_outside() -> None:
    assert halved() > 0.0
    with flushed_denormals():
        assert halved() == 0.0
    assert halved() > 0.0


def test_numpy_does_not_warn_of_its_types_inside() -> None:
    """It asks once a process, so this needs one of its own."""
    code = (
        "import numpy; from model.precision import flushed_denormals\n"
        "with flushed_denormals(): numpy.finfo(numpy.float32), numpy.finfo(numpy.float64)"
    )
    subprocess.run([sys.executable, "-W", "error::UserWarning", "-c", code], check=True)
