"""Bars of rounded rectangular section along a bent line in the plane x = 0: handles, straps."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, loft, slab

TURN = math.radians(11.0)
"""By which a bend turns at most from chord to chord."""
BOX_STEP = 0.012
"""m; between the middles of contact boxes along a slanted or bent stretch."""


def bent_line(corners: Sequence[tuple[float, float]], radius: float) -> Floats:
    """(N, 2) points (y, z) through straight legs whose corners are rounded by at most `radius` m;
    less where a leg is too short for two bends."""
    points = np.asarray(corners, float)
    legs = np.linalg.norm(np.diff(points, axis=0), axis=1)
    path = [points[:1]]
    for k in range(1, len(points) - 1):
        room = 0.49 * min(legs[k - 1], legs[k])
        path.append(_fillet(points[k - 1], points[k], points[k + 1], radius, room))
    return np.concatenate([*path, points[-1:]])


def _fillet(a: Floats, corner: Floats, b: Floats, radius: float, room: float) -> Floats:
    into, out = (corner - a) / np.linalg.norm(corner - a), (b - corner) / np.linalg.norm(b - corner)
    turn = math.acos(float(np.clip(into @ out, -1.0, 1.0)))
    if turn < TURN / 2.0:
        return corner[None]
    cut = min(radius * math.tan(turn / 2.0), room)
    fit = cut / math.tan(turn / 2.0)
    side: Floats = out - into * (into @ out)
    side = side / np.linalg.norm(side)
    angles = np.linspace(0.0, turn, math.ceil(turn / TURN) + 1)[:, None]
    return np.asarray(
        corner - into * cut + fit * (np.sin(angles) * into + (1.0 - np.cos(angles)) * side)
    )


def swept(path: Floats, width: float, thickness: float, *, round_end: bool = False) -> Solid:
    """A bar `width` along x and `thickness` across along (N, 2) points (y, z).

    `round_end` narrows the last stretch to a rounded nose; its path grows no longer.
    """
    points, scale = _rounded_end(path, thickness) if round_end else (path, np.ones(len(path)))
    ahead = np.diff(points, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    before, after = np.r_[ahead[:1], ahead], np.r_[ahead, ahead[-1:]]
    along = (before + after) / np.linalg.norm(before + after, axis=1, keepdims=True)
    miter = 1.0 / np.einsum("ij,ij->i", along, after)
    rings = []
    for point, (ty, tz), share, stretch in zip(points, along, scale, miter, strict=True):
        w, t = width * (0.35 + 0.65 * share), thickness * share
        section = rounded_rectangle(w, t, 0.42 * min(w, t), segments=3)
        across = section[:, 1] * stretch
        rings.append(
            np.stack([section[:, 0], point[0] + across * tz, point[1] - across * ty], axis=1)
        )
    return loft(np.array(rings))


def _rounded_end(path: Floats, thickness: float) -> tuple[Floats, Floats]:
    """The path with four more points near its end, and the share of the section at each."""
    last = path[-1] - path[-2]
    length = float(np.linalg.norm(last))
    reach = min(0.5 * thickness, 0.9 * length)
    angles = np.linspace(0.0, 0.46 * math.pi, 5)
    nose = path[-1] - last / length * reach * (1.0 - np.sin(angles))[:, None]
    return np.concatenate([path[:-1], nose]), np.r_[np.ones(len(path) - 1), np.cos(angles)]


def swept_boxes(path: Floats, width: float, thickness: float) -> tuple[Solid, ...]:
    """Contact boxes along the axes: one for a level or upright leg, a stair for the rest."""
    half_x, half = 0.46 * width, 0.46 * thickness
    boxes: list[Solid] = []
    pending: list[tuple[float, float]] = []
    for a, b in pairwise(path):
        straight = np.min(np.abs(b - a)) < 1e-6 and np.max(np.abs(b - a)) > 2.0 * BOX_STEP
        if straight:
            boxes.append(_box_around(np.stack([a, b]), half_x, half))
        else:
            count = max(1, math.ceil(float(np.linalg.norm(b - a)) / BOX_STEP))
            steps = np.linspace(0.0, 1.0, count + 1)[:, None]
            pending += [(float(y), float(z)) for y, z in a + steps * (b - a)]
    kept: list[Floats] = []
    for point in pending:
        here = np.asarray(point)
        if all(np.linalg.norm(here - other) > 0.8 * BOX_STEP for other in kept):
            kept.append(here)
    return (
        *boxes,
        *(_box_around(here[None], half_x, 0.72 * thickness / 2.0 + 0.002) for here in kept),
    )


def _box_around(points: Floats, half_x: float, half: float) -> Solid:
    low, high = points.min(axis=0) - half, points.max(axis=0) + half
    return slab((-half_x, *low), (half_x, *high))
