"""Rays of cameras, and where they enter and leave the boxes of parts.

Letters: B objects, P parts, R rays, X any leading sizes, digits a length. Lengths in radii.
"""

from dataclasses import dataclass

import torch
from torch import Tensor

from model.field.kinematics import inverse_rigid, unit
from model.precision import full

FAR = 1e6
"""Radii; beyond every box, and its sums and squares stay finite in float32."""
PARALLEL = 1e-9
"""Directions with a smaller component are parallel to that pair of faces."""


@dataclass(frozen=True, kw_only=True)
class Growth:
    """How much larger than the stated box the volume is in which a part may have matter.

    A tight box would put the surface on its wall, where no sample is; and a box without thickness
    would hold none at all.

    Attributes:
        share: of each half side, added at both ends.
        margin: the least that is added at either end, radii.
    """

    share: float = 0.05
    margin: float = 0.01


NO_GROWTH = Growth(share=0.0, margin=0.0)
LEAST_HALF = 1e-6
"""Half side of a box without thickness when nothing is added, so that coordinates exist, radii."""


def half_sides(size_BP3: Tensor, growth: Growth) -> Tensor:
    """(B, P, 3) half side lengths of the grown boxes, at least `LEAST_HALF`."""
    half = full(size_BP3) / 2.0
    return (half + (half * growth.share).clamp(min=growth.margin)).clamp(min=LEAST_HALF)


def pixel_middles(height: int, width: int, device: torch.device | str = "cpu") -> Tensor:
    """(H * W, 2) px of the middles of all pixels, row by row; the first is (0.5, 0.5)."""
    y = torch.arange(height, device=device) + 0.5
    x = torch.arange(width, device=device) + 0.5
    rows, columns = torch.meshgrid(y, x, indexing="ij")
    return torch.stack([columns, rows], dim=-1).reshape(-1, 2)


def pixel_rays(
    intrinsics_X33: Tensor, camera_from_world_X44: Tensor, pixels_XN2: Tensor
) -> tuple[Tensor, Tensor]:
    """World rays through pixels: origins and unit directions, both (X, N, 3).

    Args:
        intrinsics_X33: px; upper triangular, skew allowed.
        camera_from_world_X44: rigid, OpenCV axes.
        pixels_XN2: (x, y) px; leading sizes broadcast against those of the cameras.
    """
    intrinsics_X133 = full(intrinsics_X33)[..., None, :, :]
    x, y = full(pixels_XN2).unbind(-1)
    down = (y - intrinsics_X133[..., 1, 2]) / intrinsics_X133[..., 1, 1]
    skewed = x - intrinsics_X133[..., 0, 2] - intrinsics_X133[..., 0, 1] * down
    right = skewed / intrinsics_X133[..., 0, 0]
    local_XN3 = torch.stack([right, down, torch.ones_like(down)], dim=-1)
    world_from_camera = inverse_rigid(full(camera_from_world_X44))
    direction = unit(local_XN3 @ world_from_camera[..., :3, :3].transpose(-1, -2))
    return world_from_camera[..., None, :3, 3].expand(direction.shape), direction


def plucker(origin_X3: Tensor, direction_X3: Tensor) -> Tensor:
    """(X, 6) direction and moment (d, o x d); the same for every origin on the ray."""
    return torch.cat([direction_X3, torch.linalg.cross(origin_X3, direction_X3)], dim=-1)


def waves(values_XD: Tensor, octaves: int) -> Tensor:
    """(X, D (1 + 2 octaves)): the values, then their sines and cosines of waves 4, 2, 1, ... long.

    Fourier features (Mildenhall et al. 2020, equation 4); values in [-1, 1] use the longest wave
    over half its length, so no two of them share all numbers.
    """
    octave = torch.arange(octaves, dtype=values_XD.dtype, device=values_XD.device)
    turns = torch.pi / 2.0 * 2.0**octave
    angles_XE = (values_XD[..., None] * turns).flatten(-2)
    return torch.cat([values_XD, angles_XE.sin(), angles_XE.cos()], dim=-1)


def box_span(
    origin_BPR3: Tensor, direction_BPR3: Tensor, center_BP3: Tensor, half_BP3: Tensor
) -> tuple[Tensor, Tensor]:
    """Where rays enter and leave axis-aligned boxes, both (B, P, R); exit < entry where they miss.

    A ray along a pair of faces meets them at infinity if it runs between or in them, else never.
    The entry is at least 0: nothing is seen behind the eye.
    """
    offset = center_BP3[:, :, None] - origin_BPR3
    half = half_BP3[:, :, None]
    along = direction_BPR3.abs() < PARALLEL
    slope = torch.where(along, 1.0, direction_BPR3)
    first, second = (offset - half) / slope, (offset + half) / slope
    between = offset.detach().abs() <= half.detach()
    wall = torch.where(between, FAR, -FAR).to(slope.dtype)
    near = torch.where(along, -wall, torch.minimum(first, second)).amax(dim=-1)
    far = torch.where(along, wall, torch.maximum(first, second)).amin(dim=-1)
    return near.clamp(min=0.0), far
