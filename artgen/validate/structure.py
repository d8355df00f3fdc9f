"""L0: URDF and manifest state one and the same tree, and it can work.

No URDF loader does this: of 23 planted defects MuJoCo accepts 14, and six are accepted by all of
eight loaders.
"""

import math
from collections import Counter
from collections.abc import Iterator

import numpy as np

from artgen.core.errors import ArtgenError
from artgen.export.layout import MANIFEST, URDF
from artgen.validate import bounds
from artgen.validate.report import Finding
from artgen.validate.stated import StatedJoint, manifest_joints, urdf_joints
from artgen.validate.subject import Subject

TYPES = ("revolute", "continuous", "prismatic")


def joints_of(subject: Subject) -> list[StatedJoint]:
    """Joints of the manifest, then of the URDF."""
    return manifest_joints(MANIFEST, subject.manifest) + urdf_joints(URDF, subject.urdf)


def tree(subject: Subject) -> Iterator[Finding]:
    """In each file: unique names, and one tree from one root, each part moved by one joint."""
    links = {
        MANIFEST: [str(part.get("name")) for part in subject.manifest["parts"]],
        URDF: [link.get("name", "") for link in subject.urdf.iterfind("link")],
    }
    for file, names in links.items():
        joints = [joint for joint in joints_of(subject) if joint.file == file]
        for name, count in Counter([*names, *(j.name for j in joints)]).items():
            if count > 1 or not name:
                yield _tree_finding(
                    file, name or "(no name)", f"{count} times", "a name of its own"
                )
        yield from _hanging(file, names, joints)


def _hanging(file: str, names: list[str], joints: list[StatedJoint]) -> Iterator[Finding]:
    children = Counter(joint.child for joint in joints)
    roots = [name for name in names if name not in children]
    if len(roots) != 1:
        yield _tree_finding(file, ", ".join(roots) or "(none)", f"{len(roots)} roots", "1 root")
    for joint in joints:
        for end in (joint.parent, joint.child):
            if end not in names:
                yield _tree_finding(file, joint.name, f"names {end!r}", "a part of the file")
        if children[joint.child] > 1:
            yield _tree_finding(file, joint.child, "moved by several joints", "1 joint")
    reached, waiting = set(roots), list(roots)
    while waiting:
        parent = waiting.pop()
        new = {joint.child for joint in joints if joint.parent == parent} - reached
        reached |= new
        waiting += new
    for name in sorted(set(names) - reached):
        yield _tree_finding(file, name, "not reachable from the root", "part of the tree")


def _tree_finding(file: str, part: str, value: str, bound: str) -> Finding:
    message = f"the parts of {file} do not form one tree; export the asset anew"
    return Finding(check="structure.tree", part=part, value=value, bound=bound, message=message)


def links(subject: Subject) -> Iterator[Finding]:
    """Every link has mass properties, collision and a visual; loaders invent what is missing."""
    for link in subject.urdf.iterfind("link"):
        for tag in ("inertial", "collision", "visual"):
            if link.find(tag) is None:
                yield Finding(
                    check="structure.link",
                    part=link.get("name", ""),
                    value=f"no <{tag}>",
                    bound=f"<{tag}>",
                    message="simulators then guess it, each differently; export the asset anew",
                )


def axes(subject: Subject) -> Iterator[Finding]:
    """Axes are finite unit vectors; MuJoCo would normalize any length, and take nan."""
    for joint in joints_of(subject):
        norm = math.sqrt(sum(a * a for a in joint.axis))
        if len(joint.axis) != 3 or not abs(norm - 1.0) <= bounds.AXIS_NORM.value:
            yield Finding(
                check="structure.axis",
                part=joint.label,
                value=norm,
                bound=f"length 1 within {bounds.AXIS_NORM.value:g}",
                message=f"axis {joint.axis} is no unit vector; normalize it in the builder",
            )
        if len(joint.origin) != 3 or not np.isfinite(joint.origin).all():
            yield Finding(
                check="structure.origin",
                part=joint.label,
                value=str(joint.origin),
                bound="three finite numbers",
                message="the pivot is undefined; check the builder's joint",
            )


