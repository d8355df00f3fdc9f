"""What an image encoder is, and the shell around one whose weights come from a file."""

from collections.abc import Sequence
from typing import Protocol

from torch import Tensor, nn


class Encoder(Protocol):
    """Feature maps of images.

    Attributes:
        dim: channels of the map.
        learned: whether its weights are learned with the network's; else they stay out of
            checkpoints.
        identity: name and sha256 of its weights; empty where nothing was loaded.
    """

    dim: int
    learned: bool
    identity: str

    def __call__(self, frames_F3SS: Tensor) -> Tensor:
        """(F, dim, rows, columns) of square sRGB images in [0, 1]."""
        ...


class Pretrained(nn.Module):
    """A network with weights of its own behind the colors it expects; always in evaluation mode."""

    def __init__(
        self,
        network: nn.Module,
        *,
        dim: int,
        mean: Sequence[float],
        deviation: Sequence[float],
        identity: str,
        frozen: bool,
    ) -> None:
        super().__init__()
        self.dim, self.learned, self.identity = dim, not frozen, identity
        self.network = network.requires_grad_(not frozen)
        self.mean, self.deviation = tuple(mean), tuple(deviation)
        self.eval()

    def forward(self, frames_F3SS: Tensor) -> Tensor:
        """(F, dim, rows, columns)."""
        mean = frames_F3SS.new_tensor(self.mean)[:, None, None]
        deviation = frames_F3SS.new_tensor(self.deviation)[:, None, None]
        features: Tensor = self.network((frames_F3SS - mean) / deviation)
        return features

    def train(self, mode: bool = True) -> "Pretrained":
        """Stay in evaluation mode: running means of few images would spoil the weights."""
        return super().train(False)
