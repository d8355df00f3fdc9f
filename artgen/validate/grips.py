"""Grips: every file states the same frames, and a hand can take hold there and pull."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from artgen.articulation.grips import grip_frame
from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import required_state
from artgen.articulation.types import Grip, Joint
from artgen.core.errors import ArtgenError
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.export.kinematics import FileGrip, FileKinematics
from artgen.export.layout import MANIFEST, MJCF, URDF
from artgen.export.mjcf import load_kinematics as mjcf_kinematics
from artgen.export.urdf import load_kinematics as urdf_kinematics
from artgen.geometry.distance import inside_bodies, nearest_distance
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.files import EXPORT_ANEW
from artgen.validate.report import Finding

READERS = {URDF: urdf_kinematics, MJCF: mjcf_kinematics}
FINGER = 0.01
"""m; how far outward from a grip's middle the way has to be free for a finger."""
NO_ARM = 0.005
"""m; a grip nearer to its joint's axis is turned between fingers and pulled nowhere."""


def stated(subject: BundleSubject) -> Iterator[Finding]:
    """Names are unique among grips, parts and joints; URDF and MJCF state the manifest's frames."""
    ours = {grip.name: (part.name, grip) for part in subject.bundle.parts for grip in part.grips}
    taken = [part.name for part in subject.parts] + [joint.name for joint in subject.joints]
    taken += [grip.name for part in subject.bundle.parts for grip in part.grips]
    for name in ours:
        if (count := taken.count(name)) > 1:
            yield _finding("structure.grip", name, f"{count} times", "a name of its own",
                           "something else has the same name", "rename the grip")  # fmt: skip
    for file, read in READERS.items():
        try:
            found: FileKinematics = read(subject.folder)
        except (ArtgenError, LookupError, ValueError, StopIteration) as error:
            yield _finding("structure.grip", file, str(error), "frames that can be read",
                           "the file is not as artgen writes it", EXPORT_ANEW)  # fmt: skip
            continue
        yield from _differences(file, {grip.name: grip for grip in found.grips}, ours, subject)


def _differences(
    file: str,
    found: Mapping[str, FileGrip],
    ours: Mapping[str, tuple[str, Grip]],
    subject: BundleSubject,
) -> Iterator[Finding]:
    cause, allowed = f"{file} and {MANIFEST} are of different exports", subject.bounds.agreement
    for name in sorted(set(found) ^ set(ours)):
        where = f"in {file if name in found else MANIFEST} only"
        yield _finding("structure.grip", name, where, "in both files", cause, EXPORT_ANEW)
    for name in sorted(set(found) & set(ours)):
        part, grip = ours[name]
        off = float(np.abs(found[name].frame - grip_frame(grip)).max())
        if found[name].part != part:
            value = f"on {found[name].part} in {file}"
            yield _finding("structure.grip", name, value, f"on {part}", cause, EXPORT_ANEW)
        elif not off <= allowed.value:
            bound = f"{allowed.at_most()} apart from {MANIFEST}"
            yield _finding("structure.grip", name, off, bound, cause, EXPORT_ANEW)


def held(subject: BundleSubject) -> Iterator[Finding]:
    """A grip lies on its part, a finger gets there, and pulling it opens the joint."""
    for part in subject.bundle.parts:
        for grip in part.grips:
            if part.name in subject.meshes:
                yield from _place(subject, part.name, grip)
                yield from _pull(subject, part.name, grip)


def _place(subject: BundleSubject, part: str, grip: Grip) -> Iterator[Finding]:
    near = subject.bounds.grip_near
    away = nearest_distance(subject.meshes[part].triangles, np.array(grip.position))
    if not away <= near.value:
        yield _finding("semantics.grip", grip.name, away, near.at_most(),
                       f"it lies in the air beside {part}", "put it on its part")  # fmt: skip
    joint = next((j for j in subject.joints if j.child == part), None)
    state = required_state(joint.name, subject.preconditions) if joint else {}
    poses = forward_kinematics(subject.parts[0].name, subject.joints, state)
    reach = np.array([(0.0, 0.0, 0.0), np.multiply(FINGER, grip.outward)]) + grip.position
    placed = apply(poses[part], reach)
    for other, mesh in subject.meshes.items():
        points = apply(np.linalg.inv(poses[other]), placed)
        if other != part and inside_bodies(mesh, points).any():
            yield _finding("semantics.grip", grip.name, f"inside {other}", "free to a finger",
                           f"no finger gets {FINGER * 1000:g} mm in front of it",
                           "move it outward, or turn its outward direction")  # fmt: skip


def _pull(subject: BundleSubject, part: str, grip: Grip) -> Iterator[Finding]:
    by_child, least = {j.child: j for j in subject.joints}, subject.bounds.grip_pull
    joint = by_child.get(part)
    if joint is None or np.linalg.norm(way_of(joint, grip)) < NO_ARM:
        return  # The base is carried by such a grip; a knob is turned.
    along = max(_along(j, grip) for j in _carriers(joint, by_child))
    if not along >= least.value:
        yield _finding("semantics.grip", grip.name, along, least.at_least(),
                       f"pulled so, {joint.name} does not open: the cosine between pull and motion",
                       "turn its pull direction along the motion at rest")  # fmt: skip


def _carriers(joint: Joint, by_child: Mapping[str, Joint]) -> Iterator[Joint]:
    """A joint and those that carry it: a roll on a bail turns, and the bail is what one lifts."""
    above: Joint | None = joint
    while above is not None:
        yield above
        above = by_child.get(above.parent)


def _along(joint: Joint, grip: Grip) -> float:
    """Cosine between the pull and how the grip starts to move."""
    way = way_of(joint, grip)
    return float(way @ grip.pull / max(float(np.linalg.norm(way)), 1e-12))


def way_of(joint: Joint, grip: Grip) -> Floats:
    """(3,) how the grip starts to move as the joint opens: m/rad, or of length 1 on a slide."""
    sign = 1.0 if joint.mimic is None else math.copysign(1.0, joint.mimic.multiplier)
    if joint.type == "prismatic":
        return np.multiply(sign, joint.axis)
    return sign * np.cross(joint.axis, np.subtract(grip.position, joint.origin))


def _finding(
    check: str, grip: str, value: float | str, bound: str, cause: str, remedy: str
) -> Finding:
    return Finding(check=check, part=grip, value=value, bound=bound, cause=cause, remedy=remedy)
