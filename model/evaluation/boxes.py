"""Volumes that boxes share: along the axes, and moved; exactly, and by samples as others count.

IoU is the shared volume over the volume of both; generalized IoU (Rezatofighi et al., CVPR 2019)
subtracts the share of an enclosing box C that neither fills: IoU - (C - union) / C, in (-1, 1].
"""

import manifold3d as m3
import numpy as np

from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted

THIN = 1e-9
"""Share of the larger box's size below which a side counts as no thickness: such a box has no
volume to share."""


def volume(box: Floats) -> float:
    """Of a (2, 3) box."""
    return float(np.prod(box[1] - box[0]))


def enclosing(first: Floats, second: Floats) -> Floats:
    """(2, 3) smallest upright box around two."""
    return np.stack([np.minimum(first[0], second[0]), np.maximum(first[1], second[1])])


def shared_upright(first: Floats, second: Floats) -> float:
    """Volume that two upright boxes share."""
    sides = np.minimum(first[1], second[1]) - np.maximum(first[0], second[0])
    return float(np.prod(sides.clip(min=0.0)))


def corners(box: Floats) -> Floats:
    """(8, 3) corners of a (2, 3) box."""
    return np.array([[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1)
                     for k in (0, 1)])  # fmt: skip


def moved_bounds(box: Floats, pose: Floats) -> Floats:
    """(2, 3) upright box around a box at a pose."""
    points = apply(pose, corners(box))
    return np.stack([points.min(axis=0), points.max(axis=0)])


def shared_moved(first: Floats, second: Floats, relative: Floats) -> float:
    """Volume that a box shares with another one moved by `relative` (4, 4), exactly."""
    if np.array_equal(relative[:3, :3], np.eye(3)):
        return shared_upright(first, second + relative[:3, 3])
    sides = np.concatenate([first[1] - first[0], second[1] - second[0]])
    if sides.min() <= THIN * sides.max():
        return 0.0
    return float((_solid(first) ^ _solid(second).transform(relative[:3])).volume())


def _solid(box: Floats) -> m3.Manifold:
    return m3.Manifold.cube((box[1] - box[0]).tolist()).translate(box[0].tolist())


def shared_sampled(
    first: Floats, second: Floats, relative: Floats, rng: np.random.Generator, *, count: int
) -> float:
    """The same by counting points, the mean of both directions, as SINGAPO's `sampling_giou` does.

    Args:
        count: uniform points in each box.
    """
    forward = _hits(apply(inverted(relative), _points(first, rng, count)), second)
    backward = _hits(apply(relative, _points(second, rng, count)), first)
    return (volume(first) * forward + volume(second) * backward) / 2.0


def _points(box: Floats, rng: np.random.Generator, count: int) -> Floats:
    return np.asarray(box[0] + rng.random((count, 3)) * (box[1] - box[0]))


def _hits(points: Floats, box: Floats) -> float:
    """Share of points that lie in a box."""
    return float(((points >= box[0]) & (points <= box[1])).all(axis=1).mean())


def iou(first: float, second: float, shared: float) -> float:
    """Of two volumes that share some; 0 where both are nothing."""
    union = first + second - shared
    return shared / union if union > 0.0 else 0.0


def generalized(first: float, second: float, shared: float, around: float) -> float:
    """Generalized IoU of two volumes within a box of volume `around`.

    Two boxes without volume in a box without volume get their IoU, 0.
    """
    own = iou(first, second, shared)
    return own - (around - (first + second - shared)) / around if around > 0.0 else own


def giou_upright(first: Floats, second: Floats) -> float:
    """Generalized IoU of two upright boxes; 1 for equal ones, flat ones included."""
    if np.array_equal(first, second):
        return 1.0
    shared, around = shared_upright(first, second), volume(enclosing(first, second))
    return generalized(volume(first), volume(second), shared, around)


def giou_moved(first: Floats, second: Floats, first_pose: Floats, second_pose: Floats) -> float:
    """Generalized IoU of two boxes at poses (4, 4), exact, within the upright box around both."""
    if np.array_equal(first, second) and np.array_equal(first_pose, second_pose):
        return 1.0
    shared = shared_moved(first, second, inverted(first_pose) @ second_pose)
    around = enclosing(moved_bounds(first, first_pose), moved_bounds(second, second_pose))
    return generalized(volume(first), volume(second), shared, volume(around))
