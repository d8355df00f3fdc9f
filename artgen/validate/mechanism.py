"""L5: joints sit where what they move turns or slides, and rest at its closed end.

A bundle says what each part is, so a door is asked for a hinge on its edge and a knob is not. What
a stranger's part is nobody says; it is asked for what every part of its kind of motion shows.
"""

import math
import re
from collections.abc import Iterable, Iterator

import numpy as np

from artgen.articulation.roles import ROLES
from artgen.articulation.types import Joint
from artgen.core.mesh import Floats
from artgen.geometry.clearance import Mover, overlaps
from artgen.validate.report import Finding
from artgen.validate.subject import Subject
from artgen.validate.sweep import Sweep, sweep_poses

PUSHES = (0.01, 0.02, 0.04, 0.08, 0.15)
"""Shares of its range by which a joint is pushed beyond its closed stop."""
ALONG = 129
"""Points of an axis at which its distance from a box is taken: 1 % of the box apart."""
PIN_RAYS = 8
"""Lines around an axis, at one and at half the radius of a pin, along which it is looked for."""
FACED = 0.02
"""Share of a part's surface that has to look along a slanted axis; rounded edges have less in any
one direction."""


def closed_at_rest(subject: Subject) -> Iterator[Finding]:
    """No part can be closed further: pushed beyond its stop, it meets its parent before it has come
    nearer to the parent's box.

    Nearer in the mean over its volume, so that a handle that enters an opening does not count.
    """
    bounds = subject.bounds
    for joint in subject.joints:
        if joint.limit is None or joint.mimic is not None or not _has_closed_end(subject, joint):
            continue
        if joint.parent not in subject.shapes or joint.child not in subject.shapes:
            continue  # Told where the mesh level lists parts without a mesh.
        reach = joint.limit.upper - joint.limit.lower
        states = tuple({joint.name: joint.limit.lower - share * reach} for share in PUSHES)
        parent, child = pair = _pair_movers(
            subject, joint, Sweep(joint=joint.name, states=({}, *states))
        )
        distance = distances(parent, child, subject.volumes[joint.child])
        play = distance[0] - distance
        closer = np.flatnonzero(play > bounds.closed_play.value)
        if not len(closer) or _crosses(pair, range(1, closer[0] + 1), bounds.overlap.value):
            continue
        push = closer[0] - 1
        yield Finding(
            check="semantics.closed",
            part=joint.child,
            joint=joint.name,
            state=states[push],
            value=float(play[closer[0]]),
            bound=bounds.closed_play.at_most(),
            cause=f"pushed {PUSHES[push]:.0%} of its range beyond rest it still "
            f"moves freely toward {joint.parent}",
            remedy="state the joint from the closed end",
        )


def _has_closed_end(subject: Subject, joint: Joint) -> bool:
    """Whether its role says so; of a stranger's part, unless it turns both ways alike or is named
    after what closes nothing: a backrest, an arm."""
    role = subject.roles.get(joint.child)
    if role is not None:
        return role.closes
    words = re.findall("[a-z]+", joint.child.lower())
    open_ended = any(word in ROLES and not ROLES[word].closes for word in words)
    return not open_ended and not _rests_in_the_middle(subject, joint)


def _rests_in_the_middle(subject: Subject, joint: Joint) -> bool:
    if joint.limit is None:
        return False
    lower, upper = abs(joint.limit.lower), joint.limit.upper
    return abs(lower - upper) <= subject.bounds.rest_play.value * (lower + upper)


def distances(parent: Mover, child: Mover, volume: Floats) -> Floats:
    """(K,) mean distance of the child's volume from the parent's box at rest, m; bodies count by
    their middles, each by its `volume` (B,) m3."""
    lower, upper = parent.shape.rest[:, 0].min(axis=0), parent.shape.rest[:, 1].max(axis=0)
    middles = child.shape.rest.mean(axis=1)
    moved = middles @ child.poses[:, :3, :3].transpose(0, 2, 1) + child.poses[:, None, :3, 3]
    outside = np.maximum(lower - moved, moved - upper).clip(min=0.0)
    return np.asarray(np.linalg.norm(outside, axis=2) @ volume / volume.sum())


def _pair_movers(subject: Subject, joint: Joint, sweep: Sweep) -> list[Mover]:
    """Parent and child of a joint with their poses over a sweep."""
    poses = sweep_poses(subject.parts[0].name, subject.joints, sweep)
    return [
        Mover(name=name, shape=subject.shapes[name], poses=poses[name])
        for name in (joint.parent, joint.child)
    ]


