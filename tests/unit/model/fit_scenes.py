"""Images of a base with one drawer, or of any part of the cabinet of boxes."""

import torch

from model.batch import Articulation, Images
from model.field.analytic import BoxField
from model.field.pictures import pictures
from tests.unit.model.box_scenes import box_field, cabinet, camera, intrinsics

EYES = (
    (1.8, -2.2, 1.4),
    (-2.4, -1.6, 0.9),
    (0.3, -3.0, 0.2),
    (-0.5, -2.3, 2.0),
    (3.0, 0.4, 0.6),
)
BACKGROUND = 0.7


def drawer() -> tuple[Articulation, BoxField]:
    """The cabinet's base and drawer, and nothing else."""
    articulation = cabinet(slots=4)
    articulation = articulation.mapped(
        lambda value: value[:, :, :2] if value.shape[:2] == (1, 2) else value[:, :2]
    )
    return articulation, box_field(articulation)


def photographs(
    articulation: Articulation,
    field: BoxField,
    px: int,
    eyes: tuple[tuple[float, float, float], ...] = EYES,
) -> Images:
    """Both states from every eye, over gray."""
    matrices = intrinsics(px).expand(1, 2, len(eyes), 3, 3)
    cameras = torch.stack([camera(eye) for eye in eyes]).expand(1, 2, -1, 4, 4)
    seen = pictures(
        *(field, articulation, matrices, cameras),
        height=px,
        width=px,
        inverse_beta=400.0,
        samples=32,
    )
    return Images(
        rgb_BTV3HW=seen.over(BACKGROUND),
        alpha_BTVHW=seen.alpha_BTVHW,
        intrinsics_BTV33=matrices,
        camera_from_world_BTV44=cameras,
    )
