"""Joint states: drawn within limits, preconditions obeyed; normalized to ART's motion."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from artgen.articulation.types import Joint, Precondition, State
from artgen.core.errors import KinematicError
from artgen.core.stream import Stream

REST_CHANCE = 0.15
"""Share of joints that a drawn state leaves closed, so that a model sees parts that do not move."""

CLEARED = 0.5
"""Share of barred joints whose way is cleared rather than closed again."""


def travel(joint: Joint) -> tuple[float, float]:
    """(lower, upper) in rad or m; a continuous joint has one turn."""
    if joint.limit is None:
        return 0.0, 2.0 * math.pi
    return joint.limit.lower, joint.limit.upper


def sample_state(
    joints: Sequence[Joint], preconditions: Sequence[Precondition], stream: Stream
) -> dict[str, float]:
    """q of every free joint, preconditions obeyed.

    A joint is at rest or evenly over its travel, and one joint at least moves. Where a precondition
    bars a joint that was drawn open, half of the time its way is cleared (the joint it requires
    opens far enough), otherwise it goes back to rest: racks would move in one state of a hundred if
    doors were left to chance."""
    free = [joint for joint in joints if joint.mimic is None]
    q = {joint.name: _drawn(joint, stream, REST_CHANCE) for joint in free}
    if not any(q.values()):
        q = {joint.name: _drawn(joint, stream, 0.0) for joint in free}
    uppers = {joint.name: travel(joint)[1] for joint in joints}
    for _ in preconditions:
        for rule in preconditions:
            clear, share = stream.child(rule.joint, "way").generator().random(2)
            if q[rule.joint] != 0.0 and q[rule.requires] < rule.at_least and clear < CLEARED:
                room = uppers[rule.requires] - rule.at_least
                q[rule.requires] = rule.at_least + float(share) * room
    return obeying(preconditions, q)


def sample_states(
    joints: Sequence[Joint],
    preconditions: Sequence[Precondition],
    stream: Stream,
    count: int,
) -> list[dict[str, float]]:
    """`count` states; state t depends on its own number alone, so more states never change earlier
    ones."""
    return [sample_state(joints, preconditions, stream.child("state", t)) for t in range(count)]


def _drawn(joint: Joint, stream: Stream, rest_chance: float) -> float:
    rng = stream.child(joint.name).generator()
    at_rest, share = rng.random(2)
    lower, upper = travel(joint)
    return 0.0 if at_rest < rest_chance else float(lower + share * (upper - lower))


def obeying(preconditions: Sequence[Precondition], q: Mapping[str, float]) -> dict[str, float]:
    """`q` with every barred joint put back to rest, until nothing changes."""
    allowed = dict(q)
    for _ in preconditions:
        for rule in preconditions:
            if allowed.get(rule.requires, 0.0) < rule.at_least:
                allowed[rule.joint] = 0.0
    return allowed


def open_state(
    joints: Sequence[Joint], preconditions: Sequence[Precondition], share: float = 1.0
) -> dict[str, float]:
    """Every free joint at `share` of its upper limit, preconditions obeyed."""
    q = {joint.name: share * travel(joint)[1] for joint in joints if joint.mimic is None}
    return obeying(preconditions, q)


def required_state(joint: str, preconditions: Sequence[Precondition]) -> dict[str, float]:
    """The least state in which `joint` may move: what its preconditions ask for, and theirs in
    turn."""
    needed: dict[str, float] = {}
    waiting = [joint]
    while waiting:
        name = waiting.pop()
        for rule in preconditions:
            if rule.joint == name and needed.get(rule.requires, -math.inf) < rule.at_least:
                needed[rule.requires] = rule.at_least
                waiting.append(rule.requires)
    return needed


def check_state(
    joints: Sequence[Joint], preconditions: Sequence[Precondition], state: State
) -> None:
    """Raise KinematicError naming the first joint outside its limits or barred by a
    precondition."""
    for joint in joints:
        q, (lower, upper) = state.get(joint.name, 0.0), travel(joint)
        if joint.limit is not None and not lower - 1e-12 <= q <= upper + 1e-12:
            raise KinematicError(f"joint {joint.name}: q = {q} lies outside [{lower}, {upper}]")
    for rule in preconditions:
        if state.get(rule.joint, 0.0) != 0.0 and state.get(rule.requires, 0.0) < rule.at_least:
            raise KinematicError(
                f"joint {rule.joint}: q = {state[rule.joint]} needs {rule.requires} >= "
                f"{rule.at_least}, found {state.get(rule.requires, 0.0)}"
            )


def motion(joint: Joint, q: float, radius: float) -> float:
    """ART's S in [-1, 1]: q / (2 pi) when turning, q / (2 radius) when sliding (supplement S4,
    S5)."""
    return float(np.clip(q / (2.0 * (radius if joint.type == "prismatic" else math.pi)), -1.0, 1.0))
