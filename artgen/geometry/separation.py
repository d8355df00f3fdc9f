"""Proof that two surfaces keep apart over poses, by the boxes of their triangles.

A boolean of a wire rack and its tub takes milliseconds a pose. That no box of a triangle of the one
meets a box of a triangle of the other is seen sooner, because walls are flat and wires thin.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats

CLUSTER = 16
"""Neighboring triangles under one box on the larger side: 16 times fewer boxes, a little larger."""
BITS = 7
"""Cells a side, 2^7, of the grid along whose space-filling curve triangles are sorted."""
SPREAD = ((np.arange(2**BITS)[:, None] >> np.arange(BITS) & 1) << 3 * np.arange(BITS)).sum(axis=1)
"""(2^7,) each number with its bits three places apart."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Surface:
    """Boxes of the triangles of one closed body.

    Attributes:
        boxes: (T, 2, 3) bounds of each triangle, neighbors together, m.
        clusters: (C, 2, 3) bounds of each run of `CLUSTER` triangles, m.
    """

    boxes: Floats
    clusters: Floats


def surface_of(triangles: Floats) -> Surface:
    """(T, 3, 3) corners, in any order, as a Surface."""
    corners = triangles[np.argsort(curve_index(triangles.mean(axis=1)), kind="stable")]
    lower, upper = corners.min(axis=1), corners.max(axis=1)
    starts = np.arange(0, len(corners), CLUSTER)
    runs = [np.minimum.reduceat(lower, starts), np.maximum.reduceat(upper, starts)]
    return Surface(boxes=np.stack([lower, upper], axis=1), clusters=np.stack(runs, axis=1))


def curve_index(points: Floats) -> NDArray[np.int64]:
    """(N,) places of (N, 3) points along a Morton curve through their box."""
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    scale = (2**BITS - 1) / np.where(extent > 0.0, extent, 1.0)
    cells = ((points - low) * scale).astype(np.int64)
    return np.asarray(SPREAD[cells[:, 0]] + 2 * SPREAD[cells[:, 1]] + 4 * SPREAD[cells[:, 2]])


def may_meet(first: Surface, second: Surface, second_from_first: Floats) -> NDArray[np.bool_]:
    """(K,) whether boxes of their triangles meet at each of (K, 4, 4) poses; False is a proof."""
    if len(first.boxes) < len(second.boxes):
        return may_meet(second, first, inverted_poses(second_from_first))
    moved = carried(second_from_first, first.clusters)
    path = np.stack([moved[:, :, 0].min(axis=0), moved[:, :, 1].max(axis=0)], axis=1)
    near = np.flatnonzero(_meet(path, enclosing(second.boxes)))
    if len(near) == 0:
        return np.zeros(len(moved), bool)
    others = np.flatnonzero(_meet(second.boxes, enclosing(path[near])))
    run, triangle = np.nonzero(_meet(path[near][:, None], second.boxes[others][None]))
    if len(run) > len(first.boxes) + len(second.boxes):
        return np.ones(len(moved), bool)  # too close for boxes, and a boolean is as fast.
    meeting = _meet(moved[:, near[run]], second.boxes[others[triangle]][None])
    return np.asarray(meeting.any(axis=1))


def enclosing(boxes: Floats) -> Floats:
    """(2, 3) bounds of (N, 2, 3) boxes."""
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def _meet(one: Floats, other: Floats) -> NDArray[np.bool_]:
    """Whether boxes (..., 2, 3) touch or overlap."""
    meeting = (one[..., 0, 0] <= other[..., 1, 0]) & (other[..., 0, 0] <= one[..., 1, 0])
    for axis in (1, 2):
        meeting &= one[..., 0, axis] <= other[..., 1, axis]
        meeting &= other[..., 0, axis] <= one[..., 1, axis]
    return np.asarray(meeting)


def inverted_poses(poses: Floats) -> Floats:
    """(K, 4, 4) inverses of rigid poses."""
    inverse = np.zeros_like(poses)
    inverse[:, 3, 3] = 1.0
    inverse[:, :3, :3] = poses[:, :3, :3].transpose(0, 2, 1)
    inverse[:, :3, 3:] = -inverse[:, :3, :3] @ poses[:, :3, 3:]
    return inverse


def carried(poses: Floats, boxes: Floats) -> Floats:
    """(K, N, 2, 3) bounds of (N, 2, 3) boxes after each of (K, 4, 4) poses."""
    middle, half = boxes.mean(axis=1), np.diff(boxes, axis=1)[:, 0] / 2.0
    moved = middle @ poses[:, :3, :3].transpose(0, 2, 1) + poses[:, None, :3, 3]
    reach = half @ np.abs(poses[:, :3, :3]).transpose(0, 2, 1)
    return np.stack([moved - reach, moved + reach], axis=2)
