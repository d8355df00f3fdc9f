"""L5: the object is what its category says: parts in order, closed at rest, of real size."""

import math
from collections.abc import Iterable, Iterator, Mapping
from functools import cache

import numpy as np

from artgen.articulation.canonical import canonical_order
from artgen.articulation.roles import ROLES, Role
from artgen.articulation.types import Joint
from artgen.core.errors import RuleError
from artgen.core.mesh import Floats
from artgen.geometry.clearance import Mover, overlaps
from artgen.rules import Band, CategoryRule, load_rule
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.report import Finding, Skipped
from artgen.validate.subject import Subject
from artgen.validate.sweep import Sweep, sweep_poses

PUSHES = (0.01, 0.02, 0.04, 0.08, 0.15)
"""Shares of its range by which a joint is pushed beyond its closed stop."""


def order(subject: Subject) -> Iterator[Finding]:
    """Parts stand in canonical order: low to high, front to back, left to right."""
    parts = subject.parts
    expected = canonical_order([subject.boxes[part.name] for part in parts])
    for place, index in enumerate(expected):
        if place != index:
            yield _finding(
                "semantics.order",
                parts[index].name,
                f"place {index}",
                f"place {place}",
                "training targets follow this order",
                "canonicalize before finishing",
            )


def _finding(
    check: str, part: str, value: float | str, bound: str, cause: str, remedy: str
) -> Finding:
    return Finding(check=check, part=part, value=value, bound=bound, cause=cause, remedy=remedy)


def ground(subject: Subject) -> Iterator[Finding]:
    """The object stands on z = 0, centered in x and y."""
    lower, upper = object_bounds(subject)
    middle = (lower + upper) / 2.0
    allowed = subject.bounds.ground.value
    for axis, value in (("x", middle[0]), ("y", middle[1]), ("z", lower[2])):
        if abs(value) > allowed:
            yield _finding(
                "semantics.ground",
                "object",
                float(value),
                f"0 within {allowed:g} m along {axis}",
                "cameras and simulators expect it there",
                "canonicalize before finishing",
            )


def together(subject: Subject) -> Iterator[Finding]:
    """No part floats far from all others at rest; the diagonal is that of the others together."""
    allowed = subject.bounds.apart
    boxes = subject.boxes
    for name, box in boxes.items():
        others = [other for rest, other in boxes.items() if rest != name]
        if not others:
            return
        gaps = [np.maximum(box[0] - other[1], other[0] - box[1]).clip(min=0.0) for other in others]
        nearest = min(float(np.linalg.norm(gap)) for gap in gaps)
        lower, upper = np.min(others, axis=0)[0], np.max(others, axis=0)[1]
        share = nearest / float(np.linalg.norm(upper - lower))
        if not share <= allowed.value:
            yield _finding(
                "semantics.apart",
                name,
                share,
                allowed.at_most(),
                f"{nearest:.3g} m of air lie between it and all other parts at rest",
                "look for a pivot in another unit, or a mesh that was not moved to its frame",
            )


def object_bounds(subject: Subject) -> Floats:
    """(2, 3) bounds of all visual meshes at rest, m."""
    boxes = np.array(list(subject.boxes.values()))
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def bands(subject: BundleSubject) -> Iterator[Finding | Skipped]:
    """Width, depth, height and mass lie in the category's bands."""
    category = subject.bundle.category
    try:
        rule = packaged_rule(category)
    except RuleError as error:
        yield Skipped(name="semantics.band", reason=f"no bands for {category!r}: {error}")
        return
    width, depth, height = np.diff(object_bounds(subject), axis=0)[0].tolist()
    mass = sum(part.mass.mass for part in subject.bundle.parts)
    found = {"width": width, "depth": depth, "height": height, "mass": mass}
    yield from band_findings(rule.file, found, rule.bands)


@cache
def packaged_rule(category: str) -> CategoryRule:
    """The rule that comes with the package; it cannot change while a process runs."""
    return load_rule(category)


def band_findings(
    file: str, found: Mapping[str, float], allowed: Mapping[str, Band]
) -> Iterator[Finding]:
    """Each measure against its band (m, kg)."""
    for name, band in allowed.items():
        if found[name] not in band:
            unit = "kg" if name == "mass" else "m"
            yield _finding(
                f"semantics.{name}",
                "object",
                found[name],
                f"{band.lower:g} to {band.upper:g} {unit}",
                f"outside [band.{name}] of {file}",
                "narrow the ranges that it follows from",
            )


