"""Flat bars bent in one plane: brackets, spines of backs, arms of lamps."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from artgen.core.mesh import Floats
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Axis, Solid, hull, prism, slab, upright

Point = tuple[float, float]


def bent_strip(
    corners: Sequence[Point], *, bend: float, thickness: float, width: float, across: Axis
) -> Solid:
    """A bar of `width` along `across` through corners in the plane beside it, rounded by `bend`.

    Points are (y, z) across x, (z, x) across y and (x, y) across z, m; the bar is centered on 0
    along `across`.
    """
    flat = np.c_[np.asarray(corners, float), np.zeros(len(corners))]
    path = bent(flat, bend)[:, :2]
    side = thickness / 2.0 * _normals(path)
    outline = np.concatenate([path - side, (path + side)[::-1]])
    return _laid(prism(outline, width), width, across)


def _laid(drawn: Solid, width: float, across: Axis) -> Solid:
    half = -width / 2.0
    shift = {"x": (half, 0.0, 0.0), "y": (0.0, half, 0.0), "z": (0.0, 0.0, half)}[across]
    return upright(drawn, across).at(*shift)


def strip_contact(
    corners: Sequence[Point], *, thickness: float, width: float, across: Axis
) -> tuple[Solid, ...]:
    """A convex piece for each leg of such a bar; a cuboid where the leg runs along an axis."""
    pieces = []
    for a, b in pairwise(corners):
        pieces.append(_laid(_leg(np.array(a), np.array(b), thickness, width), width, across))
    return tuple(pieces)


def _leg(a: Floats, b: Floats, thickness: float, width: float) -> Solid:
    along = (b - a) / np.linalg.norm(b - a)
    half = thickness / 2.0
    if np.abs(along).max() > 1.0 - 1e-9:
        reach = half * (1.0 - np.abs(along))
        low, high = np.minimum(a, b) - reach, np.maximum(a, b) + reach
        return slab((*low, 0.0), (*high, width))
    side = half * np.array((-along[1], along[0]))
    corners = [(*(p + s * side), z) for p in (a, b) for s in (-1.0, 1.0) for z in (0.0, width)]
    return hull(corners)


def _normals(path: Floats) -> Floats:
    """Mitred normals to the left of a path, (N, 2); their length makes parallel sides."""
    legs = np.diff(path, axis=0)
    legs = legs / np.linalg.norm(legs, axis=1, keepdims=True)
    left = np.c_[-legs[:, 1], legs[:, 0]]
    before, after = np.vstack([left[:1], left]), np.vstack([left, left[-1:]])
    middle = before + after
    return np.asarray(2.0 * middle / np.square(middle).sum(axis=1, keepdims=True))