def limits(subject: Subject) -> Iterator[Finding]:
    """Known type; finite lower = 0 < upper, as rest is closed; at most one turn for a hinge."""
    for joint in joints_of(subject):
        if joint.type not in TYPES:
            message = f"only {', '.join(TYPES)} joints move; merge fixed parts into one"
            yield _joint_finding("structure.type", joint, joint.type, "a moving type", message)
        if not joint.limited:
            continue
        if not joint.lower < joint.upper or math.isinf(joint.lower) or math.isinf(joint.upper):
            message = "MuJoCo takes this as no limit at all; write the smaller bound first"
            value = f"[{joint.lower!r}, {joint.upper!r}]"
            yield _joint_finding("structure.limit", joint, value, "finite lower < upper", message)
        elif joint.lower != 0.0:
            message = "rest must be closed: put the closed end at 0 and let +q open"
            yield _joint_finding("structure.rest", joint, joint.lower, "lower = 0", message)
        if joint.type == "revolute" and joint.upper - joint.lower > bounds.FULL_TURN.value:
            message = "degrees written for radians, or a continuous joint"
            span = joint.upper - joint.lower
            yield _joint_finding("structure.turn", joint, span, bounds.FULL_TURN.at_most(), message)


def dynamics(subject: Subject) -> Iterator[Finding]:
    """Effort and velocity > 0, friction and damping >= 0, all finite."""
    for joint in joints_of(subject):
        for name in ("effort", "velocity", "friction", "damping"):
            value = getattr(joint, name)
            positive = name in ("effort", "velocity")
            if math.isfinite(value) and (value > 0.0 if positive else value >= 0.0):
                continue
            message = {
                "effort": "0 means no limit to MuJoCo and an immobile joint to others",
                "velocity": "controllers need a limit",
                "friction": "negative friction drives the joint",
                "damping": "negative damping makes the simulation diverge without a warning",
            }[name]
            bound = "> 0 and finite" if positive else ">= 0 and finite"
            yield _joint_finding(f"structure.{name}", joint, value, bound, message)


def _joint_finding(
    check: str, joint: StatedJoint, value: float | str, bound: str, message: str
) -> Finding:
    return Finding(check=check, part=joint.label, value=value, bound=bound, message=message)


AGREE = ("type", "parent", "child", "axis", "lower", "upper", "friction", "damping", "effort",
         "velocity")  # fmt: skip


def agreement(subject: Subject) -> Iterator[Finding]:
    """URDF and manifest state the same joints, number for number, and as many contact pieces."""
    yield from _piece_counts(subject)
    stated = {joint.name: joint for joint in urdf_joints(URDF, subject.urdf)}
    ours = {joint.name: joint for joint in manifest_joints(MANIFEST, subject.manifest)}
    for name in sorted(set(stated) ^ set(ours)):
        yield Finding(
            check="structure.agreement",
            part=name,
            value=f"in {URDF if name in stated else MANIFEST} only",
            bound="in both files",
            message="one of the files is of another export; export the asset anew",
        )
    for name in sorted(set(stated) & set(ours)):
        for field in AGREE:
            found, expected = getattr(stated[name], field), getattr(ours[name], field)
            same = found == expected or (found != found and expected != expected)
            if not same:
                yield Finding(
                    check="structure.agreement",
                    part=stated[name].label,
                    value=str(found),
                    bound=f"{field} = {expected} as in {MANIFEST}",
                    message="one of the files was edited; export the asset anew",
                )


def _piece_counts(subject: Subject) -> Iterator[Finding]:
    counts = {
        link.get("name"): len(link.findall("collision")) for link in subject.urdf.iter("link")
    }
    for entry in subject.manifest["parts"]:
        if not isinstance(entry, dict) or not isinstance(entry.get("collision"), list):
            continue  # Reported where the manifest is read as typed values.
        name, found = str(entry.get("name")), len(entry["collision"])
        if found != counts.get(name, found):
            yield Finding(
                check="structure.agreement",
                part=name,
                value=float(found),
                bound=f"{counts[name]} contact pieces as in {URDF}",
                message="one of the files was edited; export the asset anew",
            )


def typed(subject: Subject) -> Iterator[Finding]:
    """The manifest reads as typed values: tree, joints, preconditions, parts."""
    try:
        subject.bundle  # noqa: B018  (reading is the test)
    except (ArtgenError, LookupError, TypeError, ValueError) as error:
        yield Finding(
            check="structure.manifest",
            part=MANIFEST,
            value=str(error),
            bound="a manifest that read_bundle accepts",
            message="export the asset anew",
        )
