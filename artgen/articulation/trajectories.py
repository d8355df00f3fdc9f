"""Trajectories: how the joints of an object move over time, as someone who uses it moves them.

A trajectory runs from time 0 to 1 and starts at rest. Between knots a joint eases from one value to
the next by the quintic of least jerk, which is monotone and has no speed nor acceleration at its
ends: so a joint never leaves the values of its knots, and the motion is twice differentiable.

What requires nothing may move at all times. What requires others (a rack needs the door open) may
move in a shorter span inside, during which all that is required stays open far enough; at its ends
it is at rest. Limits, mimics and preconditions therefore hold at every time, not at frames alone.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.states import travel
from artgen.articulation.types import Joint, Precondition
from artgen.core.mesh import Floats
from artgen.core.stream import Stream

Span = tuple[float, float]

CLOSING = 0.5
"""Share of trajectories in which whatever others require closes again before the end."""
OPENING = (0.22, 0.34)
CLOSED = (0.72, 0.86)
"""Shares of a span after which what others require is open, and until which it stays so."""
FEWEST, MOST = 1, 3
"""Knots of a free joint between the ends of its span."""
PAUSE_CHANCE = 0.2
DELAY = 0.25
"""Greatest share of its span that a joint waits before it first moves."""
LEAST_MOVE = 0.3
"""Share of its travel that a joint's first move covers at least, so that every joint is seen to
move."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Track:
    """One joint over time.

    Attributes:
        times: (K,) ascending, the first at or after 0; before the first and after the last knot the
            joint stands still.
        values: (K,) q, rad or m.
    """

    times: Floats
    values: Floats

    def at(self, time: float) -> float:
        """q at a time."""
        after = int(np.searchsorted(self.times, time, side="right"))
        if after == 0:
            return float(self.values[0])
        if after == len(self.times):
            return float(self.values[-1])
        start, end = self.times[after - 1 : after + 1]
        low, high = self.values[after - 1 : after + 1]
        q = low + (high - low) * eased((time - start) / (end - start))
        return float(min(max(q, min(low, high)), max(low, high)))


def eased(share: float) -> float:
    """The quintic of least jerk from 0 to 1 (Flash, Hogan 1985)."""
    return share * share * share * (10.0 + share * (6.0 * share - 15.0))


def trajectory_states(
    joints: Sequence[Joint],
    preconditions: Sequence[Precondition],
    stream: Stream,
    times: Sequence[float],
) -> list[dict[str, float]]:
    """q of every free joint at `times` in [0, 1], all of one trajectory."""
    moving = tracks(joints, preconditions, stream)
    return [{name: track.at(time) for name, track in moving.items()} for time in times]


def frame_times(count: int) -> list[float]:
    """`count` even times from 0 to 1."""
    return [k / max(1, count - 1) for k in range(count)]


def tracks(
    joints: Sequence[Joint], preconditions: Sequence[Precondition], stream: Stream
) -> dict[str, Track]:
    """A track for every free joint; a joint's depends on its own stream and on the spans alone.

    A joint stays at rest if its mimics leave it no travel, or if nothing can ever allow it to move:
    its preconditions ask for more than a joint's travel, or for each other.
    """
    free = _rooms(joints)
    rules = [_led(rule, joints) for rule in preconditions]
    depths = _depths(free, rules)
    spans = _spans(stream.child("spans"), max(depths.values(), default=0))
    made = {}
    for name, room in free.items():
        if name not in depths or room[0] == room[1]:
            made[name] = Track(times=np.zeros(1), values=np.zeros(1))
            continue
        relied = [r.at_least for r in rules if r.requires == name and r.joint in depths]
        own = stream.child("joint", name)
        span, hold = spans[depths[name]], spans[depths[name] + 1]
        if relied:
            made[name] = _opened(own, room, span=span, hold=hold, at_least=max(relied))
        else:
            made[name] = _wandering(own, room, span=span)
    return made


def _spans(stream: Stream, depth: int) -> list[Span]:
    """When joints of each depth may move, each span inside the one before; in some trajectories
    what was opened stays open to the end."""
    closing = stream.child("closing").generator().random() < CLOSING
    spans = [(0.0, 1.0)]
    for level in range(depth + 1):
        first, last = stream.child(level).generator().random(2)
        start, end = spans[-1]
        length = end - start
        until = start + _between(CLOSED, last) * length if closing else end
        spans.append((start + _between(OPENING, first) * length, until))
    return spans


