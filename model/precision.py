"""Geometry keeps its digits: no reduced precision inside, whatever autocast surrounds it."""

import torch
from torch import Tensor


def full(tensor: Tensor) -> Tensor:
    """The same values as float32, or as float64 if they were."""
    return tensor if tensor.dtype == torch.float64 else tensor.float()


def full_precision(tensor: Tensor) -> torch.autocast:
    """A context without autocast on the tensor's device: matrix products stay exact to rounding."""
    return torch.autocast(tensor.device.type, enabled=False)
