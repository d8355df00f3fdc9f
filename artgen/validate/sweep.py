"""Poses that an object must survive, and what interpenetrates on the way."""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.kinematics import forward_kinematics, joint_motions, resolved
from artgen.articulation.states import required_state
from artgen.articulation.types import Joint, Precondition, State
from artgen.core.mesh import Floats
from artgen.geometry.clearance import Mover, Overlap, Shape, overlaps

POSES = 21
"""States a joint is put to, both ends included: 5 % of the range a step."""


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """One joint moved through its range while the others hold still.

    Attributes:
        joint: name of the moved joint; empty for the rest state alone.
        states: joint name to q; one state a pose.
    """

    joint: str
    states: tuple[State, ...]

    def told(self, state: State) -> str:
        """`at slide = 0.21 with hinge = 1.57`, or `at rest`."""
        if not self.joint:
            return "at rest"
        others = ", ".join(f"{name} = {q:.4g}" for name, q in state.items() if name != self.joint)
        return f"at {self.joint} = {state[self.joint]:.4g}" + (f" with {others}" if others else "")


Pair = tuple[int, int]
Between = Mapping[Pair, tuple[str, ...]]
Courses = Mapping[str, tuple[float, float]]
Course = tuple[Pair, tuple[tuple[float, ...], ...]]
"""Two parts and where each joint between them begins and ends, or begins alone."""


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """The worst overlap of two parts within a sweep."""

    sweep: Sweep
    overlap: Overlap


def sweeps(
    joints: Sequence[Joint], preconditions: Sequence[Precondition], poses: int = POSES
) -> Iterator[Sweep]:
    """The rest state, then each independent joint through its range.

    A joint with preconditions is swept twice: with the joints it requires at the required value,
    and with those fully open.
    """
    yield Sweep(joint="", states=({},))
    by_name = {joint.name: joint for joint in joints}
    for joint in joints:
        if joint.mimic is not None:
            continue
        held = required_state(joint.name, preconditions)
        open_ = {name: _range(by_name[name])[1] for name in held}
        lower, upper = _range(joint)
        path = np.linspace(lower, upper, poses).tolist()
        for others in (held, open_) if open_ != held else (held,):
            yield Sweep(joint=joint.name, states=tuple({**others, joint.name: q} for q in path))


def _range(joint: Joint) -> tuple[float, float]:
    """Lower and upper end; one whole turn where there is no limit."""
    if joint.limit is None:
        return -math.pi, math.pi
    return joint.limit.lower, joint.limit.upper


def crossings(
    base: str,
    joints: Sequence[Joint],
    preconditions: Sequence[Precondition],
    shapes: Mapping[str, Shape],
) -> Iterator[Crossing]:
    """For each sweep and pair of parts, the pose at which they share most; parents included.

    How two parts lie to each other depends on the joints between them alone. So a pair is looked at
    once for each course of those joints; where they hold still, at one pose, and only if no course
    has begun there.
    """
    names = [base, *(joint.child for joint in joints)]
    between = joints_between(base, joints)
    listed = [(sweep, _courses(sweep, joints)) for sweep in sweeps(joints, preconditions)]
    seen: set[Course] = set()
    for chosen, stop in ((_moving, None), (_still, 1)):
        for sweep, courses in listed:
            pairs = chosen(courses, between, seen)
            if not pairs:
                continue
            poses = sweep_poses(base, joints, sweep)
            movers = [Mover(name=n, shape=shapes[n], poses=poses[n][:stop]) for n in names]
            worst: dict[tuple[str, str], Overlap] = {}
            for overlap in overlaps(movers, pairs):
                pair = (overlap.first, overlap.second)
                if pair not in worst or overlap.volume > worst[pair].volume:
                    worst[pair] = overlap
            for overlap in worst.values():
                yield Crossing(sweep=sweep, overlap=overlap)


def joints_between(base: str, joints: Sequence[Joint]) -> Between:
    """Names of the joints between each two parts; the base is 0, children follow as joints do."""
    chains: dict[str, frozenset[str]] = {base: frozenset()}
    for joint in joints:
        chains[joint.child] = chains[joint.parent] | {joint.name}
    numbered = list(enumerate(chains.values()))
    pairs = itertools.combinations(numbered, 2)
    return {(i, j): tuple(sorted(one ^ other)) for (i, one), (j, other) in pairs}


def _moving(courses: Courses, between: Between, seen: set[Course]) -> list[Pair]:
    """Pairs whose relative pose changes over a sweep in a way not seen yet; marks them and where
    they begin as seen."""
    still = {name for name, (first, last) in courses.items() if first == last}
    pairs = []
    for pair, names in between.items():
        course: Course = (pair, tuple(courses[name] for name in names))
        if not still.issuperset(names) and course not in seen:
            pairs.append(pair)
            seen |= {course, (pair, tuple(courses[name][:1] for name in names))}
    return pairs


def _still(courses: Courses, between: Between, seen: set[Course]) -> list[Pair]:
    """Pairs whose relative pose at the first state is not seen yet; marks them as seen."""
    starts = {pair: (pair, tuple(courses[n][:1] for n in names)) for pair, names in between.items()}
    pairs = [pair for pair, start in starts.items() if start not in seen]
    seen |= set(starts.values())
    return pairs


def _courses(sweep: Sweep, joints: Sequence[Joint]) -> Courses:
    """The value of each joint at the first and the last state; between them it is even."""
    ends = [resolved(joints, state) for state in (sweep.states[0], sweep.states[-1])]
    return {joint.name: (ends[0][joint.name], ends[1][joint.name]) for joint in joints}


def sweep_poses(base: str, joints: Sequence[Joint], sweep: Sweep) -> dict[str, Floats]:
    """Part name to (K, 4, 4) `object_from_rest` over a sweep."""
    first = forward_kinematics(base, joints, sweep.states[0])
    count = len(sweep.states)
    poses = {name: np.repeat(pose[None], count, axis=0) for name, pose in first.items()}
    q = [resolved(joints, state) for state in sweep.states]
    for joint in _moved_by(sweep.joint, joints):
        motions = joint_motions(joint, np.array([at[joint.name] for at in q]))
        poses[joint.child] = poses[joint.parent] @ motions
    return poses


def _moved_by(name: str, joints: Sequence[Joint]) -> list[Joint]:
    """The joint itself, those that follow it, and all below them, parents first."""
    moving: set[str] = set()
    chain = []
    for joint in joints:
        follows = joint.mimic is not None and joint.mimic.joint == name
        if joint.name == name or follows or joint.parent in moving:
            moving.add(joint.child)
            chain.append(joint)
    return chain
