"""L4: MuJoCo moves parts where we do, nothing interpenetrates on the way, and rest holds."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

import mujoco
import numpy as np

from artgen.articulation.kinematics import forward_kinematics, resolved
from artgen.articulation.types import Joint
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.export.bundle import Bundle
from artgen.export.layout import MJCF, URDF
from artgen.validate import bounds
from artgen.validate.physics import body_names, set_state
from artgen.validate.report import Finding
from artgen.validate.subject import Subject
from artgen.validate.sweep import Crossing, crossings, sweeps

RANDOM_POSES = 5
SETTLE_SECONDS = 2.0
"""Long enough for friction creep and for a part that is not held to swing away."""


def kinematics(subject: Subject) -> Iterator[Finding]:
    """At random states MuJoCo puts every part where our forward kinematics does."""
    bundle = subject.bundle
    rng = Stream(0, "validate", bundle.asset_id).generator()
    free = [joint for joint in bundle.joints if joint.mimic is None]
    states = [{j.name: _random_q(j, rng) for j in free} for _ in range(RANDOM_POSES)]
    ours = [forward_kinematics(bundle.parts[0].name, bundle.joints, state) for state in states]
    for file in (MJCF, URDF):
        model = subject.model(file)
        data = mujoco.MjData(model)
        errors = np.zeros(len(bundle.parts))
        for state, poses in zip(states, ours, strict=True):
            set_state(model, data, resolved(bundle.joints, state))
            errors = np.maximum(errors, _pose_errors(bundle, data, poses))
        for part, error in zip(bundle.parts, errors.tolist(), strict=True):
            if not error <= bounds.KINEMATICS.value:
                yield Finding(
                    check="motion.kinematics",
                    part=f"{part.name} ({file})",
                    value=error,
                    bound=bounds.KINEMATICS.at_most(),
                    message="axis, pivot or sign differs from the manifest; check the exporter",
                )


def _random_q(joint: Joint, rng: np.random.Generator) -> float:
    limit = joint.limit
    lower, upper = (-np.pi, np.pi) if limit is None else (limit.lower, limit.upper)
    return float(rng.uniform(lower, upper))


def _pose_errors(bundle: Bundle, data: mujoco.MjData, ours: Mapping[str, Floats]) -> list[float]:
    """Largest difference of position (m) or rotation matrix of each part's link frame."""
    pivots = {joint.child: np.array(joint.origin) for joint in bundle.joints}
    errors = []
    for part in bundle.parts:
        body, turn = data.body(part.name), ours[part.name][:3, :3]
        place = turn @ pivots.get(part.name, np.zeros(3)) + ours[part.name][:3, 3]
        shift = np.abs(body.xpos - place).max()
        errors.append(float(max(shift, np.abs(body.xmat.reshape(3, 3) - turn).max())))
    return errors


def collisions(subject: Subject) -> Iterator[Finding]:
    """Collision pieces of different parts do not meet, at rest and along each joint's range.

    Parents are not exempt: with a fixed base MuJoCo lets them collide, and a drawer would jam.
    """
    bundle, model = subject.bundle, subject.model(MJCF)
    data = mujoco.MjData(model)
    names = body_names(model)
    worst: dict[tuple[str, str], tuple[float, str]] = {}
    for sweep in sweeps(bundle.joints, bundle.preconditions):
        for state in sweep.states:
            set_state(model, data, resolved(bundle.joints, state))
            mujoco.mj_collision(model, data)
            for depth, first, second in contacts(model, data, names):
                if depth > worst.get((first, second), (bounds.CONTACT.value, ""))[0]:
                    worst[first, second] = depth, sweep.told(state)
    for (first, second), (depth, where) in sorted(worst.items()):
        yield Finding(
            check="motion.collision",
            part=f"{first}, {second}",
            value=depth,
            bound=bounds.CONTACT.at_most(),
            message=f"collision pieces meet {where}; author pieces that leave openings open, "
            "or widen the clearance",
        )


def contacts(
    model: mujoco.MjModel, data: mujoco.MjData, names: Sequence[str]
) -> Iterator[tuple[float, str, str]]:
    """Depth (m, positive inside) and the two bodies of each present contact, by name."""
    if data.ncon == 0:
        return
    bodies = model.geom_bodyid[data.contact.geom]
    for depth, (first, second) in zip(-data.contact.dist, bodies, strict=True):
        one, other = sorted((names[first], names[second]))
        yield float(depth), one, other


