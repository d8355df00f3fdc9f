"""What else is drawn for an object: joints that open less far, fronts that are pushed to open."""

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from artgen.articulation.types import Grip, Joint, Limit
from artgen.assembly.choice import Group
from artgen.assembly.handles import face_depth
from artgen.assembly.piece import Piece
from artgen.assembly.source import Member, Side, Source
from artgen.core.stream import Stream

LEAST_TRAVEL = 0.8
"""Least share of its template's travel that a joint keeps."""
SHORTER = 0.2
"""Chance that the joints of a group open less far than the template's."""
PUSHED = 0.1
"""Chance that the fronts of an object have no handles and are pushed to open."""
FINGERTIP = 0.02
"""m; from the free side of a front to where it is pushed, and pulled once it stands open."""
STEP = 6
"""Decimals of a shortened travel, m or rad."""
Travels = Mapping[str, float]
"""Name of a joint to the share of its template's travel that it keeps, where it is under 1."""


def may_shorten(source: Source) -> frozenset[str]:
    """Joints with a travel of their own: none follows them, they follow none, and no other waits
    for them to be open so far."""
    joints = [member.joint for member in source.members]
    bound = {j.mimic.joint for j in joints if j.mimic is not None}
    bound |= {rule.requires for rule in source.preconditions}
    return frozenset(
        j.name for j in joints if j.limit is not None and j.mimic is None and j.name not in bound
    )


def drawn_travels(source: Source, groups: Sequence[Group], stream: Stream) -> dict[str, float]:
    """Joints that open less far, alike within a group: a row of drawers has one kind of runners."""
    free = may_shorten(source)
    joints = {member.name: member.joint.name for member in source.members}
    travels: dict[str, float] = {}
    for number, group in enumerate(groups):
        rng = stream.child(number).generator()
        chosen, share = rng.random() < SHORTER, float(rng.uniform(LEAST_TRAVEL, 1.0))
        names = [joints[slot.name] for slot in group.slots]
        travels |= {name: share for name in names if chosen and name in free}
    return travels


def shortened(joint: Joint, travels: Travels) -> Joint:
    """A joint with the share of its travel that it keeps."""
    share = travels.get(joint.name)
    if share is None or joint.limit is None:
        return joint
    # Rounded up, so that rounding takes no joint below the least share.
    upper = np.ceil(share * joint.limit.upper * 10**STEP) / 10**STEP
    limit = Limit(lower=joint.limit.lower, upper=min(float(upper), joint.limit.upper))
    return dataclasses.replace(joint, limit=limit)


def drawn_push(stream: Stream) -> bool:
    """Whether the fronts of an object are pushed to open."""
    return bool(stream.generator().random() < PUSHED)


def takes_push(slot: Member, donor: Member) -> bool:
    """Whether a front can do without a handle: it swings or comes out, and has no edge to grip."""
    return slot.kind == "front" and slot.side not in ("along", "turn") and not edged(donor)


def edged(donor: Member) -> bool:
    """Whether a front is gripped at its own edge."""
    return any(grip.kind == "edge" for grip in donor.body.grips)


def with_push(front: Piece, side: Side, name: str) -> Piece:
    """A front with a place to push: on its face near the side that opens, in the middle of what
    slides out. It stays without where its face is open there."""
    box = front.bounds
    middle = box.mean(axis=0)
    inset = np.minimum(FINGERTIP, 0.25 * (box[1] - box[0]))
    x = {"left": box[1, 0] - inset[0], "right": box[0, 0] + inset[0]}.get(side, middle[0])
    z = {"bottom": box[1, 2] - inset[2], "top": box[0, 2] + inset[2]}.get(side, middle[2])
    depth = float(face_depth(front.mesh, np.array([[x, z]]))[0])
    if not np.isfinite(depth):
        return front
    out = (0.0, -1.0, 0.0)
    at = (float(x), depth, float(z))
    grip = Grip(name=name, kind="edge", position=at, outward=out, pull=out)
    return dataclasses.replace(front, grips=(*front.grips, grip))
