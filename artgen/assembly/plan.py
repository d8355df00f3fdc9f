"""What is tried next where something does not fit: other donors, other handles, shorter ways."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from artgen.assembly.choice import Group
from artgen.assembly.source import Source
from artgen.assembly.variation import LEAST_TRAVEL, drawn_push, drawn_travels, may_shorten
from artgen.core.stream import Stream

DONORS = 5
"""Donors that a group tries before it keeps its own fronts."""
HANDLES = 4
"""Handles that an object tries before each front keeps its own."""


@dataclass(kw_only=True)
class Plan:
    """What is tried next: a place in the order of donors for each group (None: it keeps its own),
    and one in the order of handles (None: each front keeps its own).

    Attributes:
        travels: joints that open less far than the template's.
        push: fronts have no handles.
        spare: for each group the joints that may still be shortened where its donors meet
            something on their way.
    """

    donors: list[int | None]
    travels: dict[str, float]
    push: bool
    spare: list[tuple[str, ...]]
    handle: int | None
    tried: list[str] = field(default_factory=list)

    def next_donor(self, group: int, groups: Sequence[Group], why: str) -> None:
        """The next donor of a group, or none."""
        self.tried.append(why)
        place = self.donors[group]
        last = min(DONORS, len(groups[group].donors)) - 1
        self.donors[group] = None if place is None or place >= last else place + 1

    def less_far(self, group: int, groups: Sequence[Group], why: str) -> None:
        """The next donor of a group that meets something; after the last one the first again, with
        joints that open less far; then none."""
        self.next_donor(group, groups, why)
        if self.donors[group] is None and self.spare[group]:
            self.travels |= dict.fromkeys(self.spare[group], LEAST_TRAVEL)
            self.spare[group], self.donors[group] = (), 0

    def next_handle(self, count: int, why: str) -> None:
        """The next handle, or none."""
        self.tried.append(why)
        last = min(HANDLES, count) - 1
        self.handle = None if self.handle is None or self.handle >= last else self.handle + 1


def first_plan(source: Source, groups: Sequence[Group], stream: Stream) -> Plan:
    """First choices, with what a stream draws for all of the object."""
    free = may_shorten(source)
    joints = {member.name: member.joint.name for member in source.members}
    slots = [[joints[slot.name] for slot in group.slots] for group in groups]
    push = drawn_push(stream.child("push"))
    return Plan(
        donors=[0 if group.donors else None for group in groups],
        travels=drawn_travels(source, groups, stream.child("travels")),
        push=push,
        handle=None if push else 0,
        spare=[tuple(name for name in names if name in free) for names in slots],
    )
