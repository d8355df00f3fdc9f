"""Cases with rounded corners in plan and rounded edges below, made as lofts through rings."""

import math
from collections.abc import Sequence

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, loft

CORNER_SEGMENTS = 5
ROUND_STEPS = 4


def plan(
    x: float, front: float, rear: float, radii: tuple[float, float], *, inset: float = 0.0
) -> Floats:
    """(N, 2) outline from -x to x and `front` to `rear` with radii (front, rear), moved in by
    `inset`."""
    near, far = (max(r - inset, 0.0004) for r in radii)
    outline = rounded_rectangle(
        2.0 * (x - inset), rear - front - 2.0 * inset, (near, near, far, far),
        segments=CORNER_SEGMENTS,
    )  # fmt: skip
    return np.asarray(outline + np.array((0.0, (front + rear) / 2.0)))


def tray(
    *,
    x: float,
    y: tuple[float, float],
    z: tuple[float, float],
    radii: tuple[float, float],
    belly: float,
    nose: tuple[float, float],
) -> Solid:
    """A slab whose lower edges are rounded, at the front by an ellipse that makes it look thin.

    Args:
        x: half width, m.
        y: front and rear.
        z: bottom and top.
        radii: of the corners in plan, front and rear.
        belly: radius of the lower edges at the sides and the rear.
        nose: run and rise of the ellipse at the front.
    """
    run, rise = nose
    rings = []
    for step in range(ROUND_STEPS + 1):
        angle = 0.5 * math.pi * step / ROUND_STEPS
        pulled, lifted = 1.0 - math.sin(angle), 1.0 - math.cos(angle)
        outline = plan(x, y[0] + (run - belly) * pulled, y[1], radii, inset=belly * pulled)
        front = np.arange(len(outline)) < len(outline) // 2
        height = z[0] + lifted * np.where(front, rise, belly)
        rings.append(np.c_[outline, height])
    rings.append(np.c_[plan(x, *y, radii), np.full(len(outline), z[1])])
    return loft(rings)


def cover(
    *,
    x: float,
    y: tuple[float, float],
    z: tuple[float, float],
    radii: tuple[float, float],
    crown: float,
) -> Solid:
    """A slab whose upper edges are rounded by `crown`."""
    rings = [np.c_[plan(x, *y, radii), np.full(4 * (CORNER_SEGMENTS + 1), z[0])]]
    for step in range(ROUND_STEPS + 1):
        angle = 0.5 * math.pi * step / ROUND_STEPS
        outline = plan(x, *y, radii, inset=crown * (1.0 - math.cos(angle)))
        height = z[1] - crown * (1.0 - math.sin(angle))
        rings.append(np.c_[outline, np.full(len(outline), height)])
    return loft(rings)


def stacked(
    *,
    x: float,
    y: tuple[float, float],
    radii: tuple[float, float],
    steps: Sequence[tuple[float, float]],
) -> Solid:
    """A body that rises through outlines drawn in by (inset, z), from its foot to its top."""
    rings = [
        np.c_[outline, np.full(len(outline), z)]
        for outline, z in ((plan(x, *y, radii, inset=inset), z) for inset, z in steps)
    ]
    return loft(rings)


def crown_steps(
    low: float, top: float, crown: float, *, steps: int = ROUND_STEPS
) -> list[tuple[float, float]]:
    """Steps of `stacked` for straight walls from `low` whose upper edge is a quarter round."""
    angles = [0.5 * math.pi * k / steps for k in range(steps + 1)]
    round_ = [(crown * (1.0 - math.cos(a)), top - crown * (1.0 - math.sin(a))) for a in angles]
    return [(0.0, low), *round_]
