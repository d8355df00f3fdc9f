"""L0: the files of an asset state one and the same tree, and it can work.

No URDF loader does this: of 23 planted defects MuJoCo accepts 14, and six are accepted by all of
eight loaders.
"""

import math
from collections import Counter
from collections.abc import Iterator

import numpy as np

from artgen.articulation.roles import ROLES
from artgen.core.errors import ArtgenError
from artgen.export.layout import MANIFEST, URDF
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.files import EXPORT_ANEW
from artgen.validate.report import Finding
from artgen.validate.stated import StatedJoint, manifest_joints, urdf_joints
from artgen.validate.subject import Subject

MOVING = ("revolute", "continuous", "prismatic")


def tree(subject: Subject) -> Iterator[Finding]:
    """In each file: unique names, and one tree from one root, each part moved by one joint."""
    for file, names in subject.stated_links.items():
        joints = [joint for joint in subject.stated_joints if joint.file == file]
        named = [joint.name for joint in joints]
        for own in ([*names, *named],) if subject.lacks("manifest") is None else (names, named):
            for name, count in Counter(own).items():
                if count > 1 or not name:
                    shown = name or "(no name)"
                    yield _tree_finding(file, shown, f"{count} times", "a name of its own")
        yield from _hanging(file, names, joints)


def _hanging(file: str, names: list[str], joints: list[StatedJoint]) -> Iterator[Finding]:
    known, children = set(names), Counter(joint.child for joint in joints)
    roots = [name for name in names if name not in children]
    if len(roots) != 1:
        yield _tree_finding(file, ", ".join(roots) or "(none)", f"{len(roots)} roots", "1 root")
    below: dict[str, set[str]] = {}
    for joint in joints:
        below.setdefault(joint.parent, set()).add(joint.child)
        for end in (joint.parent, joint.child):
            if end not in known:
                yield _tree_finding(file, joint.name, f"names {end!r}", "a part of the file")
        if children[joint.child] > 1:
            yield _tree_finding(file, joint.child, "moved by several joints", "1 joint")
    reached, waiting = set(roots), list(roots)
    while waiting:
        new = below.get(waiting.pop(), set()) - reached
        reached |= new
        waiting += new
    for name in sorted(known - reached):
        yield _tree_finding(file, name, "not reachable from the root", "part of the tree")


def _tree_finding(file: str, part: str, value: str, bound: str) -> Finding:
    return Finding(
        check="structure.tree",
        part=part,
        value=value,
        bound=bound,
        cause=f"the parts of {file} do not form one tree",
        remedy="name each part and joint once, and move each part but one by one joint",
    )


def links(subject: BundleSubject) -> Iterator[Finding]:
    """Every link has mass properties, collision and a visual; loaders invent what is missing."""
    for link in subject.robot.iterfind("link"):
        for tag in ("inertial", "collision", "visual"):
            if link.find(tag) is None:
                yield missing_element(link.get("name", ""), tag)


def complete(subject: Subject) -> Iterator[Finding]:
    """Every part that moves, or has a shape, has mass properties, collision and a visual."""
    seen, touched = subject.meshes, subject.collision
    moved = {joint.child for joint in subject.joints}
    for part in subject.parts:
        if part.name not in subject.links or part.name not in moved | set(seen) | set(touched):
            continue  # Between two joints of one body, or a frame that nothing hangs on.
        has = {
            "inertial": part.mass is not None,
            "collision": part.name in touched,
            "visual": part.name in seen,
        }
        yield from (missing_element(part.name, tag) for tag, there in has.items() if not there)


def missing_element(part: str, tag: str) -> Finding:
    """A link lacks what simulators need."""
    return Finding(
        check="structure.link",
        part=part,
        value=f"no <{tag}>",
        bound=f"<{tag}>",
        cause="simulators then guess it, each differently",
        remedy=f"state the link's <{tag}>",
    )


def axes(subject: Subject) -> Iterator[Finding]:
    """Axes are finite unit vectors; MuJoCo would normalize any length, and take nan."""
    bounds = subject.bounds
    ours = subject.lacks("manifest") is None
    bound = (bounds.axis_norm if ours else bounds.axis_norm_foreign).value
    for joint in subject.stated_joints:
        norm = math.hypot(*joint.axis)
        if joint.moves and (len(joint.axis) != 3 or not abs(norm - 1.0) <= bound):
            cause = f"axis {joint.axis} is no unit vector"
            yield _joint_finding(
                "structure.axis", joint, norm, f"length 1 within {bound:g}", cause, "normalize it"
            )
        if len(joint.origin) != 3 or not np.isfinite(joint.origin).all():
            value, cause = str(joint.origin), "the pivot is undefined"
            yield _joint_finding(
                "structure.origin", joint, value, "three finite numbers", cause, "state the origin"
            )


