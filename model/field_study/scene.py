"""The scene of the study: a hollow cabinet of thin boards with a drawer and a door, and its views.

Thin walls in large boxes are what few samples miss and coarse planes cannot hold. Radii, object
frame at rest.
"""

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from artgen.core.camera import orbit_direction
from artgen.core.transform import inverted, look_at
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation, TensorBlock
from model.field.analytic import BoxField
from model.field.rays import pixel_middles, pixel_rays

Vector = tuple[float, float, float]
Board = tuple[Vector, Vector, Vector]
"""Middle, size, color."""

OAK, WHITE, STEEL, RED = (0.65, 0.45, 0.25), (0.9, 0.9, 0.85), (0.5, 0.52, 0.55), (0.8, 0.2, 0.15)
CARCASS: tuple[Board, ...] = (
    ((-0.385, 0.05, 0.0), (0.03, 0.7, 0.9), OAK),
    ((0.385, 0.05, 0.0), (0.03, 0.7, 0.9), OAK),
    ((0.0, 0.05, 0.435), (0.8, 0.7, 0.03), WHITE),
    ((0.0, 0.05, -0.435), (0.8, 0.7, 0.03), OAK),
    ((0.0, 0.05, 0.1), (0.74, 0.7, 0.02), WHITE),
    ((0.0, 0.39, 0.0), (0.8, 0.02, 0.9), OAK),
)
DRAWER: tuple[Board, ...] = (
    ((0.0, -0.315, 0.265), (0.78, 0.025, 0.3), WHITE),
    ((0.0, 0.0, 0.15), (0.7, 0.6, 0.015), OAK),
    ((-0.345, 0.0, 0.24), (0.015, 0.6, 0.19), OAK),
    ((0.345, 0.0, 0.24), (0.015, 0.6, 0.19), OAK),
    ((0.0, 0.3, 0.24), (0.7, 0.015, 0.19), OAK),
    ((0.0, -0.345, 0.27), (0.2, 0.035, 0.03), STEEL),
)
DOOR: tuple[Board, ...] = (
    ((0.0, -0.315, -0.17), (0.78, 0.025, 0.5), RED),
    ((0.33, -0.345, -0.17), (0.025, 0.035, 0.2), STEEL),
)
PARTS = (CARCASS, DRAWER, DOOR)
FOCAL = 1.2
"""Focal length over image width."""
DISTANCE = 3.2
"""From the eye to the middle, radii."""
AZIMUTHS, ELEVATION = (-0.6, 0.8), 0.5
"""Of the views, rad."""


@dataclass(frozen=True, kw_only=True)
class Scene(TensorBlock):
    """A cabinet closed and open, seen by a few cameras.

    Attributes:
        field: the boards in closed form.
        origin_BR3, direction_BR3, state_BR: the rays of all pixels of all views in both states.
    """

    field: BoxField
    origin_BR3: Tensor
    direction_BR3: Tensor
    state_BR: Tensor

    @property
    def articulation(self) -> Articulation:
        """Of the cabinet."""
        return self.field.articulation


def scene(px: int, device: str) -> Scene:
    """The scene with images of `px` by `px` pixels."""
    poses = [
        inverted(look_at(DISTANCE * orbit_direction(azimuth, ELEVATION), (0.0, 0.0, 0.0)))
        for azimuth in AZIMUTHS
    ]
    camera_V44 = torch.tensor(np.stack(poses), dtype=torch.float32)
    focal, middle = FOCAL * px, px / 2.0
    rows = [[focal, 0.0, middle], [0.0, focal, middle], [0.0, 0.0, 1.0]]
    origin, direction = pixel_rays(torch.tensor(rows), camera_V44, pixel_middles(px, px))
    count = len(AZIMUTHS) * px * px
    return Scene(
        field=boards(),
        origin_BR3=origin.reshape(1, count, 3).repeat(1, 2, 1),
        direction_BR3=direction.reshape(1, count, 3).repeat(1, 2, 1),
        state_BR=torch.arange(2).repeat_interleave(count)[None],
    ).to(device)


def boards() -> BoxField:
    """The cabinet: carcass, drawer, door."""
    most = max(len(part) for part in PARTS)
    middle, size, color = (torch.zeros(1, len(PARTS), most, 3) for _ in range(3))
    present = torch.zeros(1, len(PARTS), most, dtype=torch.bool)
    for p, part in enumerate(PARTS):
        for m, board in enumerate(part):
            middle[0, p, m], size[0, p, m], color[0, p, m] = torch.tensor(board)
            present[0, p, m] = True
    low = torch.where(present[..., None], middle - size / 2.0, torch.inf).amin(dim=2)
    high = torch.where(present[..., None], middle + size / 2.0, -torch.inf).amax(dim=2)
    return BoxField(
        articulation=_articulated((low + high) / 2.0, high - low),
        center_BPM3=middle,
        half_BPM3=size / 2.0,
        rgb_BPM3=color,
        present_BPM=present,
    )


def _articulated(center_BP3: Tensor, size_BP3: Tensor) -> Articulation:
    motion_BTP = torch.tensor([[[0.0, 0.0, 0.0], [0.0, 0.18, 0.2]]])
    return Articulation(
        valid_BP=torch.ones(1, 3, dtype=torch.bool),
        center_BP3=center_BP3,
        size_BP3=size_BP3,
        type_BP=torch.tensor([[FIXED, PRISMATIC, REVOLUTE]]),
        axis_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]]),
        origin_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [-0.39, -0.315, -0.17]]]),
        motion_BTP=motion_BTP,
        limits_BP2=torch.stack([torch.zeros(1, 3), motion_BTP[:, 1]], dim=-1),
        parent_BP=torch.tensor([[-1, 0, 0]]),
    )
