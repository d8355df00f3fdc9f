"""L4: MuJoCo moves parts where we do, and nothing interpenetrates on the way."""

from collections.abc import Iterator, Sequence

import mujoco
import numpy as np

from artgen.articulation.kinematics import forward_kinematics, resolved
from artgen.articulation.types import Joint, State
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.geometry.clearance import shape_of_nothing
from artgen.validate.physics import body_names, set_state
from artgen.validate.report import Finding, Note, Skipped
from artgen.validate.subject import Subject
from artgen.validate.sweep import Crossing, crossings, sweeps

RANDOM_POSES = 5


def random_states(subject: Subject) -> list[dict[str, float]]:
    """States of all free joints, evenly within their limits; the same for the same asset."""
    rng = Stream(0, "validate", subject.name).generator()
    free = [joint for joint in subject.joints if joint.mimic is None]
    return [{j.name: _random_q(j, rng) for j in free} for _ in range(RANDOM_POSES)]


def _random_q(joint: Joint, rng: np.random.Generator) -> float:
    limit = joint.limit
    lower, upper = (-np.pi, np.pi) if limit is None else (limit.lower, limit.upper)
    return float(rng.uniform(lower, upper))


def link_poses(subject: Subject, state: State) -> dict[str, Floats]:
    """Body name to (4, 4) `object_from_link` at a state, by our forward kinematics."""
    parts = forward_kinematics(subject.parts[0].name, subject.joints, state)
    return {name: parts[link.part] @ link.object_from_link for name, link in subject.links.items()}


def kinematics(subject: Subject) -> Iterator[Finding]:
    """At random states MuJoCo puts every link where our forward kinematics does."""
    bound = subject.bounds.kinematics
    states = random_states(subject)
    ours = [link_poses(subject, state) for state in states]
    for file in subject.model_files:
        model = subject.model(file)
        data = mujoco.MjData(model)
        bodies = [model.body(name).id for name in subject.links]
        errors = np.zeros(len(bodies))
        for state, poses in zip(states, ours, strict=True):
            set_state(model, data, resolved(subject.joints, state))
            errors = np.maximum(errors, _pose_errors(data, bodies, np.array(list(poses.values()))))
        for name, error in zip(subject.links, errors.tolist(), strict=True):
            if not error <= bound.value:
                yield Finding(
                    check="motion.kinematics",
                    part=f"{name} ({file})",
                    value=error,
                    bound=bound.at_most(),
                    cause="axis, pivot or sign differs from what the asset states",
                    remedy="check the exporter",
                )


def _pose_errors(data: mujoco.MjData, bodies: Sequence[int], ours: Floats) -> Floats:
    """(B,) largest difference of position (m, beyond 1 m relative) or rotation matrix of bodies
    from (B, 4, 4) poses."""
    places, turns = data.xpos[bodies], data.xmat[bodies].reshape(-1, 3, 3)
    shift = np.abs(places - ours[:, :3, 3]).max(axis=1) / np.abs(places).max(axis=1).clip(min=1.0)
    return np.maximum(shift, np.abs(turns - ours[:, :3, :3]).max(axis=(1, 2)))


def collisions(subject: Subject) -> Iterator[Finding]:
    """Collision pieces of different parts do not meet, at rest and along each joint's range.

    Parents are not exempt: with a fixed base MuJoCo lets them collide, and a drawer would jam.
    """
    bound, model = subject.bounds.contact, subject.simulated
    data = mujoco.MjData(model)
    links = subject.links
    owners = [links[name].part if name in links else name for name in body_names(model)]
    worst: dict[tuple[str, str], tuple[float, str, State, str]] = {}
    places = [model.jnt_qposadr[model.joint(joint.name).id] for joint in subject.joints]
    for sweep in sweeps(subject.joints, subject.passages):
        for state in sweep.states:
            data.qpos[places] = list(resolved(subject.joints, state).values())
            mujoco.mj_kinematics(model, data)
            mujoco.mj_collision(model, data)
            for depth, first, second in contacts(model, data, owners):
                if depth > worst.get((first, second), (bound.value,))[0]:
                    worst[first, second] = depth, sweep.joint, state, sweep.told(state)
    for (first, second), (depth, joint, state, where) in sorted(worst.items()):
        yield Finding(
            check="motion.collision",
            part=f"{first}, {second}",
            joint=joint or None,
            state=state,
            value=depth,
            bound=bound.at_most(),
            cause=f"collision pieces meet {where}",
            remedy="author pieces that leave openings open, or widen the clearance",
        )


def contacts(
    model: mujoco.MjModel, data: mujoco.MjData, owners: Sequence[str]
) -> Iterator[tuple[float, str, str]]:
    """Depth (m, positive inside) and the two parts of each present contact, by name; `owners` is
    the part of each body."""
    if data.ncon == 0:
        return
    bodies = model.geom_bodyid[data.contact.geom]
    for depth, (first, second) in zip(-data.contact.dist, bodies, strict=True):
        one, other = sorted((owners[first], owners[second]))
        if one != other:
            yield float(depth), one, other


def passages(subject: Subject) -> Iterator[Note]:
    """Joints that were found to need others open; where the format cannot say so, that is noted."""
    for rule in subject.passages:
        if rule not in subject.preconditions:
            text = f"{rule.joint} is judged with {rule.requires} = {rule.at_least:.4g}: its parts "
            yield Note(name="motion.passage", text=text + "meet otherwise")


def exact_overlaps(subject: Subject) -> Iterator[Finding | Skipped]:
    """Visual meshes of different parts share no volume, at rest and along each joint's range."""
    bound, base = subject.bounds.overlap, subject.parts[0].name
    unseen = [part.name for part in subject.parts if part.name not in subject.shapes]
    for name in unseen:
        yield Skipped(name="motion.overlap", reason=f"{name} has no visual shape")
    shapes = {**subject.shapes, **{name: shape_of_nothing() for name in unseen}}
    worst: dict[tuple[str, str], Crossing] = {}
    for crossing in crossings(base, subject.joints, subject.passages, shapes):
        one, other = sorted((crossing.overlap.first, crossing.overlap.second))
        pair = one, other
        if pair not in worst or crossing.overlap.volume > worst[pair].overlap.volume:
            worst[pair] = crossing
    for (first, second), crossing in sorted(worst.items()):
        if crossing.overlap.volume > bound.value:
            state = crossing.sweep.states[crossing.overlap.pose]
            yield Finding(
                check="motion.overlap",
                part=f"{first}, {second}",
                joint=crossing.sweep.joint or None,
                state=state,
                value=crossing.overlap.volume,
                bound=bound.at_most(),
                cause=f"the visible parts pass through each other {crossing.sweep.told(state)}",
                remedy="check axis and pivot, or widen the clearance",
            )
