"""Feature maps of any architecture that timm knows, with weights from a file."""

from importlib import import_module
from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional

from artgen.core.errors import ModelError

FINEST, COARSEST = 8, 16
"""Maps of these strides are read, and the last one where there is none between them."""


class TimmMaps(nn.Module):
    """Some of a network's maps, together at the finest of their sizes."""

    def __init__(self, network: nn.Module, chosen: tuple[int, ...]) -> None:
        super().__init__()
        self.network, self.chosen = network, chosen

    def forward(self, frames_F3SS: Tensor) -> Tensor:
        """(F, dim, rows, columns)."""
        every = self.network(frames_F3SS)
        maps = [every[index] for index in self.chosen]
        size = max(m.shape[-2] for m in maps), max(m.shape[-1] for m in maps)
        resized = [functional.interpolate(m, size=size, mode="bilinear") for m in maps]
        return torch.cat(resized, dim=1)


def loaded(
    architecture: str, path: Path
) -> tuple[TimmMaps, int, tuple[float, ...], tuple[float, ...]]:
    """The network, its channels, and the mean and deviation of the colors it expects.

    Raises:
        ModelError: timm is absent or broken, or does not know the architecture, or the file does
            not fit.
    """
    try:
        timm = import_module("timm")
    except (ImportError, RuntimeError) as error:
        raise ModelError(
            f"timm: {error}; an encoder `timm:ARCHITECTURE:FILE` needs `pip install timm` with a "
            "torchvision made for this torch"
        ) from error
    try:
        network = timm.create_model(
            architecture, pretrained=False, features_only=True, checkpoint_path=str(path)
        )
    except (RuntimeError, KeyError, ValueError, OSError) as error:
        raise ModelError(f"timm, {architecture}, {path}: {error}") from error
    strides, channels = network.feature_info.reduction(), network.feature_info.channels()
    chosen = [k for k, stride in enumerate(strides) if FINEST <= stride <= COARSEST]
    chosen = chosen or [len(strides) - 1]
    colors = network.default_cfg
    return (
        TimmMaps(network, tuple(chosen)),
        sum(channels[k] for k in chosen),
        tuple(colors["mean"]),
        tuple(colors["std"]),
    )
