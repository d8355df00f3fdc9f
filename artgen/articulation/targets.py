"""What ART is trained on: bounds, type, axis, origin and motion of every part, as arrays.

Positions are in m relative to `center`, the middle of the sphere that holds the object in all
states."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics, resolved
from artgen.articulation.states import motion, travel
from artgen.articulation.types import Joint, State
from artgen.core.mesh import Floats
from artgen.core.transform import apply

FIXED, REVOLUTE, PRISMATIC = 0, 1, 2
TYPE_IDS = {"revolute": REVOLUTE, "continuous": REVOLUTE, "prismatic": PRISMATIC}


@dataclass(frozen=True, kw_only=True, eq=False)
class Targets:
    """ART's (B, C, D, O, S) for P parts in T states.

    Attributes:
        bounds: (P, 2, 3) rest box of each part, lower then upper, m, relative to the sphere's
            center.
        type: (P,) int8: 0 fixed, 1 revolute (continuous too), 2 prismatic.
        axis: (P, 3) unit; zero for fixed parts.
        origin: (P, 3) the axis point nearest to the middle of the part's rest box, relative to the
            center, m; zero unless revolute.
        motion: (T, P) S in [-1, 1] of the part's own joint: q / (2 radius) or q / (2 pi).
        parent: (P,) int8 index of the parent part; -1 for the base.
        limits: (P, 2) lower and upper of the joint, rad or m; zeros for the base.
        movable: (P,) bool."""

    bounds: Floats
    type: NDArray[np.int8]
    axis: Floats
    origin: Floats
    motion: Floats
    parent: NDArray[np.int8]
    limits: Floats
    movable: NDArray[np.bool_]


def targets(
    names: Sequence[str],
    bounds: Sequence[Floats],
    joints: Sequence[Joint],
    states: Sequence[State],
    *,
    center: Floats,
    radius: float,
) -> Targets:
    """Arrays for parts `names` (base first) with rest `bounds` (2, 3), in the object frame."""
    boxes = np.asarray(bounds, float) - center
    count = len(names)
    index = {name: k for k, name in enumerate(names)}
    kind, parent = np.zeros(count, np.int8), np.full(count, -1, np.int8)
    axis, origin, limits = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros((count, 2))
    moved = np.zeros((len(states), count))
    solved = [resolved(joints, state) for state in states]
    for joint in joints:
        k = index[joint.child]
        kind[k], parent[k] = TYPE_IDS[joint.type], index[joint.parent]
        axis[k], limits[k] = joint.axis, travel(joint)
        moved[:, k] = [motion(joint, q[joint.name], radius) for q in solved]
        if kind[k] == REVOLUTE:
            point = np.asarray(joint.origin) - center
            origin[k] = point + ((boxes[k].mean(axis=0) - point) @ axis[k]) * axis[k]
    return Targets(
        bounds=boxes,
        type=kind,
        axis=axis,
        origin=origin,
        motion=moved,
        parent=parent,
        limits=limits,
        movable=kind != FIXED,
    )


def swept_sphere(
    names: Sequence[str], bounds: Sequence[Floats], joints: Sequence[Joint]
) -> tuple[Floats, float]:
    """(center, radius) of a sphere about the rest box's middle that holds every part's box at rest
    and at each end of every joint, one joint at a time."""
    boxes = np.asarray(bounds, float)
    center = (boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2.0
    corners = {
        name: np.array(
            [[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        )
        for name, box in zip(names, boxes, strict=True)
    }
    ends: list[dict[str, float]] = [{}]
    ends += [
        {joint.name: q} for joint in joints for q in (*travel(joint), sum(travel(joint)) / 2.0)
    ]
    ends.append({joint.name: travel(joint)[1] for joint in joints})
    reach = 0.0
    for state in ends:
        poses = forward_kinematics(names[0], joints, state)
        for name in names:
            offsets = apply(poses[name], corners[name]) - center
            reach = max(reach, float(np.linalg.norm(offsets, axis=1).max()))
    return center, reach