def limits(subject: Subject) -> Iterator[Finding]:
    """Known type; finite lower <= 0 < upper; at most one turn for a hinge. In a bundle lower = 0,
    as rest is closed; what closes nothing may turn both ways alike, and a stranger's as it may."""
    turn = subject.bounds.full_turn
    ours = subject.lacks("manifest") is None
    closing = _closing(subject) if isinstance(subject, BundleSubject) else frozenset()
    known = MOVING if ours else (*MOVING, "fixed")
    for joint in subject.stated_joints:
        if joint.type not in known:
            cause = f"only {', '.join(known)} joints are judged"
            remedy = "merge fixed parts into one" if ours else "split it into joints of one axis"
            yield _joint_finding("structure.type", joint, joint.type, "a known type", cause, remedy)
        if not joint.limited:
            continue
        span = joint.upper - joint.lower
        if not joint.lower < joint.upper or math.isinf(joint.lower) or math.isinf(joint.upper):
            cause, remedy = "MuJoCo takes this as no limit at all", "write the smaller bound first"
            value = f"[{joint.lower!r}, {joint.upper!r}]"
            yield _joint_finding(
                "structure.limit", joint, value, "finite lower < upper", cause, remedy
            )
        elif (
            ours
            and not subject.origin.foreign
            and joint.lower not in ((0.0,) if joint.child in closing else (0.0, -joint.upper))
        ):
            cause, remedy = "rest must be closed", "put the closed end at 0 and let +q open"
            yield _joint_finding("structure.rest", joint, joint.lower, "lower = 0", cause, remedy)
        elif not joint.lower <= 0.0 <= joint.upper:
            value, cause = f"[{joint.lower!r}, {joint.upper!r}]", "rest, q = 0, is out of reach"
            remedy = "shift the joint's origin so that rest is 0"
            yield _joint_finding("structure.rest", joint, value, "0 inside", cause, remedy)
        if joint.type == "revolute" and span > turn.value:
            cause, remedy = "degrees written for radians, or a continuous joint", "write radians"
            yield _joint_finding("structure.turn", joint, span, turn.at_most(), cause, remedy)
        elif joint.type == "revolute" and 0.0 < span < subject.bounds.least_turn.value:
            cause, remedy = "radians read as degrees", "state the unit of angles"
            bound = subject.bounds.least_turn.at_least()
            yield _joint_finding("structure.turn", joint, span, bound, cause, remedy)


def _closing(subject: BundleSubject) -> frozenset[str]:
    """Parts that shut something, by the manifest's labels as they stand."""
    labels = {
        str(part.get("name")): part.get("label")
        for part in subject.manifest["parts"]
        if isinstance(part, dict)
    }
    closing = {word for word, role in ROLES.items() if role.closes}
    return frozenset(name for name, label in labels.items() if label in closing)


CAUSES = {
    "effort": "0 means no limit to MuJoCo and an immobile joint to others",
    "velocity": "controllers need a limit",
    "friction": "negative friction drives the joint",
    "damping": "negative damping makes the simulation diverge without a warning",
}


def dynamics(subject: Subject) -> Iterator[Finding]:
    """Effort and velocity > 0, friction and damping >= 0, all finite."""
    for joint in subject.stated_joints:
        if not joint.moves:
            continue
        for name, cause in CAUSES.items():
            value = getattr(joint, name)
            positive = name in ("effort", "velocity")
            enough = value is not None and (value > 0.0 if positive else value >= 0.0)
            if value is None or (enough and math.isfinite(value)):
                continue
            bound = "> 0 and finite" if positive else ">= 0 and finite"
            yield _joint_finding(
                f"structure.{name}", joint, value, bound, cause, f"state the joint's {name}"
            )


def _joint_finding(
    check: str, joint: StatedJoint, value: float | str, bound: str, cause: str, remedy: str
) -> Finding:
    return Finding(
        check=check,
        part=joint.label,
        joint=joint.name,
        value=value,
        bound=bound,
        cause=cause,
        remedy=remedy,
    )


AGREE = ("type", "parent", "child", "axis", "lower", "upper", "friction", "damping", "effort",
         "velocity")  # fmt: skip


def agreement(subject: BundleSubject) -> Iterator[Finding]:
    """URDF and manifest state the same joints, number for number, and as many contact pieces."""
    yield from _piece_counts(subject)
    stated = {joint.name: joint for joint in urdf_joints(URDF, subject.robot)}
    ours = {joint.name: joint for joint in manifest_joints(MANIFEST, subject.manifest)}
    for name in sorted(set(stated) ^ set(ours)):
        file = URDF if name in stated else MANIFEST
        yield _agreement_finding(name, f"in {file} only", "in both files")
    for name in sorted(set(stated) & set(ours)):
        for field in AGREE:
            found, expected = getattr(stated[name], field), getattr(ours[name], field)
            same = found == expected or (found != found and expected != expected)
            if not same:
                bound = f"{field} = {expected} as in {MANIFEST}"
                yield _agreement_finding(stated[name].label, str(found), bound)


def _piece_counts(subject: BundleSubject) -> Iterator[Finding]:
    counts = {
        link.get("name"): len(link.findall("collision")) for link in subject.robot.iterfind("link")
    }
    for entry in subject.manifest["parts"]:
        if not isinstance(entry, dict) or not isinstance(entry.get("collision"), list):
            continue  # Reported where the manifest is read as typed values.
        name, found = str(entry.get("name")), len(entry["collision"])
        if found != counts.get(name, found):
            bound = f"{counts[name]} contact pieces as in {URDF}"
            yield _agreement_finding(name, float(found), bound)


def _agreement_finding(part: str, value: float | str, bound: str) -> Finding:
    return Finding(
        check="structure.agreement",
        part=part,
        value=value,
        bound=bound,
        cause="one of the files was edited or is of another export",
        remedy=EXPORT_ANEW,
    )


def typed(subject: Subject) -> Iterator[Finding]:
    """The asset reads as typed values: tree, joints, preconditions, parts."""
    try:
        subject.parts, subject.joints, subject.preconditions  # noqa: B018  (reading is the test)
    except (ArtgenError, LookupError, TypeError, ValueError) as error:
        ours = subject.lacks("manifest") is None
        yield Finding(
            check="structure.manifest" if ours else "structure.model",
            part=MANIFEST if ours else subject.source.file.name,
            value=str(error),
            bound="parts and joints that can be read",
            cause="its numbers do not make rigid parts on joints",
            remedy=EXPORT_ANEW if ours else "mend the file",
        )
