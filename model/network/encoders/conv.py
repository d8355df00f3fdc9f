"""A small convolutional encoder that learns with the network; no weights from outside."""

from torch import Tensor, nn

WIDTHS = (24, 48, 64)
"""Channels after each halving."""
GROUP = 8
"""Channels normalized together."""


class ConvEncoder(nn.Module):
    """Three halvings, stride 8."""

    def __init__(self) -> None:
        super().__init__()
        self.dim, self.learned, self.identity = WIDTHS[-1], True, ""
        layers: list[nn.Module] = []
        for before, after in zip((3, *WIDTHS[:-1]), WIDTHS, strict=True):
            layers += [nn.Conv2d(before, after, 3, stride=2, padding=1)]
            layers += [nn.GroupNorm(after // GROUP, after), nn.GELU()]
        self.layers = nn.Sequential(*layers)

    def forward(self, frames_F3SS: Tensor) -> Tensor:
        """(F, 64, rows / 8, columns / 8)."""
        features: Tensor = self.layers(2.0 * frames_F3SS - 1.0)
        return features