def _wandering(stream: Stream, room: Span, *, span: Span) -> Track:
    """From rest through drawn values; back to rest where the span ends before time does."""
    rng = stream.generator()
    count = int(rng.integers(FEWEST, MOST + 1))
    start = _between((span[0], span[0] + DELAY * (span[1] - span[0])), rng.random())
    steps = np.cumsum(0.5 + rng.random(count + 1))
    times = start + (span[1] - start) * steps / steps[-1]
    values = [0.0, _far_value(room, rng.random())]
    for _ in range(count - 1):
        pause, share = rng.random(2)
        values.append(values[-1] if pause < PAUSE_CHANCE else _between(room, share))
    values.append(_between(room, rng.random()) if span[1] == 1.0 else 0.0)
    return Track(times=np.array([start, *times[:-1], span[1]]), values=np.array(values))


def _opened(stream: Stream, room: Span, *, span: Span, hold: Span, at_least: float) -> Track:
    """At `at_least` or more throughout `hold`, where others rely on it; closed before and after."""
    rng = stream.generator()
    start = _between((span[0], span[0] + DELAY * (hold[0] - span[0])), rng.random())
    within = np.sort(rng.random(int(rng.integers(0, MOST))))
    times = [start, hold[0], *(_between(hold, share) for share in within), hold[1]]
    seen = min(LEAST_MOVE * (room[1] - room[0]), room[1])
    values = [0.0, _between((max(at_least, seen), room[1]), rng.random())]
    for _ in range(len(within) + 1):
        values.append(_between((max(at_least, room[0]), room[1]), rng.random()))
    if hold[1] < span[1]:
        times.append(span[1])
        values.append(0.0)
    return Track(times=np.array(times), values=np.array(values))


def _between(bounds: Span, share: float) -> float:
    """The value at a share of the way, rounding kept inside."""
    value = bounds[0] + float(share) * (bounds[1] - bounds[0])
    return min(max(value, bounds[0]), bounds[1])


def _far_value(room: Span, share: float) -> float:
    """A value of the room at least `LEAST_MOVE` of it from rest."""
    gap = LEAST_MOVE * (room[1] - room[0])
    below, above = max(0.0, -gap - room[0]), max(0.0, room[1] - gap)
    way = float(share) * (below + above)
    return room[0] + way if way < below else min(gap + way - below, room[1])


def _rooms(joints: Sequence[Joint]) -> dict[str, Span]:
    """Values of each free joint at which it and all joints that follow it are within limits."""
    rooms = {joint.name: travel(joint) for joint in joints if joint.mimic is None}
    for joint in joints:
        if joint.mimic is None or joint.limit is None:
            continue
        leader, factor, offset = _law(joint, joints)
        if factor == 0.0:
            continue
        ends = sorted((bound - offset) / factor for bound in travel(joint))
        low, high = rooms[leader]
        rooms[leader] = (min(0.0, max(low, ends[0])), max(0.0, min(high, ends[1])))
    return rooms


def _law(joint: Joint, joints: Sequence[Joint]) -> tuple[str, float, float]:
    """(leader, factor, offset): q is factor * q[leader] + offset; a free joint leads itself."""
    factor, offset = 1.0, 0.0
    while joint.mimic is not None:
        offset += factor * joint.mimic.offset
        factor *= joint.mimic.multiplier
        joint = next(other for other in joints if other.name == joint.mimic.joint)
    return joint.name, factor, offset


def _led(rule: Precondition, joints: Sequence[Joint]) -> Precondition:
    """The rule in terms of free joints; one that a following joint can only break asks for more
    than any travel."""
    by_name = {joint.name: joint for joint in joints}
    barred, _, _ = _law(by_name[rule.joint], joints)
    leader, factor, offset = _law(by_name[rule.requires], joints)
    if leader == rule.requires:
        return Precondition(joint=barred, requires=leader, at_least=rule.at_least)
    # Two roundings, of which the leader's value knows nothing, must not end below the bound.
    least = (rule.at_least - offset) / factor * (1.0 + 1e-12) if factor > 0.0 else math.inf
    return Precondition(joint=barred, requires=leader, at_least=least)


def _depths(rooms: Mapping[str, Span], rules: Sequence[Precondition]) -> dict[str, int]:
    """How many openings each joint waits for, one after the other; without joints that wait
    forever."""
    depths: dict[str, int] = {}
    for _ in rooms:
        for name in rooms.keys() - depths.keys():
            needs = [rule for rule in rules if rule.joint == name]
            if all(n.requires in depths and n.at_least <= rooms[n.requires][1] for n in needs):
                depths[name] = max((depths[n.requires] + 1 for n in needs), default=0)
    return depths