def exact_overlaps(subject: Subject) -> Iterator[Finding]:
    """Visual meshes of different parts share no volume, at rest and along each joint's range."""
    bundle = subject.bundle
    base = bundle.parts[0].name
    worst: dict[tuple[str, str], Crossing] = {}
    for crossing in crossings(base, bundle.joints, bundle.preconditions, subject.shapes):
        one, other = sorted((crossing.overlap.first, crossing.overlap.second))
        pair = one, other
        if pair not in worst or crossing.overlap.volume > worst[pair].overlap.volume:
            worst[pair] = crossing
    for (first, second), crossing in sorted(worst.items()):
        if crossing.overlap.volume > bounds.OVERLAP.value:
            where = crossing.sweep.told(crossing.sweep.states[crossing.overlap.pose])
            yield Finding(
                check="motion.overlap",
                part=f"{first}, {second}",
                value=crossing.overlap.volume,
                bound=bounds.OVERLAP.at_most(),
                message=f"the visible parts pass through each other {where}; "
                "check axis and pivot, or widen the clearance",
            )


def settles(subject: Subject) -> Iterator[Finding]:
    """Left alone for two seconds, joints stay within the sag and creep of soft constraints."""
    model = subject.model(MJCF)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    allowed = drift_bound(model, data)
    with contact_as_needed(model, data):
        mujoco.mj_step(model, data, nstep=round(SETTLE_SECONDS / model.opt.timestep))
    for number, warning in enumerate(data.warning):
        if warning.number > 0:
            name = mujoco.mjtWarning(number).name
            yield _settle_finding("simulation", name, "no warning", "the simulation is unstable")
    drift = np.abs(data.qpos)
    for joint in subject.bundle.joints:
        number = model.joint(joint.name).id
        found, bound = float(drift[number]), float(allowed[number])
        if not found <= bound:
            cause = (
                "gravity or a spring moves it from rest, or contact pushes it; raise its friction"
            )
            yield _settle_finding(joint.name, found, f"<= {bound:.3g} rad or m", cause)


@contextmanager
def contact_as_needed(model: mujoco.MjModel, data: mujoco.MjData) -> Iterator[None]:
    """Contact is most of a step's time; where nothing touches at rest, it cannot act there."""
    flags = model.opt.disableflags
    if data.ncon == 0:
        model.opt.disableflags = flags | mujoco.mjtDisableBit.mjDSBL_CONTACT
    try:
        yield
    finally:
        model.opt.disableflags = flags


def _settle_finding(part: str, value: float | str, bound: str, cause: str) -> Finding:
    return Finding(
        check="motion.settle", part=part, value=value, bound=bound, message=f"after 2 s: {cause}"
    )


def drift_bound(model: mujoco.MjModel, data: mujoco.MjData) -> Floats:
    """How far each joint (a degree of freedom each) may move while friction or a stop holds it.

    MuJoCo's constraints are soft: with impedance d and the acceleration a that the joint would have
    if free, it ends where the reference acceleration is (1 - d) / d a. So a stop (solref t, z) sags
    by (1 - d) / d a (dmax t z)^2 / d, and friction creeps at (1 - d) / d a dmax t / 2
    (MuJoCo manual, Computation, Parameters). A joint that neither holds has no such excuse.
    """
    free = np.abs(data.qacc_smooth)
    stop = _softness(model.jnt_solimp) * free
    sag = stop * (model.jnt_solimp[:, 1] * model.jnt_solref[:, :2].prod(axis=1)) ** 2
    creep = (
        _softness(model.dof_solimp) * free * model.dof_solimp[:, 1] * model.dof_solref[:, 0] / 2.0
    )
    held = np.where(model.dof_frictionloss > 0.0, creep * SETTLE_SECONDS, 0.0)
    stopped = np.where(model.jnt_limited, sag / model.jnt_solimp[:, 0], 0.0)
    return np.asarray(bounds.SETTLE_FACTOR.value * (held + stopped) + bounds.SETTLE_FLOOR.value)


def _softness(solimp: Floats) -> Floats:
    """(1 - d) / d at the softest impedance d of each constraint."""
    return np.asarray((1.0 - solimp[:, 0]) / solimp[:, 0])