def _crosses(pair: list[Mover], poses: Iterable[int], allowed: float) -> bool:
    """Whether two movers overlap at one of some poses; the first one decides most often."""
    for pose in poses:
        at = [Mover(name=m.name, shape=m.shape, poses=m.poses[pose : pose + 1]) for m in pair]
        if any(overlap.volume > allowed for overlap in overlaps(at)):
            return True
    return False


def hinges(subject: Subject) -> Iterator[Finding]:
    """What closes by turning has its axis on an edge; what turns otherwise, through itself."""
    bounds = subject.bounds
    for joint in subject.joints:
        role = subject.roles.get(joint.child)
        if joint.child not in subject.meshes or joint.type == "prismatic":
            continue  # Parts without a mesh are told at the mesh level.
        if role is None and joint.type == "continuous":
            continue
        box = subject.boxes[joint.child]
        axis, origin = np.array(joint.axis), np.array(joint.origin)
        diagonal = float(np.linalg.norm(np.diff(box, axis=0)))
        allowed = bounds.hinge_share.value * diagonal + bounds.hinge_slack.value
        if role is not None and role.edged:
            distance = end_distance(box, axis, origin)
            cause = "the pivot lies off the part's edge"
        elif role is None:
            distance = edge_distance(box, axis, origin)
            cause = "the pivot lies off the part's edge"
        else:
            distance = line_distance(box, axis, origin)
            cause = "the pivot lies outside of what it turns"
        if distance is None or distance <= allowed:
            continue
        if role is None and _has_a_pin(subject, joint, bounds.hinge_slack.value):
            continue
        remedy = "check the joint's origin"
        yield _joint_finding(
            "semantics.hinge", joint, distance, f"<= {allowed:.4g} m", cause, remedy
        )


def travels(subject: Subject) -> Iterator[Finding]:
    """What slides out of a room slides at most its length; what else slides stays beside its
    parent."""
    bound = subject.bounds.travel
    for joint in subject.joints:
        if joint.type != "prismatic" or joint.limit is None or joint.child not in subject.boxes:
            continue
        along = np.array(joint.axis)
        length = float(np.abs(along) @ np.diff(subject.boxes[joint.child], axis=0)[0])
        share = (joint.limit.upper - joint.limit.lower) / length
        role = subject.roles.get(joint.child)
        strict = role is not None and role.closes
        if share > bound.value and (strict or _leaves(subject, joint)):
            cause, remedy = "it would leave its rails", "shorten the travel"
            yield _joint_finding("semantics.travel", joint, share, bound.at_most(), cause, remedy)


def _leaves(subject: Subject, joint: Joint) -> bool:
    """Whether a slide ends beyond its parent's box, as seen along its axis."""
    if joint.parent not in subject.boxes or joint.limit is None:
        return True
    spans = []
    for name in (joint.parent, joint.child):
        lower, upper = subject.boxes[name]
        middle, half = (
            (lower + upper) / 2.0 @ joint.axis,
            (upper - lower) / 2.0 @ np.abs(joint.axis),
        )
        spans.append((float(middle - half), float(middle + half)))
    (low, high), (first, last) = spans
    return first + joint.limit.upper > high or last + joint.limit.lower < low


def _has_a_pin(subject: Subject, joint: Joint, radius: float) -> bool:
    """Whether a pin along the axis, of some radius in m, would go through both parts: a knob and
    the panel behind it, an arm's end and its fork."""
    if joint.parent not in subject.meshes:
        return False
    axis, origin = np.array(joint.axis), np.array(joint.origin)
    side, other = across(axis)
    turn = 2.0 * np.pi * np.arange(PIN_RAYS) / PIN_RAYS
    ring = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    rays = np.concatenate([np.zeros((1, 2)), 0.5 * ring, ring])
    spans = (subject.boxes[joint.child] - origin) @ axis
    reach = float(spans.min()) - 2.0 * radius, float(spans.max()) + 2.0 * radius
    for name in (joint.child, joint.parent):
        corners = (subject.meshes[name].triangles - origin) @ np.stack([side, other, axis]).T
        if not meets(corners, rays, reach):
            return False
    return True


