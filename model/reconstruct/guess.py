"""What was predicted of one object, as plain arrays: a colored mesh a part, a joint a moving part.

Meters and radians; object axes (z up, front -y); zero is the middle of the object's sphere.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import JointType
from artgen.core.mesh import Floats, Ints
from model.batch import FIXED, PRISMATIC, Articulation

TYPES: Mapping[int, JointType] = {1: "revolute", 2: "prismatic"}
ColorAt = Callable[[Floats], Floats]
"""(N, 3) points, m, to (N, 3) sRGB in [0, 1]."""
Told = tuple[int, str]
"""A slot, and a sentence about its part."""
GRAY = 0.62
"""sRGB of what no image and no field gives a color."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PartGuess:
    """One part at rest.

    Attributes:
        slot: its place in the prediction; 0 is the base.
        vertices: (V, 3) m.
        faces: (F, 3), counter-clockwise from outside.
        rgb: (V, 3) sRGB in [0, 1].
        box: (2, 3) the box that the heads predict, m; it stands for a part without a surface.
        shade: its color at any point, m; None where there are those of the vertices alone.
        boxed: whether it is a rounded box of the predicted size instead of a surface of a field.
    """

    slot: int
    vertices: Floats
    faces: Ints
    rgb: Floats
    box: Floats
    shade: ColorAt | None = None
    boxed: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class JointGuess:
    """How a part moves relative to its parent.

    Attributes:
        slot: of the part that moves.
        parent: slot of what carries it.
        axis: (3,) direction, of any length.
        origin: (3,) a point of the axis, m.
        lower, upper: ends of its way, rad or m; equal where they are not predicted.
        observed: (T,) q in each state of the images, rad or m.
    """

    slot: int
    parent: int
    type: JointType
    axis: Floats
    origin: Floats
    lower: float
    upper: float
    observed: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class ObjectGuess:
    """The parts of the filled slots, the base first, and the joints of those that move.

    Attributes:
        radius: of the sphere that positions were divided by, m.
        told: slots, and what was made of the prediction there so far.
    """

    parts: tuple[PartGuess, ...]
    joints: tuple[JointGuess, ...]
    radius: float
    told: tuple[Told, ...] = ()


Surface = tuple[Floats, Ints, Floats]
"""Vertices (V, 3) m, faces (F, 3) and colors (V, 3) sRGB in [0, 1]."""


def object_guess(
    articulation: Articulation,
    number: int,
    surfaces: Mapping[int, Surface],
    *,
    radius: float,
) -> ObjectGuess:
    """Object `number` of a batch, `radius` m wide from its middle; `surfaces` by slot.

    A slot without a surface shows its predicted box. A fixed part becomes a piece of the base.
    """
    kinds = articulation.type_BP[number].tolist()
    filled = [slot for slot, valid in enumerate(articulation.valid_BP[number].tolist()) if valid]
    centers = _array(articulation.center_BP3[number]) * radius
    halves = _array(articulation.size_BP3[number]) * radius / 2.0
    parts = []
    for slot in filled:
        box = np.stack([centers[slot] - halves[slot], centers[slot] + halves[slot]])
        vertices, faces, rgb = surfaces.get(slot) or box_surface(box)
        parts.append(PartGuess(slot=slot, vertices=vertices, faces=faces, rgb=rgb, box=box))
    moving = [slot for slot in filled if slot > 0 and kinds[slot] != FIXED]
    joints = [_joint(articulation, number, slot, moving, radius) for slot in moving]
    return ObjectGuess(parts=tuple(parts), joints=tuple(joints), radius=radius)


def _array(tensor: object) -> Floats:
    return np.asarray(tensor.detach().cpu().double().numpy(), np.float64)  # type: ignore[attr-defined]


def _joint(
    articulation: Articulation, number: int, slot: int, moving: Sequence[int], radius: float
) -> JointGuess:
    """Motion and limits are shares of a turn, or of the sphere's diameter."""
    kind = int(articulation.type_BP[number, slot])
    unit = 2.0 * (radius if kind == PRISMATIC else math.pi)
    lower, upper = (_array(articulation.limits_BP2[number, slot]) * unit).tolist()
    parent = int(articulation.parent_BP[number, slot])
    return JointGuess(
        slot=slot,
        parent=parent if parent in moving and parent != slot else 0,
        type=TYPES[kind],
        axis=_array(articulation.axis_BP3[number, slot]),
        origin=_array(articulation.origin_BP3[number, slot]) * radius,
        lower=lower,
        upper=upper,
        observed=_array(articulation.motion_BTP[number, :, slot]) * unit,
    )


CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
BOX_FACES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ],
    np.int32,
)  # fmt: skip


def box_surface(box: Floats, color: Sequence[float] = (GRAY, GRAY, GRAY)) -> Surface:
    """A closed cuboid of one color between the corners of a (2, 3) box."""
    vertices = np.where(CORNERS == 0, box[0], box[1]).astype(float)
    return vertices, BOX_FACES, np.tile(np.asarray(color, float), (8, 1))
