"""A cabinet of boxes: a base with a drawer and a door, beside slots that hold nothing.

The drawer carries a knob as a part of its own, so that one chain has two joints.
"""

import dataclasses

import torch
from torch import Tensor

from artgen.core.mesh import Floats
from artgen.core.transform import inverted, look_at
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation
from model.field.analytic import BoxField
from model.field.rays import pixel_middles, pixel_rays

CENTERS = ((0.0, 0.1, 0.0), (0.0, -0.36, 0.22), (0.0, -0.36, -0.22), (0.0, -0.44, 0.22))
SIZES = ((0.8, 0.7, 0.9), (0.7, 0.12, 0.32), (0.7, 0.12, 0.32), (0.12, 0.05, 0.12))
TYPES = (FIXED, PRISMATIC, REVOLUTE, REVOLUTE)
AXES = ((0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0))
ORIGINS = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.35, -0.36, -0.22), (0.0, -0.44, 0.22))
MOTIONS = ((0.0, 0.0, 0.0, 0.0), (0.0, 0.14, 0.17, 0.13))
PARENTS = (-1, 0, 0, 1)
COLORS = ((0.2, 0.4, 0.9), (0.9, 0.3, 0.2), (0.3, 0.8, 0.3), (0.9, 0.9, 0.1))
PARTS = len(SIZES)


def cabinet(*, slots: int = 6, batch: int = 1, dtype: torch.dtype = torch.float32) -> Articulation:
    """B equal cabinets of four parts in two states: closed, and drawer and door open."""

    def padded(rows: object) -> Tensor:
        table = torch.tensor(rows, dtype=dtype)
        out = torch.zeros(batch, slots, *table.shape[1:], dtype=dtype)
        out[:, :PARTS] = table
        return out

    motion = torch.zeros(batch, 2, slots, dtype=dtype)
    motion[:, :, :PARTS] = torch.tensor(MOTIONS, dtype=dtype)
    parent = torch.full((batch, slots), -1)
    parent[:, :PARTS] = torch.tensor(PARENTS)
    return Articulation(
        valid_BP=(torch.arange(slots) < PARTS).expand(batch, -1),
        center_BP3=padded(CENTERS),
        size_BP3=padded(SIZES),
        type_BP=padded([[kind] for kind in TYPES])[..., 0].long(),
        axis_BP3=padded(AXES),
        origin_BP3=padded(ORIGINS),
        motion_BTP=motion,
        limits_BP2=padded([(min(0.0, q), max(0.0, q)) for q in MOTIONS[1]]),
        parent_BP=parent,
    )


def box_field(articulation: Articulation) -> BoxField:
    """Every part fills its box, in one color."""
    batch, slots = articulation.valid_BP.shape
    rgb = torch.zeros(batch, slots, 1, 3, dtype=articulation.center_BP3.dtype)
    rgb[:, :PARTS, 0] = torch.tensor(COLORS, dtype=rgb.dtype)[: min(PARTS, slots)]
    return BoxField(
        articulation=articulation,
        center_BPM3=articulation.center_BP3[:, :, None],
        half_BPM3=articulation.size_BP3[:, :, None] / 2.0,
        rgb_BPM3=rgb,
    )


def camera(eye: tuple[float, float, float], dtype: torch.dtype = torch.float32) -> Tensor:
    """(4, 4) `camera_from_world` of an upright camera that looks at the middle."""
    matrix: Floats = inverted(look_at(eye, (0.0, 0.0, 0.0)))
    return torch.tensor(matrix, dtype=dtype)


def intrinsics(px: int, dtype: torch.dtype = torch.float32) -> Tensor:
    """(3, 3) of a square image that holds the unit sphere from 3 radii away."""
    focal, middle = 1.3 * px, px / 2.0
    rows = [[focal, 0.0, middle], [0.0, focal, middle], [0.0, 0.0, 1.0]]
    return torch.tensor(rows, dtype=dtype)


def view(
    px: int, eye: tuple[float, float, float], dtype: torch.dtype = torch.float32
) -> tuple[Tensor, Tensor]:
    """Origins and directions (1, px * px, 3) of all pixels of a view."""
    pixels = pixel_middles(px, px).to(dtype)
    origin, direction = pixel_rays(intrinsics(px, dtype), camera(eye, dtype), pixels)
    return origin[None], direction[None]


def changed(articulation: Articulation, **values: Tensor) -> Articulation:
    """The articulation with some tensors replaced."""
    return dataclasses.replace(articulation, **values)
