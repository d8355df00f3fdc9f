"""Which texels triangles touch, and where on the triangle each texel lies."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats

Indices = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Texels:
    """Texels and the point of a triangle that each shows.

    Attributes:
        index: (N,) row * size + column, each once; row 0 is the upper edge.
        triangle: (N,) number of the triangle.
        weights: (N, 3) barycentric weights of its corners, >= 0, sum 1.
    """

    index: Indices
    triangle: Indices
    weights: Floats


def touched_texels(corners: Floats, size: int) -> Texels:
    """Every texel that a triangle touches, however thin the triangle is.

    Where several touch one texel, a triangle that holds its center wins, then the last. A center
    outside its triangle is moved onto it.

    Args:
        corners: (F, 3, 2) in the unit square, v up.
        size: texels along each side.
    """
    pixels = corners * (size, -size) + (0.0, size)
    triangle, row, first, last = _spans(pixels, size)
    counts = last - first + 1
    starts = np.cumsum(counts) - counts
    column = np.arange(counts.sum()) - np.repeat(starts - first, counts)
    triangle, row = np.repeat(triangle, counts), np.repeat(row, counts)
    weights = _barycentric(pixels, triangle, np.stack([column + 0.5, row + 0.5], axis=1))
    inside = (weights >= 0.0).all(axis=1)
    index = row * size + column
    winner = np.full(size * size, -1)
    order = np.arange(len(index))
    winner[index[~inside]] = order[~inside]
    winner[index[inside]] = order[inside]
    chosen = winner[winner >= 0]
    kept = np.maximum(weights[chosen], 0.0)
    return Texels(
        index=index[chosen],
        triangle=triangle[chosen],
        weights=kept / kept.sum(axis=1, keepdims=True),
    )


def _spans(pixels: Floats, size: int) -> tuple[Indices, Indices, Indices, Indices]:
    """Triangle, row, first and last column for each row of texels that each triangle crosses."""
    y = pixels[..., 1]
    top = np.clip(np.floor(y.min(axis=1)).astype(np.int64), 0, size - 1)
    bottom = np.clip(np.ceil(y.max(axis=1)).astype(np.int64) - 1, top, size - 1)
    counts = bottom - top + 1
    triangle = np.repeat(np.arange(len(pixels)), counts)
    starts = np.cumsum(counts) - counts
    row = np.arange(counts.sum()) - np.repeat(starts - top, counts)
    low, high = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for k in range(3):
        ends = pixels[triangle, k], pixels[triangle, (k + 1) % 3]
        for x, valid in _edge_crossings(*ends, row):
            low = np.where(valid, np.minimum(low, x), low)
            high = np.where(valid, np.maximum(high, x), high)
    first = np.clip(np.floor(low), 0, size - 1).astype(np.int64)
    last = np.clip(np.ceil(high) - 1, first, size - 1).astype(np.int64)
    return triangle, row, first, last


def _edge_crossings(a: Floats, b: Floats, row: Indices) -> list[tuple[Floats, NDArray[np.bool_]]]:
    """x of an edge's two extremes within the band [row, row + 1], and whether it gets there."""
    rise = b[:, 1] - a[:, 1]
    level = rise == 0.0
    slope = np.where(level, 0.0, (b[:, 0] - a[:, 0]) / np.where(level, 1.0, rise))
    lower, upper = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    reached = (lower <= row + 1) & (upper >= row)
    found = []
    for bound, end in ((row, a), (row + 1, b)):
        y = np.clip(bound, lower, upper)
        x = np.where(level, end[:, 0], a[:, 0] + (y - a[:, 1]) * slope)
        found.append((x, reached))
    return found


def _barycentric(pixels: Floats, triangle: Indices, points: Floats) -> Floats:
    """(N, 3) weights; a triangle without area is shown by its first corner, and holds no point."""
    a, b, c = pixels[:, 0], pixels[:, 1], pixels[:, 2]
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    area = px * qy - py * qx
    scale = np.divide(1.0, area, out=np.zeros_like(area), where=area != 0.0)
    dx, dy = (points - a[triangle]).T
    second = (dx * (qy * scale)[triangle]) - dy * (qx * scale)[triangle]
    third = dy * (px * scale)[triangle] - dx * (py * scale)[triangle]
    weights = np.stack([1.0 - second - third, second, third], axis=1)
    weights[(area == 0.0)[triangle], 1:] = -1.0
    return weights
