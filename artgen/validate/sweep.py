"""Poses that an object must survive, and what interpenetrates on the way."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.kinematics import forward_kinematics, joint_motion, resolved
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


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """The worst overlap of two parts within a sweep."""

    sweep: Sweep
    overlap: Overlap


def sweeps(joints: Sequence[Joint], preconditions: Sequence[Precondition]) -> Iterator[Sweep]:
    """The rest state, then each independent joint through its range.

    A joint with preconditions is swept twice: with the joints it requires at the required value,
    and with those fully open.
    """
    yield Sweep(joint="", states=({},))
    by_name = {joint.name: joint for joint in joints}
    for joint in joints:
        if joint.mimic is not None:
            continue
        held = {rule.requires: rule.at_least for rule in _required(joint.name, preconditions)}
        open_ = {name: _range(by_name[name])[1] for name in held}
        lower, upper = _range(joint)
        path = np.linspace(lower, upper, POSES).tolist()
        for others in (held, open_) if open_ != held else (held,):
            yield Sweep(joint=joint.name, states=tuple({**others, joint.name: q} for q in path))


def _required(name: str, preconditions: Sequence[Precondition]) -> Iterator[Precondition]:
    """The preconditions of a joint, and those of the joints it requires."""
    for rule in preconditions:
        if rule.joint == name:
            yield from _required(rule.requires, preconditions)
            yield rule


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
    """For each sweep and pair of parts, the pose at which they share most; parents included."""
    for sweep in sweeps(joints, preconditions):
        worst: dict[tuple[str, str], Overlap] = {}
        for overlap in overlaps(_movers(base, joints, shapes, sweep)):
            pair = (overlap.first, overlap.second)
            if pair not in worst or overlap.volume > worst[pair].volume:
                worst[pair] = overlap
        for overlap in worst.values():
            yield Crossing(sweep=sweep, overlap=overlap)


def _movers(
    base: str, joints: Sequence[Joint], shapes: Mapping[str, Shape], sweep: Sweep
) -> list[Mover]:
    """Shapes with their poses over a sweep; those that move as one get one group.

    At rest, and for joints held away from it, every pair must be looked at: each part is a group.
    """
    poses = sweep_poses(base, joints, sweep)
    moving = _moved_by(sweep.joint, joints)
    alone = not sweep.joint or len(sweep.states[0]) > 1
    movers = []
    for number, (name, shape) in enumerate(shapes.items()):
        group = number if alone else moving.get(name, -1)
        movers.append(Mover(name=name, shape=shape, poses=poses[name], group=group))
    return movers


def _moved_by(name: str, joints: Sequence[Joint]) -> dict[str, int]:
    """Part name to a number that parts share while joint `name` moves; absent ones stand still."""
    groups: dict[str, int] = {}
    for number, joint in enumerate(joints):
        driven = joint.name == name or (joint.mimic is not None and joint.mimic.joint == name)
        if driven:
            groups[joint.child] = number
        elif joint.parent in groups:
            groups[joint.child] = groups[joint.parent]
    return groups


def sweep_poses(base: str, joints: Sequence[Joint], sweep: Sweep) -> dict[str, Floats]:
    """Part name to (K, 4, 4) `object_from_rest` over a sweep."""
    first = forward_kinematics(base, joints, sweep.states[0])
    count = len(sweep.states)
    poses = {name: np.repeat(pose[None], count, axis=0) for name, pose in first.items()}
    moving = _moved_by(sweep.joint, joints)
    chain = [joint for joint in joints if joint.child in moving]
    for k, state in enumerate(sweep.states[1:], start=1):
        q = resolved(joints, state)
        for joint in chain:
            poses[joint.child][k] = poses[joint.parent][k] @ joint_motion(joint, q[joint.name])
    return poses
