"""Rest: which pose of each joint is the closed one, why, and how sure that is.

Closed is where the object takes the least room: the pose among start, end and as drawn whose box of
the whole object is the smallest. Where that does not tell them apart, the one that touches the
parent more; then the start. What swings freely about its pose as drawn rests there.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.spatial import cKDTree

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.roles import ROLES
from artgen.articulation.types import Joint, Limit
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.transform import apply
from artgen.ingest.foreign import ForeignJoint

TIE = 0.01
"""Boxes whose volumes differ by less than this share are as small as each other."""
CLEAR = 0.05
"""Above this share, the smallest box is the closed one beyond doubt."""
SWING = 0.1
"""Of its range that a joint goes to either side of its pose as drawn and is said to swing."""
NEAR = 0.01
"""Of the object's diagonal: points of child and parent nearer than this touch."""
TOUCHES = 0.02
"""Share of a child's points by which one pose has to touch more than another."""
SWEEPS = 2
"""Times that each joint is decided."""
POINTS = 600
"""Samples of a part's surface."""
DIRECTIONS = 96
"""Directions in which a part's outermost points are kept, for boxes."""

Confidence = Literal["given", "high", "medium", "low"]


@dataclass(frozen=True, kw_only=True)
class Rest:
    """The closed pose of one joint: q as drawn, rad or units."""

    q: float
    reason: str
    confidence: Confidence


@dataclass(frozen=True, kw_only=True, eq=False)
class Outline:
    """Points of one part as drawn: the outermost (N, 3), and samples of its surface (M, 3)."""

    outer: Floats
    surface: Floats


def outline(corners: Floats, name: str) -> Outline:
    """Of (F, 3, 3) triangles; the samples are the same for the same name and triangles."""
    rng = Stream(0, "ingest", "outline", name).generator()
    points = corners.reshape(-1, 3)
    ways = rng.normal(size=(DIRECTIONS, 3))
    ways = np.concatenate([ways, np.eye(3), -np.eye(3)])
    outer = points[np.unique(np.argmax(ways @ points.T, axis=1))]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    chosen = rng.choice(len(corners), POINTS, p=area / area.sum())
    u, v = rng.random((2, POINTS))
    u, v = np.where(u + v > 1.0, [1.0 - u, 1.0 - v], [u, v])
    a, b, c = corners[chosen].transpose(1, 0, 2)
    return Outline(outer=outer, surface=a + u[:, None] * (b - a) + v[:, None] * (c - a))


def found_rests(
    base: str,
    joints: Sequence[ForeignJoint],
    labels: Mapping[str, str],
    outlines: Mapping[str, Outline],
) -> dict[str, Rest]:
    """Joint name to its closed pose; joints are decided from the base outward, each with the others
    where they were decided last: an open door hides what a drawer takes."""
    chain = [drawn_joint(joint) for joint in joints]
    boxes = _Boxes(base, chain, outlines)
    state = {joint.name: 0.0 if joint.start is None else joint.start for joint in joints}
    rests: dict[str, Rest] = {}
    for _ in range(SWEEPS):
        for joint in joints:
            label = labels[joint.child]
            rests[joint.name] = rest = _rest(joint, label, state, boxes)
            state[joint.name] = rest.q
    return rests


def drawn_joint(joint: ForeignJoint) -> Joint:
    """The joint for kinematics alone, at its pose as drawn; its range is not asked here."""
    return Joint(
        name=joint.name,
        type=joint.type,
        parent=joint.parent,
        child=joint.child,
        axis=joint.axis,
        origin=joint.origin,
        limit=None if joint.type == "continuous" else Limit(lower=-1.0, upper=1.0),
        friction=0.0,
        damping=0.0,
        effort=1.0,
    )


