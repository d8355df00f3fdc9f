"""Thin round walls: shells of revolution, and contact rings of wedges around an open inside."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, hull, revolve, slab

BULGE = 0.0035
"""m; corners of a contact ring stand out by so much at most; files allow 4 mm."""
KEPT = 0.958
"""Share of the inner area that a ring leaves open."""
Level = tuple[float, float, float]
"""z, inner radius, outer radius, m."""


def offset_inwards(profile: ArrayLike, thickness: float) -> Floats:
    """(N, 2) points (radius, z) of an outer profile, from its foot to its mouth, moved inwards by
    `thickness` square to the profile."""
    points = np.asarray(profile, float)
    legs = np.diff(points, axis=0)
    legs /= np.linalg.norm(legs, axis=1, keepdims=True)
    normals = np.stack([-legs[:, 1], legs[:, 0]], axis=1)
    first, last = np.r_[normals[:1], normals], np.r_[normals, normals[-1:]]
    middle = first + last
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    return np.asarray(points + middle * (thickness / np.einsum("ij,ij->i", middle, last))[:, None])


def revolved_shell(
    profile: ArrayLike, thickness: float, *, floor: float | None = None, segments: int = 48
) -> Solid:
    """A vessel with a flat floor: `profile` runs from the floor's edge (radius, z) to the mouth.

    Args:
        floor: its thickness, m; that of the wall if None.
    """
    outer = np.asarray(profile, float)
    outside = revolve(np.concatenate([[(0.0, outer[0, 1])], outer, [(0.0, outer[-1, 1])]]),
                      segments=segments)  # fmt: skip
    return outside - revolved_room(outer, thickness, floor=floor, segments=segments)


def revolved_room(
    profile: ArrayLike, thickness: float, *, floor: float | None = None, segments: int = 48
) -> Solid:
    """The room inside such a vessel, up to 20 mm beyond its mouth."""
    outer = np.asarray(profile, float)
    inner = offset_inwards(outer, thickness)
    ground = outer[0, 1] + (thickness if floor is None else floor)
    above = inner[inner[:, 1] > ground + 1e-5]
    foot = float(np.interp(ground, inner[:, 1], inner[:, 0]))
    room = np.concatenate(
        [
            [(0.0, ground), (foot, ground)],
            above,
            [(above[-1, 0], outer[-1, 1] + 0.02), (0.0, outer[-1, 1] + 0.02)],
        ]
    )
    return revolve(room, segments=segments)


def wall_ring(
    levels: Sequence[Level], *, count: int | None = None, bulge: float = BULGE
) -> tuple[Solid, ...]:
    """Convex pieces around an open inside; where the wall is upright, those that face along the
    axes are boxes.

    Args:
        levels: of the wall, from low to high; two make a cone, more must bend outwards.
        count: of pieces; eight for slender vessels, twelve for wide ones if None.
    """
    widest = max(outer for _, _, outer in levels)
    pieces = count or (8 if widest < 0.1 else 12)
    share = pieces * math.sin(2.0 * math.pi / pieces) / (2.0 * math.pi)
    grow = max(1.0, math.sqrt(KEPT / share))
    upright = all(level[1:] == levels[0][1:] for level in levels)
    ring = []
    for k in range(pieces):
        if upright and k % (pieces // 4) == 0:
            ring.append(_faced_box(levels, k, pieces, grow, bulge))
        else:
            ring.append(_wedge(levels, k, pieces, grow, bulge))
    return tuple(ring)


def _wedge(levels: Sequence[Level], k: int, pieces: int, grow: float, bulge: float) -> Solid:
    angles = 2.0 * math.pi * (k + np.array([-0.5, 0.5])) / pieces
    away = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = []
    for z, inner, outer in levels:
        for reach in (min(inner * grow, outer + 0.5 * bulge), outer + bulge):
            points += [(reach * c, reach * s, z) for c, s in away]
    return hull(points)


def _faced_box(levels: Sequence[Level], k: int, pieces: int, grow: float, bulge: float) -> Solid:
    """The box that stands for the piece that faces along an axis."""
    low, high = levels[0], levels[-1]
    half = math.pi / pieces
    inner = min(low[1] * grow, low[2] + 0.5 * bulge)
    near, far = inner * math.cos(half), (low[2] + bulge) * math.cos(half)
    wide = inner * math.sin(half)
    piece = slab((near, -wide, low[0]), (far, wide, high[0]))
    return piece.turned("z", 2.0 * math.pi * k / pieces)
