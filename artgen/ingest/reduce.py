"""Reduce: parts that cannot or need not move on their own become part of what carries them."""

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from artgen.core.errors import IngestError
from artgen.ingest.foreign import ForeignJoint, ForeignObject

STILL = 1e-6
"""rad or units: a joint of less range does not move."""


def without_still_joints(obj: ForeignObject) -> ForeignObject:
    """Parts whose joint has no range are fixed to their parents; each is told."""
    still = {
        joint.child: f"{joint.child} ({joint.name}): limits [{joint.lower:g}, {joint.upper:g}]"
        for joint in obj.joints
        if joint.lower is not None and joint.upper is not None
        if joint.upper - joint.lower < STILL
    }
    doubts = tuple(f"{line}; fixed, as it has no range" for line in still.values())
    return dataclasses.replace(fixed(obj, list(still)), doubts=(*obj.doubts, *doubts))


def capped(obj: ForeignObject, sizes: Mapping[str, float], *, most: int) -> ForeignObject:
    """The smallest parts that carry no other are fixed to their parents until `most` are left.

    Args:
        sizes: length of each part, any unit.

    Raises:
        IngestError: fewer than two parts are allowed.
    """
    if most < 1:
        raise IngestError(f"--max-parts {most}: an object has at least one part")
    count, gone = len(obj.parts), list[str]()
    joints = {joint.child: joint for joint in obj.joints}
    while count - len(gone) > most:
        carrying = {joint.parent for child, joint in joints.items() if child not in gone}
        leaves = [name for name in joints if name not in gone and name not in carrying]
        gone.append(min(leaves, key=lambda name: (sizes[name], name)))
    if not gone:
        return obj
    said = f"{len(gone)} of {count} parts, the smallest, are fixed: at most {most} are kept"
    return dataclasses.replace(fixed(obj, gone), doubts=(*obj.doubts, said))


def fixed(obj: ForeignObject, children: Sequence[str]) -> ForeignObject:
    """Some parts made one with their parents, as drawn."""
    if not children:
        return obj
    carrier = {joint.child: joint.parent for joint in obj.joints if joint.child in set(children)}

    def owner(name: str) -> str:
        while name in carrier:
            name = carrier[name]
        return name

    parts = []
    for part in obj.parts:
        if part.name not in carrier:
            own = [other for other in obj.parts if owner(other.name) == part.name]
            shapes = tuple(shape for other in own for shape in other.shapes)
            masses = [other.mass for other in own if other.mass is not None]
            mass = sum(masses) if masses else None
            parts.append(dataclasses.replace(part, shapes=shapes, mass=mass))
    joints = [
        dataclasses.replace(joint, parent=owner(joint.parent))
        for joint in obj.joints
        if joint.child not in carrier
    ]
    return dataclasses.replace(obj, parts=tuple(parts), joints=tuple(joints))


def bounded_slides(
    joints: Sequence[ForeignJoint], reach: Mapping[str, float]
) -> tuple[tuple[ForeignJoint, ...], tuple[str, ...]]:
    """Slides without stops get a range of half the part's length along the axis, and lines that
    tell; `reach` is that length, units."""
    found, doubts = [], []
    for joint in joints:
        if joint.type == "prismatic" and (joint.lower is None or joint.upper is None):
            half = max(float(np.round(reach[joint.child] / 2.0, 6)), 1e-3)
            joint = dataclasses.replace(joint, lower=0.0, upper=half, start=0.0)
            doubts.append(f"{joint.child} slides without stops; half its length is assumed")
        found.append(joint)
    return tuple(found), tuple(doubts)
