"""A cabinet with a door and a drawer, as a model without fault would predict it."""

import math

import numpy as np

from artgen.articulation.types import JointType
from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, slab
from model.reconstruct.assemble import Assembled
from model.reconstruct.guess import JointGuess, ObjectGuess, PartGuess
from model.reconstruct.sight import Sphere

RADIUS = 0.7
COLORS = {0: (0.8, 0.7, 0.5), 1: (0.2, 0.4, 0.8), 2: (0.8, 0.2, 0.2)}
WALL = 0.02


def part(slot: int, solid: Solid) -> PartGuess:
    """A solid as a prediction of one color."""
    mesh = solid.trimesh()
    rgb = np.tile(COLORS.get(slot, (0.5, 0.5, 0.5)), (len(mesh.vertices), 1))
    return PartGuess(slot=slot, vertices=mesh.vertices, faces=mesh.faces, rgb=rgb, box=mesh.bounds)


def joint(
    slot: int,
    kind: JointType,
    *,
    axis: tuple[float, float, float],
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    upper: float,
    observed: tuple[float, ...] = (0.0, 0.0),
    lower: float = 0.0,
    parent: int = 0,
) -> JointGuess:
    """A joint on the base unless stated otherwise."""
    return JointGuess(
        slot=slot,
        parent=parent,
        type=kind,
        axis=np.array(axis),
        origin=np.array(origin),
        lower=lower,
        upper=upper,
        observed=np.array(observed),
    )


def open_box(lower: Floats, upper: Floats, wall: float, *, open_to: int, side: int) -> Solid:
    """A cuboid hollowed out to one side: axis `open_to`, its lower (0) or upper (1) end."""
    low, high = lower + wall, upper - wall
    if side == 0:
        low[open_to] = lower[open_to] - wall
    else:
        high[open_to] = upper[open_to] + wall
    return slab(lower.tolist(), upper.tolist()) - slab(low.tolist(), high.tolist())


def cabinet(*, overlap: float = 0.0) -> ObjectGuess:
    """0.6 wide, 0.5 deep, 0.8 high; a door (left hinges) below, a drawer above.

    Args:
        overlap: m by which door and drawer reach into the base on every side.
    """
    lower, upper = np.array([-0.3, -0.25, -0.4]), np.array([0.3, 0.25, 0.4])
    base = open_box(lower, upper, WALL, open_to=1, side=0)
    base = base | slab((-0.3, -0.25, 0.13), (0.3, 0.25, 0.15))
    door = slab((-0.3, -0.27 - overlap, -0.4), (0.3, -0.25 + overlap, 0.13))
    gap = 0.003 - overlap
    low = np.array([-0.28 + gap, -0.25, 0.15 + gap])
    drawer = open_box(low, np.array([0.28 - gap, 0.2, 0.38 - gap]), 0.012, open_to=2, side=1)
    front = slab((-0.3, -0.27, 0.132), (0.3, -0.25 + overlap, 0.4))
    return ObjectGuess(
        parts=(part(0, base), part(1, door), part(2, drawer | front)),
        joints=(
            joint(
                1,
                "revolute",
                axis=(0.0, 0.0, -1.0),
                origin=(-0.3, -0.27, 0.0),
                upper=math.pi / 2.0,
                observed=(0.3, 1.2),
            ),
            joint(2, "prismatic", axis=(0.0, -1.0, 0.0), upper=0.35, observed=(0.2, 0.1)),
        ),
        radius=RADIUS,
    )


def sphere(perfect: Assembled, *, unit: float = 1.0) -> Sphere:
    """The cabinet's, in a file whose unit of length is `unit` m."""
    return Sphere(
        center=perfect.shift / unit,
        radius=RADIUS / unit,
        meters=unit,
        center_stated=True,
        radius_stated=True,
    )
