"""Geometry keeps its digits whatever autocast does; numbers next to nothing cost no time."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import torch
from torch import Tensor


def full(tensor: Tensor) -> Tensor:
    """The same values as float32, or as float64 if they were."""
    return tensor if tensor.dtype == torch.float64 else tensor.float()


def full_precision(tensor: Tensor) -> torch.autocast:
    """A context without autocast on the tensor's device: matrix products stay exact to rounding."""
    return torch.autocast(tensor.device.type, enabled=False)


@contextmanager
def flushed_denormals() -> Iterator[None]:
    """Numbers below float32's normal range count as zero inside: tails of densities would slow a
    CPU down several times. It holds for the whole process, so only until the block ends.

    What numpy knows of its types is asked for before: it keeps the answer, and would warn of the
    least denormal number inside, where that is zero.
    """
    for kind in (np.float32, np.float64):
        np.finfo(kind)
    torch.set_flush_denormal(True)
    try:
        yield
    finally:
        torch.set_flush_denormal(False)
