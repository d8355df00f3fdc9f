"""Cuts: triangles clipped at a plane, and where a cut across an axis saves the most."""

from collections.abc import Sequence

import numpy as np

from artgen.core.mesh import Floats

FULL = 0.9
"""Of its hull that a solid fills which stands for its own piece; of its box, a wall."""
PEEL = 0.05
"""Of a chunk's area that a wall has at least to be taken off."""
PLACES = 14
"""Places along an axis at which a cut is tried."""
GAIN = 0.97
"""A cut that leaves more of the boxes' volume than this saves nothing; the longest side is halved
then."""


def best_cut(corners: Floats, wall: float, *, solid: bool) -> tuple[int, float]:
    """Axis and place of a plane to cut at: the one that leaves the least volume of boxes on both
    its sides; where that saves nothing, the one that takes off the largest wall, as walls have to
    be taken off a hollow one by one; where there is none, the middle of the longest side.

    A wall is not longest across the cut that takes it off. One of a solid has two sides. Boxes of
    open surfaces are padded, as some have no volume.
    """
    thick, offsets = (2.0 * wall, (0.0,)) if solid else (wall, (-wall / 4.0, wall / 4.0))
    lower, upper = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    pad = 0.0 if solid else wall / 4.0
    best, found = GAIN * float(np.prod(upper - lower + pad)), None
    largest, peeled = PEEL * area_of(corners), None
    for axis in range(3):
        for place in _places(corners[..., axis], wall, offsets):
            sides = [side for side in clipped(corners, corners[..., axis] - place) if len(side)]
            if len(sides) < 2:
                continue
            spans = [np.ptp(side.reshape(-1, 3), axis=0) for side in sides]
            if (volume := float(sum(np.prod(span + pad) for span in spans))) < best:
                best, found = volume, (axis, float(place))
            for side, span in zip(sides, spans, strict=True):
                area = area_of(side)
                face = float(np.prod(np.sort(span)[1:]))
                full = area >= FULL * face and np.prod(span) <= area / 2.0 * thick
                if area > largest and full and int(np.argmax(span)) != axis:
                    largest, peeled = area, (axis, float(place))
    axis = int(np.argmax(upper - lower))
    return found or peeled or (axis, float((lower[axis] + upper[axis]) / 2.0))


def area_of(corners: Floats) -> float:
    """m2 of (F, 3, 3) triangles."""
    edges = corners[:, 1:] - corners[:, :1]
    return float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()) / 2.0


def _places(values: Floats, wall: float, offsets: Sequence[float]) -> Floats:
    """Places where vertices are, which is where walls end, or just beside."""
    at = np.unique(np.round(values, 6))
    if len(at) > PLACES:
        at = at[np.linspace(0, len(at) - 1, PLACES).astype(int)]
    beside = np.concatenate([at + offset for offset in offsets])
    margin = 1e-6 + 0.01 * wall
    return np.unique(beside[(beside > at[0] + margin) & (beside < at[-1] - margin)])


def clipped(corners: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Triangles (F, 3, 3) above and below a plane, whose corners are (F, 3) above it; those it
    crosses are cut."""
    above, below = (height >= 0.0).all(axis=1), (height <= 0.0).all(axis=1)
    crossing = ~(above | below)
    tops, bottoms = [corners[above]], [corners[below & ~above]]
    if crossing.any():
        own, level = corners[crossing], height[crossing]
        lone = np.where((level > 0.0).sum(axis=1) == 1, level.argmax(axis=1), level.argmin(axis=1))
        order = (lone[:, None] + np.arange(3)) % 3
        tip, left, right = np.take_along_axis(own, order[..., None], axis=1).transpose(1, 0, 2)
        a, b, c = np.take_along_axis(level, order, axis=1).T
        on_left = tip + (a / (a - b))[:, None] * (left - tip)
        on_right = tip + (a / (a - c))[:, None] * (right - tip)
        tips = np.stack([tip, on_left, on_right], axis=1)
        rest = np.concatenate([
            np.stack([on_left, left, right], axis=1), np.stack([on_left, right, on_right], axis=1)
        ])  # fmt: skip
        up = a > 0.0
        tops += [tips[up], rest[np.tile(~up, 2)]]
        bottoms += [tips[~up], rest[np.tile(up, 2)]]
    return np.concatenate(tops), np.concatenate(bottoms)
