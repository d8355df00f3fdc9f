"""Slopes of signed distance by differences, as the paper has its normals; they need no second
derivative of the network.

Letters: B objects, P parts, K segments, N points, digits a length.
"""

import torch
from torch import Tensor

from model.field.plane_field import PackedField

STEP = 2e-3
"""Radii between the points of a difference: ten times what float32 loses in distances near 1."""


def slopes(
    field: PackedField, points_KN3: Tensor, slot_K: Tensor, half_S3: Tensor, step: float = STEP
) -> Tensor:
    """(K, N, 3) gradient of the distance, object frame at rest: of length 1 where it is a distance,
    and then the outward normal of the surface.

    Args:
        points_KN3: coordinates [-1, 1] of the grown boxes.
        slot_K: object * P + part, not decreasing by object.
        half_S3: half sides of the grown boxes of all slots, radii.
    """
    shift_33 = torch.eye(3, dtype=points_KN3.dtype, device=points_KN3.device) * (step / 2.0)
    shift_K33 = shift_33 / half_S3[slot_K, None]
    ahead, behind = (
        field.distances((points_KN3[:, :, None] + sign * shift_K33[:, None]).flatten(1, 2), slot_K)
        for sign in (1.0, -1.0)
    )
    difference: Tensor = (ahead - behind) / step
    return difference.reshape(points_KN3.shape)


def steepness(slopes_KN3: Tensor) -> Tensor:
    """Mean squared difference of the slopes' length from 1; 0 for a signed distance."""
    length: Tensor = torch.linalg.vector_norm(slopes_KN3, dim=-1)
    return (length - 1.0).square().mean()
