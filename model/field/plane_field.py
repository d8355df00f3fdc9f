"""The shape and color of parts: a field in the coordinates of their boxes, and ART's, on planes.

ART, supplement, S2: signed distance = network(features) + bias, where the bias makes every part
begin as a ball.

Letters: B objects, P parts, C channels, H W rows and columns of a plane, K segments (runs of points
in one part's box), N points, digits a length. Distances in radii, negative inside.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol, runtime_checkable

import torch
from torch import Tensor, nn

from model.config import FieldConfig, SphereBias
from model.field.hexaplane import read, stacked
from model.field.ragged import ragged
from model.field.rays import Growth, half_sides
from model.precision import full

PAPER_RADIUS = 0.1
"""Radius of the ball that a part begins as, radii (S2)."""
NORMALIZED_RADIUS = 0.5
"""The same, in coordinates of the box."""


class Field(Protocol):
    """Parts as functions on their boxes."""

    def __call__(self, points_BPN3: Tensor) -> tuple[Tensor, Tensor]:
        """Signed distance (B, P, N) in radii and sRGB color (B, P, N, 3) in [0, 1] of points in
        coordinates [-1, 1] of the parts' (grown) boxes."""


@runtime_checkable
class PackedField(Protocol):
    """A field that can be asked for some parts alone: rays that miss a box then cost nothing."""

    def distances(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        """(K, N) signed distances; segment k lies in the box of slot_K[k] = object * P + part, and
        objects do not decrease."""

    def seen(self, points_KN3: Tensor, slot_K: Tensor) -> tuple[Tensor, Tensor]:
        """(K, N) signed distances, (K, N, 3) colors."""


@dataclass(frozen=True)
class Dense:
    """Any field as a `PackedField`: segments are laid out as a table of equally many per part."""

    field: Field
    batch: int
    parts: int

    def distances(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        """As `PackedField`."""
        return self.seen(points_KN3, slot_K)[0]

    def seen(self, points_KN3: Tensor, slot_K: Tensor) -> tuple[Tensor, Tensor]:
        """As `PackedField`."""
        rows = ragged(slot_K, self.batch * self.parts)
        table = rows.padded(points_KN3).reshape(self.batch, self.parts, -1, 3)
        cells = (-1, rows.most, points_KN3.shape[1])
        distance, rgb = self.field(table)
        return rows.packed(distance.reshape(cells)), rows.packed(rgb.reshape(*cells, 3))


def packed(field: Field, batch: int, parts: int) -> PackedField:
    """The field itself if it can be asked for some parts alone, else a stand-in that asks all."""
    return field if isinstance(field, PackedField) else Dense(field, batch, parts)


class FieldHead(nn.Module):
    """The two small networks that all parts share: features to distance, features to color."""

    def __init__(self, config: FieldConfig, channels: int) -> None:
        super().__init__()
        self.config = config
        self.distance = _network(3 * channels, config, 1)
        self.color = _network(3 * channels, config, 3)
        last = self.distance[-1]
        if isinstance(last, nn.Linear):
            nn.init.zeros_(last.weight)
            nn.init.zeros_(last.bias)

    def offset(self, features_KND: Tensor) -> Tensor:
        """(K, N) what is added to the ball's distance."""
        return full(self.distance(features_KND)).squeeze(-1)

    def rgb(self, features_KND: Tensor) -> Tensor:
        """(K, N, 3) in [0, 1]."""
        return torch.sigmoid(full(self.color(features_KND)))


class PlaneField:
    """Hexa-planes of B x P parts read through one head.

    Args:
        planes_BP6CHW: order xy+ xy- yz+ yz- xz+ xz-; columns run along the pair's first axis.
        size_BP3: side lengths of the stated boxes, radii.
        head: of as many channels as the planes.
        growth: by how much the boxes are larger where they are rendered.
    """

    def __init__(
        self,
        planes_BP6CHW: Tensor,
        size_BP3: Tensor,
        head: FieldHead,
        growth: Growth = Growth(),  # noqa: B008 (frozen)
    ) -> None:
        self.head = head
        self._parts = planes_BP6CHW.shape[1]
        self._images = stacked(planes_BP6CHW)
        self._half_S3 = half_sides(size_BP3.detach(), growth).flatten(0, 1)

    def __call__(self, points_BPN3: Tensor) -> tuple[Tensor, Tensor]:
        """As `Field`."""
        slots = points_BPN3.shape[0] * points_BPN3.shape[1]
        slot_S = torch.arange(slots, device=points_BPN3.device)
        distance, rgb = self.seen(points_BPN3.flatten(0, 1), slot_S)
        return distance.reshape(points_BPN3.shape[:3]), rgb.reshape(points_BPN3.shape)

    def distances(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        """As `PackedField`."""
        return self._distances(self._features(points_KN3, slot_K), points_KN3, slot_K)

    def seen(self, points_KN3: Tensor, slot_K: Tensor) -> tuple[Tensor, Tensor]:
        """As `PackedField`."""
        features = self._features(points_KN3, slot_K)
        return self._distances(features, points_KN3, slot_K), self.head.rgb(features)

    def _features(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        blend = self.head.config.octant_blend
        return read(self._images, points_KN3, slot_K, parts=self._parts, blend=blend)

    def _distances(self, features_KND: Tensor, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        ball = ball_distance(points_KN3, self._half_S3[slot_K], self.head.config.bias)
        return self.head.offset(features_KND) + ball


def ball_distance(points_KN3: Tensor, half_K3: Tensor, bias: SphereBias) -> Tensor:
    """(K, N) signed distance of the ball that parts begin as, by the named reading of S2.

    Args:
        points_KN3: coordinates [-1, 1] of the box.
        half_K3: its half sides, radii.
    """
    if bias == "paper":
        return _length(points_KN3 * half_K3[:, None]) - PAPER_RADIUS
    ball = _length(points_KN3) - NORMALIZED_RADIUS
    return ball if bias == "normalized" else ball * half_K3.amin(dim=-1, keepdim=True)


def _length(points_KN3: Tensor) -> Tensor:
    # The norm has no slope at zero; torch.linalg.vector_norm takes 0 there, sqrt would take nan.
    length: Tensor = torch.linalg.vector_norm(points_KN3, dim=-1)
    return length


def _network(inputs: int, config: FieldConfig, outputs: int) -> nn.Sequential:
    widths = [inputs, *[config.hidden] * config.layers]
    layers: list[nn.Module] = []
    for before, after in pairwise(widths):
        layers += [nn.Linear(before, after), nn.SiLU()]
    return nn.Sequential(*layers, nn.Linear(widths[-1], outputs))
