"""Hexa-planes taught a field in closed form: what a trained network would give, without images."""

import torch
from torch import Tensor, nn

from artgen.core.stream import Stream
from model.config import FieldConfig
from model.field.analytic import BoxField
from model.field.plane_field import FieldHead, PlaneField

CONFIG = FieldConfig(hidden=64, layers=2, bias="smallest_side")
CHANNELS = 16
BATCH = 2048
"""Points of every part in a step; half of them the nearest to the surface of four times as many."""
RATE = 0.01


class Taught(nn.Module):
    """Planes and head after some steps of regression on distance and color."""

    def __init__(self, field: BoxField, plane_px: int, steps: int, stream: Stream) -> None:
        super().__init__()
        batch, parts = field.articulation.valid_BP.shape
        device = field.center_BPM3.device
        generator = torch.Generator().manual_seed(int(stream.generator().integers(2**31)))
        drawn = torch.randn(batch, parts, 6, CHANNELS, plane_px, plane_px, generator=generator)
        self.size_BP3 = field.articulation.size_BP3
        self.planes = nn.Parameter(0.1 * drawn.to(device))
        self.head = FieldHead(CONFIG, CHANNELS).to(device)
        for parameter in self.head.distance[:-1].parameters():
            _drawn_anew(parameter, generator)
        for parameter in self.head.color.parameters():
            _drawn_anew(parameter, generator)
        self._learn(field, steps, generator)

    def field(self) -> PlaneField:
        """The planes as a field."""
        return PlaneField(self.planes, self.size_BP3, self.head)

    def _learn(self, field: BoxField, steps: int, generator: torch.Generator) -> None:
        optimizer = torch.optim.Adam(self.parameters(), lr=RATE, betas=(0.9, 0.99))
        fading = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, steps)
        for _ in range(steps):
            points = _points(field, generator)
            distance, rgb = field(points)
            found, color = self.field()(points)
            near = torch.exp(-distance.abs() / 0.05)
            loss = ((found - distance).abs() * (0.1 + near)).mean()
            loss = loss + 0.1 * ((color - rgb).abs().mean(dim=-1) * near).mean()
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()
            fading.step()


def _drawn_anew(parameter: Tensor, generator: torch.Generator) -> None:
    """Weights that do not follow torch's global state."""
    with torch.no_grad():
        bound = parameter.shape[-1] ** -0.5
        drawn = torch.rand(parameter.shape, generator=generator) * 2.0 - 1.0
        parameter.copy_(bound * drawn if parameter.ndim > 1 else torch.zeros_like(parameter))


def _points(field: BoxField, generator: torch.Generator) -> Tensor:
    """(B, P, N, 3) coordinates of the boxes: half even, half near the surface."""
    batch, parts = field.articulation.valid_BP.shape
    drawn = torch.rand(batch, parts, 2 * BATCH, 3, generator=generator) * 2.0 - 1.0
    drawn = drawn.to(field.center_BPM3.device)
    nearest = field(drawn)[0].abs().argsort(dim=-1)[..., : BATCH // 2]
    near = torch.gather(drawn, 2, nearest[..., None].expand(-1, -1, -1, 3))
    return torch.cat([drawn[:, :, : BATCH // 2], near], dim=2)
