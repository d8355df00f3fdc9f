"""What of a moving part is its front, what its handle, and what are the works behind.

Told by where bodies lie alone, so that drafts, finished meshes and foreign ones are split alike:
the front is the slab of large thin bodies that looks along -y, handles stand out before it where a
hand takes hold, and all else (boxes of drawers, hinges, runners) works for the object it is in.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.types import Grip, Joint
from artgen.core.mesh import Floats

THICK = 0.08
"""m; no front is thicker."""
LARGE = 0.35
"""Least share of the front's width or height that a body of its slab spans."""
THIN = 0.35
"""A body of the front is at most so thick, as a share of its shorter side across or of its longer
one where it is a rail or a stile."""
PLAY = 0.0005
"""m; how far bodies of a front may reach beyond its slab."""
PROUD = 0.004
"""m; what stands out less than this before a front is trim on it."""
HAND = 0.015
"""m; how near to a handle's box its grip lies."""
HARDWARE = 0.012
"""m; what reaches this near to the axis of a hinge belongs to the hinge."""
TOUCHING = 0.0015
"""m; bodies of one handle lie at most so far apart."""
REAR = 0.25
"""Share of its depth that the hinge of a lid lies at most off its rear edge."""
Indices = tuple[int, ...]


@dataclass(frozen=True, kw_only=True)
class Split:
    """Numbers of the bodies of each kind."""

    front: Indices
    handle: Indices
    works: Indices


def split_bodies(
    boxes: Floats, joint: Joint, grips: Sequence[Grip], *, handles: Sequence[int] = ()
) -> Split | None:
    """Front, handle and works of a moving part; None where it shows no front toward -y, as a lid
    that lies flat: its rim or its knob is none.

    Args:
        boxes: (B, 2, 3) bounds of its bodies at rest, m.
        joint: what moves it.
        grips: where it is taken hold of.
        handles: numbers of the bodies that its source calls handles; those that stand out before
            the front are its handle, and nothing else is.
    """
    if covers(joint, _hull(boxes)):
        return None
    called = np.isin(np.arange(len(boxes)), list(handles))
    slab = None if called.all() else front_slab(boxes[~called])
    if slab is None:
        return None
    front = _in_slab(boxes, slab) & ~_near_axis(boxes, joint)
    if not front.any():
        return None
    if called.any():
        handle = called & ~front & (boxes[:, 0, 1] < slab[0, 1])
    else:
        handle = _handles(boxes, front, joint, grips)
    works = ~front & ~handle
    picked = [tuple(int(k) for k in np.flatnonzero(mask)) for mask in (front, handle, works)]
    return Split(front=picked[0], handle=picked[1], works=picked[2])


def covers(joint: Joint, box: Floats) -> bool:
    """Whether a part lies over an opening and is lifted: deeper than high, hinged along its rear
    edge."""
    if joint.type != "revolute" or int(np.argmax(np.abs(joint.axis))) != 0:
        return False
    _, depth, height = box[1] - box[0]
    return bool(depth > height and abs(joint.origin[1] - box[1, 1]) < REAR * depth)


def front_slab(boxes: Floats) -> Floats | None:
    """(2, 3) box of the large thin bodies that are nearest to the viewer at -y."""
    size = boxes[:, 1] - boxes[:, 0]
    across = np.sort(size[:, [0, 2]], axis=1)
    flat = (size[:, 1] <= THICK) & (size[:, 1] <= THIN * across[:, 1])
    area = size[:, 0] * size[:, 2]
    if not flat.any():
        return None
    whole = np.ptp(boxes.reshape(-1, 3)[:, [0, 2]], axis=0)
    wide = (size[:, [0, 2]] >= LARGE * whole).any(axis=1) & flat
    if not wide.any():
        return None
    largest = float(area[wide].max())
    seeds = np.flatnonzero(wide & (area >= 0.3 * largest))
    seed = int(seeds[np.argmin(boxes[seeds, 0, 1])])
    slab = boxes[seed].copy()
    for _ in range(len(boxes)):
        overlapping = (boxes[:, 0, 1] < slab[1, 1] - PLAY) & (boxes[:, 1, 1] > slab[0, 1] + PLAY)
        grown = _hull(boxes[(wide & overlapping) | (np.arange(len(boxes)) == seed)])
        if np.array_equal(grown, slab):
            break
        slab = grown
    return slab if slab[1, 1] - slab[0, 1] <= THICK else None


def _hull(boxes: Floats) -> Floats:
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def _in_slab(boxes: Floats, slab: Floats) -> NDArray[np.bool_]:
    """Bodies inside the slab's box, trim that stands out by a little included."""
    margin = np.array([[PLAY, PROUD, PLAY], [PLAY, PLAY, PLAY]])
    return np.asarray(
        (boxes[:, 0] >= slab[0] - margin[0]).all(axis=1)
        & (boxes[:, 1] <= slab[1] + margin[1]).all(axis=1)
    )


def _near_axis(boxes: Floats, joint: Joint) -> NDArray[np.bool_]:
    """Small bodies that a hinge's axis goes through or passes by."""
    if joint.type == "prismatic":
        return np.zeros(len(boxes), bool)
    along = int(np.argmax(np.abs(joint.axis)))
    others = [k for k in range(3) if k != along]
    origin = np.array(joint.origin)[others]
    gap = np.maximum(boxes[:, 0][:, others] - origin, origin - boxes[:, 1][:, others])
    near = np.linalg.norm(gap.clip(min=0.0), axis=1) < HARDWARE
    size = boxes[:, 1] - boxes[:, 0]
    whole = np.ptp(boxes.reshape(-1, 3), axis=0)
    return np.asarray(near & (size[:, along] < LARGE * whole[along]))


def _handles(
    boxes: Floats, front: NDArray[np.bool_], joint: Joint, grips: Sequence[Grip]
) -> NDArray[np.bool_]:
    """Bodies that stand out before the front where it is gripped, and what touches those."""
    slab = _hull(boxes[front])
    out = ~front & (boxes[:, 1, 1] <= slab[0, 1] + PROUD) & ~_near_axis(boxes, joint)
    beside = (boxes[:, 0] >= slab[0] - 0.05) & (boxes[:, 1] <= slab[1] + 0.05)
    out &= beside[:, [0, 2]].all(axis=1)
    held = [np.array(grip.position) for grip in grips if grip.kind in ("handle", "knob")]
    if not grips:
        return out
    handle = np.zeros(len(boxes), bool)
    for point in held:
        inside = (boxes[:, 0] - HAND <= point) & (point <= boxes[:, 1] + HAND)
        handle |= out & inside.all(axis=1)
    for _ in range(len(boxes)):
        touching = np.array([_touch(boxes[handle], box) for box in boxes])
        grown = handle | (out & touching)
        if (grown == handle).all():
            break
        handle = grown
    return handle


def _touch(boxes: Floats, box: Floats) -> bool:
    """Whether one of (B, 2, 3) boxes lies within `TOUCHING` of a box."""
    gap = np.maximum(boxes[:, 0] - box[1], box[0] - boxes[:, 1])
    return bool((gap.max(axis=1, initial=-np.inf) <= TOUCHING).any())