def across(axis: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors at right angles to a direction and to each other."""
    side = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    side /= np.linalg.norm(side)
    return side, np.cross(axis, side)


def meets(corners: Floats, rays: Floats, reach: tuple[float, float]) -> bool:
    """Whether a line along z through one of (N, 2) points meets a triangle of (T, 3, 3) corners at
    a height within `reach`."""
    a, b, c = corners.transpose(1, 0, 2)
    low, high = corners.min(axis=1), corners.max(axis=1)
    for x, y in rays:
        near = np.flatnonzero(
            (low[:, 0] <= x) & (x <= high[:, 0]) & (low[:, 1] <= y) & (y <= high[:, 1])
        )
        edges = [(a[near], b[near]), (b[near], c[near]), (c[near], a[near])]
        areas = np.stack(
            [
                (q[:, 0] - p[:, 0]) * (y - p[:, 1]) - (q[:, 1] - p[:, 1]) * (x - p[:, 0])
                for p, q in edges
            ]
        )
        inside = ((areas >= 0.0).all(axis=0) | (areas <= 0.0).all(axis=0)) & (
            areas.sum(axis=0) != 0
        )
        weights = areas[:, inside] / areas[:, inside].sum(axis=0)
        tops = np.stack([c[near, 2], a[near, 2], b[near, 2]])[:, inside]
        heights = (weights * tops).sum(axis=0)
        if ((heights >= reach[0]) & (heights <= reach[1])).any():
            return True
    return False


def rests(subject: Subject) -> Iterator[Finding]:
    """Rest is one end of a joint's way, or the middle of one that turns both ways alike."""
    play = subject.bounds.rest_play
    for joint in subject.joints:
        if joint.limit is None or joint.mimic is not None or _rests_in_the_middle(subject, joint):
            continue
        lower, upper = abs(joint.limit.lower), joint.limit.upper
        inside = min(lower, upper) / (lower + upper)
        if inside > play.value:
            cause, remedy = "it rests ajar", "state the joint from its closed end"
            yield _joint_finding("semantics.rest", joint, inside, play.at_most(), cause, remedy)


def axes(subject: Subject) -> Iterator[Finding]:
    """An axis runs along a side of the boxes, or is slanted for all to see, or square to a face of
    its part as a knob's on a sloping panel; not slightly off."""
    slip, slant = subject.bounds.axis_slip, subject.bounds.axis_slant
    for joint in subject.joints:
        off = math.degrees(math.acos(min(1.0, max(abs(a) for a in joint.axis))))
        if joint.limit is None or not slip.value < off < slant.value:
            continue
        if _facing(subject, joint) < FACED:
            bound = f"{slip.at_most()}, or {slant.at_least()}"
            cause, remedy = "its axis is off by a little", "run it along the edge it turns about"
            yield _joint_finding("semantics.tilt", joint, off, bound, cause, remedy)


def _facing(subject: Subject, joint: Joint) -> float:
    """Share of a part's surface that looks along its joint's axis, either way."""
    if joint.child not in subject.meshes:
        return 0.0
    a, b, c = subject.meshes[joint.child].triangles.transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    along = np.abs(normals @ joint.axis)
    facing = along >= math.cos(math.radians(subject.bounds.axis_slip.value)) * areas
    return float(areas[facing].sum() / areas.sum())


def _joint_finding(
    check: str, joint: Joint, value: float, bound: str, cause: str, remedy: str
) -> Finding:
    return Finding(
        check=check,
        part=joint.name,
        joint=joint.name,
        value=value,
        bound=bound,
        cause=cause,
        remedy=remedy,
    )


def edge_distance(box: Floats, axis: Floats, origin: Floats) -> float | None:
    """From a line along a coordinate axis to a box's nearest parallel edge, m; None if tilted."""
    along = int(np.argmax(np.abs(axis)))
    if abs(axis[along]) < 1.0 - 1e-9:
        return None
    others = [k for k in range(3) if k != along]
    gaps = np.abs(box[:, others] - origin[others]).min(axis=0)
    return float(np.linalg.norm(gaps))


def end_distance(box: Floats, axis: Floats, origin: Floats) -> float | None:
    """From a line along a coordinate axis to the nearer end of a box's longer side across it.

    Leaves with handles before and bins behind them are thicker than the edge that they turn about.
    """
    along = int(np.argmax(np.abs(axis)))
    if abs(axis[along]) < 1.0 - 1e-9:
        return None
    extent = np.where(np.arange(3) == along, -1.0, np.diff(box, axis=0)[0])
    across = int(np.argmax(extent))
    thick = 3 - along - across
    end = np.abs(box[:, across] - origin[across]).min()
    outside = max(box[0, thick] - origin[thick], origin[thick] - box[1, thick], 0.0)
    return float(np.hypot(end, outside))


def line_distance(box: Floats, axis: Floats, origin: Floats) -> float:
    """From a line to the nearest point of a box, m; within 1 % of the box's diagonal."""
    lower, upper = box
    reach = float(np.linalg.norm(upper - lower)) / 2.0
    middle = float(((lower + upper) / 2.0 - origin) @ axis)
    points = origin + np.linspace(middle - reach, middle + reach, ALONG)[:, None] * axis
    outside = np.maximum(lower - points, points - upper).clip(min=0.0)
    return float(np.linalg.norm(outside, axis=1).min())