class _Boxes:
    """How much room the object takes, and how much a part touches its parent, at a state."""

    def __init__(self, base: str, joints: Sequence[Joint], outlines: Mapping[str, Outline]) -> None:
        self.base, self.joints, self.outlines = base, joints, outlines
        points = np.concatenate([own.outer for own in outlines.values()])
        self.near = NEAR * float(np.linalg.norm(np.ptp(points, axis=0)))

    def volume(self, state: Mapping[str, float]) -> float:
        """Of the box of the whole object; flat ones are as thick as what touches."""
        poses = forward_kinematics(self.base, self.joints, state)
        moved = [apply(poses[name], own.outer) for name, own in self.outlines.items()]
        return float(np.prod(np.ptp(np.concatenate(moved), axis=0) + self.near))

    def touching(self, joint: ForeignJoint, state: Mapping[str, float]) -> float:
        """Share of the child's samples that are near one of the parent's."""
        poses = forward_kinematics(self.base, self.joints, state)
        child = apply(poses[joint.child], self.outlines[joint.child].surface)
        parent = apply(poses[joint.parent], self.outlines[joint.parent].surface)
        distance, _ = cKDTree(parent).query(child, distance_upper_bound=3.0 * self.near)
        return float(np.isfinite(distance).mean())


def _rest(joint: ForeignJoint, label: str, state: Mapping[str, float], boxes: _Boxes) -> Rest:
    closes, known = ROLES[label].closes, label != "part"
    if joint.rest is not None:
        return Rest(q=joint.rest, reason="given by the user", confidence="given")
    if joint.lower is None or joint.upper is None:
        return Rest(q=0.0, reason="it turns without end; as drawn", confidence="high")
    if not closes and _swings(joint):
        reason = "it swings to both sides of its pose as drawn and closes nothing"
        return Rest(q=0.0, reason=reason, confidence="medium")
    start = joint.lower if joint.start is None else joint.start
    end = joint.upper if start == joint.lower else joint.lower
    inside = joint.lower <= 0.0 <= joint.upper
    candidates = [start, end, *([0.0] if inside and 0.0 not in (start, end) else [])]
    volumes = {q: boxes.volume({**state, joint.name: q}) for q in candidates}
    least = min(volumes.values())
    level = [q for q in candidates if volumes[q] <= least * (1.0 + TIE)]
    if len(level) == 1:
        return _smallest(level[0], volumes, start)
    if known and not closes and start in level:
        reason = "boxes alike, and it closes nothing; the start"
        return Rest(q=start, reason=reason, confidence="medium")
    touching = {q: boxes.touching(joint, {**state, joint.name: q}) for q in level}
    most = max(touching.values())
    holding = [q for q in level if touching[q] >= most - TOUCHES]
    if len(holding) == 1 and holding[0] in (start, end):
        reason = f"boxes alike; {_said(holding[0], start)} touches its parent the most"
        return Rest(q=holding[0], reason=reason, confidence="medium")
    if not inside:
        nearer = min((joint.lower, joint.upper), key=abs)
        reason = "boxes and contact alike, and its pose as drawn is out of reach; the nearer end"
        return Rest(q=nearer, reason=reason, confidence="low")
    return Rest(q=start, reason="boxes and contact alike; the start", confidence="low")


def _smallest(q: float, volumes: Mapping[float, float], start: float) -> Rest:
    others = min(volume for other, volume in volumes.items() if other != q)
    more = others / volumes[q] - 1.0
    reason = f"{_said(q, start)} takes the least room; else {more:.0%} more"
    return Rest(q=q, reason=reason, confidence="high" if more > CLEAR else "medium")


def _said(q: float, start: float) -> str:
    return "the start" if q == start else ("its pose as drawn" if q == 0.0 else "the end")


def _swings(joint: ForeignJoint) -> bool:
    """Whether its pose as drawn lies well within its range, and it turns."""
    if joint.lower is None or joint.upper is None or joint.type != "revolute":
        return False
    span = joint.upper - joint.lower
    return min(-joint.lower, joint.upper) > SWING * span
