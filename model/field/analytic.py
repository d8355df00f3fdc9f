"""Fields known in closed form: parts made of boxes, against which renderers and fits are checked.

Letters: B objects, P parts, M boxes of a part, K segments, N points, digits a length.
"""

from dataclasses import dataclass

import torch
from torch import Tensor

from model.batch import Articulation, TensorBlock
from model.field.rays import Growth, half_sides
from model.precision import full

ABSENT = 1e3
"""Distance of a box that is not there, radii."""


@dataclass(frozen=True, kw_only=True)
class BoxField(TensorBlock):
    """Every part is the union of axis-aligned boxes, each of one color.

    Distances are exact outside, and inside a single box; inside a union they are too small by
    amount, right by sign.

    Attributes:
        articulation: whose boxes the coordinates refer to.
        center_BPM3, half_BPM3: radii, object frame at rest.
        rgb_BPM3: sRGB in [0, 1].
        present_BPM: bool; None if all are there.
        growth: by how much the boxes of the coordinates are larger than the articulation's.
    """

    articulation: Articulation
    center_BPM3: Tensor
    half_BPM3: Tensor
    rgb_BPM3: Tensor
    present_BPM: Tensor | None = None
    growth: Growth = Growth()  # noqa: RUF009 (frozen)

    def __call__(self, points_BPN3: Tensor) -> tuple[Tensor, Tensor]:
        """As `Field`."""
        shape = points_BPN3.shape
        slot_S = torch.arange(shape[0] * shape[1], device=points_BPN3.device)
        distance, rgb = self.seen(points_BPN3.flatten(0, 1), slot_S)
        return distance.reshape(shape[:3]), rgb.reshape(shape)

    def distances(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        """As `PackedField`."""
        return self._each(points_KN3, slot_K).amin(dim=-1)

    def seen(self, points_KN3: Tensor, slot_K: Tensor) -> tuple[Tensor, Tensor]:
        """As `PackedField`; the color is that of the nearest box."""
        distance_KN, nearest_KN = self._each(points_KN3, slot_K).min(dim=-1)
        rgb_KM3 = self.rgb_BPM3.flatten(0, 1)[slot_K]
        index_KN3 = nearest_KN[..., None].expand(-1, -1, 3)
        return distance_KN, torch.gather(rgb_KM3, 1, index_KN3)

    def _each(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        """(K, N, M) signed distance of every box."""
        half_S3 = half_sides(self.articulation.size_BP3, self.growth).flatten(0, 1)
        center_S3 = full(self.articulation.center_BP3).flatten(0, 1)
        places_KN3 = center_S3[slot_K, None] + points_KN3 * half_S3[slot_K, None]
        center_KM3 = self.center_BPM3.flatten(0, 1)[slot_K]
        half_KM3 = self.half_BPM3.flatten(0, 1)[slot_K]
        distance_KNM = box_distance(places_KN3[:, :, None] - center_KM3[:, None], half_KM3[:, None])
        if self.present_BPM is None:
            return distance_KNM
        present_KM = self.present_BPM.flatten(0, 1)[slot_K]
        return torch.where(present_KM[:, None], distance_KNM, ABSENT)


def box_distance(offset_X3: Tensor, half_X3: Tensor) -> Tensor:
    """(X,) signed distance from a box's surface at an offset from its middle, negative inside."""
    beyond_X3 = offset_X3.abs() - half_X3
    outside: Tensor = torch.linalg.vector_norm(beyond_X3.clamp(min=0.0), dim=-1)
    return outside + beyond_X3.amax(dim=-1).clamp(max=0.0)