def closed_at_rest(subject: Subject) -> Iterator[Finding]:
    """No part can be closed further: pushed beyond its stop, it meets its parent before it has come
    nearer to the parent's box.

    Nearer in the mean over its volume, so that a handle that enters an opening does not count.
    """
    bounds = subject.bounds
    for joint in subject.joints:
        if joint.limit is None or joint.mimic is not None or not _closes(subject, joint):
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
    """A hinge's axis lies on an edge of its part's box, or through it where the part's role allows;
    what slides out of an opening is no shorter than its way."""
    bounds = subject.bounds
    for joint in subject.joints:
        if joint.child not in subject.meshes:
            continue  # Told where the mesh level lists parts without a mesh.
        box = subject.boxes[joint.child]
        role = role_at(subject, joint.child)
        if joint.type == "prismatic" and joint.limit is not None and _closes(subject, joint):
            length = float(np.abs(joint.axis) @ np.diff(box, axis=0)[0])
            share = (joint.limit.upper - joint.limit.lower) / length
            if share > bounds.travel.value:
                cause, remedy = "it would leave its rails", "shorten the travel"
                yield _hinge_finding(
                    "semantics.travel", joint, share, bounds.travel.at_most(), cause, remedy
                )
        elif joint.type == "revolute":
            measure = edge_distance if role is None or role.edged else outside_distance
            distance = measure(box, np.array(joint.axis), np.array(joint.origin))
            diagonal = float(np.linalg.norm(np.diff(box, axis=0)))
            allowed = bounds.hinge_share.value * diagonal + bounds.hinge_slack.value
            if distance is not None and distance > allowed:
                where = "off the part's edge" if measure is edge_distance else "beside the part"
                cause, remedy = f"the pivot lies {where}", "check the joint's origin"
                yield _hinge_finding(
                    "semantics.hinge", joint, distance, f"<= {allowed:.4g} m", cause, remedy
                )


def role_at(subject: Subject, part: str) -> Role | None:
    """The role of a part of ours; None in foreign assets, whose names promise nothing."""
    if not isinstance(subject, BundleSubject):
        return None
    return next((ROLES.get(p.label) for p in subject.parts if p.name == part), None)


def _closes(subject: Subject, joint: Joint) -> bool:
    role = role_at(subject, joint.child)
    return role is None or role.closes


def rests(subject: Subject) -> Iterator[Finding]:
    """Rest is one end of a joint's way, or the middle of one that turns both ways alike."""
    play = subject.bounds.rest_play
    for joint in subject.joints:
        if joint.limit is None or joint.mimic is not None:
            continue
        lower, upper = abs(joint.limit.lower), joint.limit.upper
        inside, apart = min(lower, upper) / (lower + upper), abs(lower - upper) / (lower + upper)
        if inside > play.value and apart > play.value:
            cause, remedy = "it rests ajar", "state the joint from its closed end"
            yield _hinge_finding("semantics.rest", joint, inside, play.at_most(), cause, remedy)


def axes(subject: Subject) -> Iterator[Finding]:
    """An axis runs along a side of the boxes, or is slanted for all to see; not slightly off."""
    slip, slant = subject.bounds.axis_slip, subject.bounds.axis_slant
    for joint in subject.joints:
        off = math.degrees(math.acos(min(1.0, max(abs(a) for a in joint.axis))))
        if joint.limit is not None and slip.value < off < slant.value:
            bound = f"{slip.at_most()}, or {slant.at_least()}"
            cause, remedy = "its axis is off by a little", "run it along the edge it turns about"
            yield _hinge_finding("semantics.tilt", joint, off, bound, cause, remedy)


def _hinge_finding(
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


def outside_distance(box: Floats, axis: Floats, origin: Floats) -> float | None:
    """From a line along a coordinate axis to a box, m; 0 if it passes through, None if tilted."""
    along = int(np.argmax(np.abs(axis)))
    if abs(axis[along]) < 1.0 - 1e-9:
        return None
    others = [k for k in range(3) if k != along]
    low, high = box[:, others]
    gap = np.maximum(low - origin[others], origin[others] - high).clip(min=0.0)
    return float(np.linalg.norm(gap))


def edge_distance(box: Floats, axis: Floats, origin: Floats) -> float | None:
    """From a line along a coordinate axis to a box's nearest parallel edge, m; None if tilted."""
    along = int(np.argmax(np.abs(axis)))
    if abs(axis[along]) < 1.0 - 1e-9:
        return None
    others = [k for k in range(3) if k != along]
    gaps = np.abs(box[:, others] - origin[others]).min(axis=0)
    return float(np.linalg.norm(gaps))
