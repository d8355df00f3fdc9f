"""Upholstered pads: an outline that rises through insets, bent by a smooth map, with piping."""

from collections.abc import Callable, Sequence

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, loft, wire

Warp = Callable[[Floats], Floats]
"""(N, 3) points of the flat pad to where they come to lie."""
Step = tuple[float, float]
"""How far the outline is drawn in and how high it lies there, m."""


def plan(
    width: float, depth: float, radii: float | Sequence[float], *, segments: int = 4
) -> Floats:
    """(N, 2) outline centered on zero with points along its straight sides too, so that it bends.

    `radii` go from the lower left corner counter-clockwise.
    """
    corners = rounded_rectangle(width, depth, radii, segments=segments)
    points: list[Floats] = []
    for here, following in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = max(1, round(float(np.linalg.norm(following - here)) / (0.16 * max(width, depth))))
        points += [here + (following - here) * k / count for k in range(count)]
    return np.array(points)


def pad(outline: Floats, steps: Sequence[Step], warp: Warp) -> Solid:
    """The solid through the outline drawn in by each step, its underside first."""
    return loft([warp(_ring(outline, step)) for step in steps])


def piping(outline: Floats, step: Step, warp: Warp, radius: float) -> Solid:
    """A cord sewn in along one ring of a pad."""
    return wire(warp(_ring(outline, step)), radius, sides=4, closed=True)


def upholstered(
    thickness: float,
    *,
    roll: float,
    crown: float,
    reach: float,
    rings: tuple[int, int, int] = (3, 5, 5),
    under: Sequence[float] = (),
) -> list[Step]:
    """Steps of a pad that is flat below: a rolled edge, then a top that rises by `crown` more.

    Args:
        thickness: at the edge, m.
        roll: radius of the edge above, and of half of that below.
        crown: how much thicker it is in the middle.
        reach: half the shorter side of the outline.
        rings: how many steps the edge below, the edge above and the top take.
        under: steps of the underside, as shares of `reach` from the middle one outward; a pad that
            is bent needs some, for its flat ends are triangles across.
    """
    low = 0.5 * roll
    below, above = (np.linspace(0.0, np.pi / 2.0, count) for count in rings[:2])
    lower = [(low * (1.0 - np.sin(a)), low * (1.0 - np.cos(a))) for a in below]
    over = [(roll * (1.0 - np.cos(a)), thickness - roll * (1.0 - np.sin(a))) for a in above]
    inward = np.linspace(0.0, 1.0, rings[2] + 1)[1:] ** 1.2
    top = [
        (roll + t * (0.97 * reach - roll), thickness + crown * (1.0 - (1.0 - t) ** 2.2))
        for t in inward
    ]
    sole = [(share * reach, 0.0) for share in under]
    return [(float(inset), float(height)) for inset, height in (*sole, *lower, *over, *top)]


COARSE = (2, 3, 2)
"""Rings of a small pad."""


def _ring(outline: Floats, step: Step) -> Floats:
    """Sides move in by the inset; what lies between keeps its share."""
    inset, height = step
    half = np.abs(outline).max(axis=0)
    drawn_in = outline * (1.0 - inset / half)
    return np.c_[drawn_in, np.full(len(outline), height)]
