"""Plane tokens to hexa-planes: 24 rows in the trunk, 192 in the field.

B objects, P part slots, K = 6 * G * G plane tokens, G rows of a plane in the trunk, D channels
there, C features, S rows of a plane that come of one, H = W = G * S rows and columns of the
upsampled plane. Token (k, i, j) covers rows i S .. i S + S - 1 and columns j S .. j S + S - 1 of
plane k.
"""

import math

import torch
from torch import Tensor, nn

from model.config import ModelConfig, PlaneConfig
from model.network.attention import norm
from model.network.tokens import PLANES


class PlaneHead(nn.Module):
    """The six upsampled planes of every slot."""

    def __init__(self, config: ModelConfig, planes: PlaneConfig) -> None:
        super().__init__()
        self.grid = planes.grid
        width = config.trunk.width
        self.norm = norm(width)
        self.blow_up: nn.Linear | None = None
        if planes.tokens == "one":
            self.blow_up = nn.Linear(width, PLANES * planes.grid**2 * planes.channels)
            width = planes.channels
        self.upsample: nn.Module = UPSAMPLERS[planes.upsampler](width, planes)

    def forward(self, slot_BPD: Tensor, plane_BPKD: Tensor | None) -> Tensor:
        """(B, P, 6, C, H, W) out of a slot's vector or of its plane tokens."""
        if self.blow_up is not None:
            grids = self.blow_up(self.norm(slot_BPD))
        elif plane_BPKD is not None:
            grids = self.norm(plane_BPKD)
        else:
            raise TypeError("planes of slots without plane tokens")
        grids = grids.reshape(*slot_BPD.shape[:2], PLANES, self.grid, self.grid, -1)
        upsampled: Tensor = self.upsample(grids.flatten(0, 2).movedim(-1, 1))
        return torch.unflatten(upsampled, 0, (*slot_BPD.shape[:2], PLANES))


class LinearUpsample(nn.Module):
    """Each token becomes a patch of its plane by one matrix."""

    def __init__(self, width: int, planes: PlaneConfig) -> None:
        super().__init__()
        self.scale = planes.scale
        self.unfold = nn.Linear(width, planes.channels * planes.scale**2)

    def forward(self, grids_XDGG: Tensor) -> Tensor:
        """(X, C, G * scale, G * scale)."""
        patches = self.unfold(grids_XDGG.movedim(1, -1))
        tiles = torch.unflatten(patches, -1, (-1, self.scale, self.scale))
        return tiles.permute(0, 3, 1, 4, 2, 5).flatten(4, 5).flatten(2, 3)


class TransposedUpsample(nn.Module):
    """Transposed convolutions that double, without overlap, with a nonlinearity between."""

    def __init__(self, width: int, planes: PlaneConfig) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        for _ in range(int(math.log2(planes.scale)) or 1):
            stride = 2 if planes.scale > 1 else 1
            layers += [nn.ConvTranspose2d(width, planes.channels, stride, stride=stride), nn.GELU()]
            width = planes.channels
        self.layers = nn.Sequential(*layers[:-1])

    def forward(self, grids_XDGG: Tensor) -> Tensor:
        """(X, C, G * scale, G * scale)."""
        upsampled: Tensor = self.layers(grids_XDGG)
        return upsampled


UPSAMPLERS: dict[str, type[LinearUpsample] | type[TransposedUpsample]] = {
    "linear": LinearUpsample,
    "transposed": TransposedUpsample,
}
