"""L6: joints open and close within their effort, stop at their stops, and conserve energy."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import mujoco
import numpy as np

from artgen.articulation.types import Joint
from artgen.core.mesh import Floats
from artgen.simulation.effects import Task, latched, needed_effects, only
from artgen.validate.bounds import Bound
from artgen.validate.physics import coarse_step, simulating, warnings_of
from artgen.validate.report import Finding, Simulated, Skipped
from artgen.validate.subject import Subject

CHUNK = 10
"""Steps between looks at a driven joint; at 5 ms a joint at 2 rad/s moves by 6 degrees."""
CONTINUOUS = math.pi
"""rad; how far a joint without limits is asked to turn."""
STOP_SECONDS = 0.25
RUN_UP = 0.1
"""Share of its range before its stop from which a joint is thrown against it."""
FASTEST = 2.0
"""rad/s or m/s; people close doors at half of it."""
SWING_STEPS = 80
STEPS_A_PERIOD = 60.0
PUSH = 0.5
"""rad/s or m/s that each joint starts a swing with."""


def opens(subject: Subject) -> Iterator[Finding | Skipped | Simulated]:
    """From one stop, a force within its effort takes each joint to the other in time."""
    yield from _driven(subject, "dynamics.open", subject.bounds.opened, forward=True)


def closes(subject: Subject) -> Iterator[Finding | Skipped | Simulated]:
    """And back."""
    yield from _driven(subject, "dynamics.close", subject.bounds.closed, forward=False)


def _driven(
    subject: Subject, check: str, bound: Bound, *, forward: bool
) -> Iterator[Finding | Skipped | Simulated]:
    """All joints driven at once; L4 has shown that each clears the others where it may move."""
    free = [joint for joint in subject.joints if joint.mimic is None]
    for joint in free:
        if math.isinf(joint.effort):
            yield Skipped(name=check, reason=f"{joint.name} states no effort to drive it with")
    driven = [joint for joint in free if not math.isinf(joint.effort)]
    if not driven:
        return
    model = subject.simulated
    effects = needed_effects(model, _task(check, model, driven, forward))
    yield Simulated(check=check, effects=effects.told)
    with only(model, effects):
        share, trouble = travelled(model, driven, forward, subject.bounds.drive_time.value)
    least = bound.value if forward else 1.0 - bound.value
    for joint, value in zip(driven, share.tolist(), strict=True):
        if not value >= least:
            yield Finding(
                check=check,
                part=joint.child,
                joint=joint.name,
                value=value if forward else 1.0 - value,
                bound=bound.at_least() if forward else bound.at_most(),
                cause=f"its effort of {joint.effort:g} does not move it through its range in "
                f"{subject.bounds.drive_time.value:g} s{trouble}",
                remedy="lower friction, damping or mass, or raise the effort",
            )


def _task(check: str, model: mujoco.MjModel, joints: Sequence[Joint], forward: bool) -> Task:
    """Joints pushed from one end of their ranges."""
    own = [int(model.joint(joint.name).id) for joint in joints]
    start = np.zeros(model.nq)
    start[own] = _course(joints, forward)[0]
    return Task(name=check, start=start, driven=frozenset(own), clear=True)


def travelled(
    model: mujoco.MjModel, joints: Sequence[Joint], forward: bool, seconds: float
) -> tuple[Floats, str]:
    """Share of its range that each joint went at most, and what MuJoCo warned of.

    Forces rest while a joint is faster than its `velocity`.
    """
    data = mujoco.MjData(model)
    own = np.array([model.joint(joint.name).id for joint in joints])
    start, span = _course(joints, forward)
    data.qpos[own] = start
    bring_followers(model, data)
    force = np.array([joint.effort for joint in joints]) * np.sign(span)
    top = np.array([joint.velocity for joint in joints])
    share = np.zeros(len(joints))
    with simulating(model):
        model.opt.timestep = coarse_step(model)
        for _ in range(math.ceil(seconds / (CHUNK * model.opt.timestep))):
            slow = data.qvel[own] * np.sign(span) < top
            data.qfrc_applied[own] = np.where(slow, force, 0.0)
            mujoco.mj_step(model, data, nstep=CHUNK)
            share = np.fmax(share, (data.qpos[own] - start) / span)
            if (share >= 1.0 - 1e-3).all():
                break
    trouble = ", ".join(warnings_of(data))
    return share.clip(max=1.0), f" (MuJoCo warns of {trouble})" if trouble else ""


def bring_followers(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Put joints that an equality ties to another where that one is, as fast; one that would be
    faster than `FASTEST` slows its leader."""
    ties = np.flatnonzero(model.eq_type == mujoco.mjtEq.mjEQ_JOINT)
    pairs = [(model.eq_obj1id[tie], model.eq_obj2id[tie], model.eq_data[tie, :5]) for tie in ties]
    for _, leader, (_, ratio, *_) in pairs:
        if leader >= 0 and abs(ratio * data.qvel[leader]) > FASTEST:
            data.qvel[leader] *= FASTEST / abs(ratio * data.qvel[leader])
    for own, leader, curve in pairs:
        if leader >= 0:
            data.qpos[own] = float(np.polyval(curve[::-1], data.qpos[leader]))
            data.qvel[own] = curve[1] * data.qvel[leader]


def _course(joints: Sequence[Joint], forward: bool) -> tuple[Floats, Floats]:
    """Where each joint starts, and how far it is to go."""
    limits = [(0.0, CONTINUOUS) if j.limit is None else (j.limit.lower, j.limit.upper)
              for j in joints]  # fmt: skip
    lower, upper = np.array(limits).T
    return (lower, upper - lower) if forward else (upper, lower - upper)


def stops(subject: Subject) -> Iterator[Finding | Simulated]:
    """Thrown against its stops, no joint goes far beyond, and none comes out fast."""
    bound, model = subject.bounds.overshoot, subject.simulated
    limited = [joint for joint in subject.joints if joint.limit is not None and not joint.mimic]
    if not limited:
        return
    effects = needed_effects(model, _task("dynamics.stop", model, limited, True))
    yield Simulated(check="dynamics.stop", effects=effects.told)
    for forward in (True, False):
        with only(model, effects):
            far = overshoot(model, limited, forward)
        for joint, beyond in zip(limited, far, strict=True):
            if not beyond <= bound.value:
                yield Finding(
                    check="dynamics.stop",
                    part=joint.child,
                    joint=joint.name,
                    value=float(beyond),
                    bound=bound.at_most(),
                    cause=f"thrown at its {'upper' if forward else 'lower'} stop it goes beyond",
                    remedy="state the limit so that the simulator enforces it, or mend the mass",
                )


def overshoot(model: mujoco.MjModel, joints: Sequence[Joint], forward: bool) -> Floats:
    """How far beyond its stop each joint goes when thrown at it, rad or m; nan if it diverges."""
    if not joints:
        return np.zeros(0)
    data = mujoco.MjData(model)
    own = np.array([model.joint(joint.name).id for joint in joints])
    start, span = _course(joints, forward)
    stop, way = start + span, np.sign(span)
    data.qpos[own] = stop - way * np.minimum(RUN_UP * np.abs(span), RUN_UP)
    data.qvel[own] = way * np.minimum([joint.velocity for joint in joints], FASTEST)
    bring_followers(model, data)
    beyond = np.zeros(len(joints))
    with simulating(model):
        model.opt.timestep = coarse_step(model)
        for _ in range(math.ceil(STOP_SECONDS / (CHUNK * model.opt.timestep))):
            mujoco.mj_step(model, data, nstep=CHUNK)
            beyond = np.maximum(beyond, (data.qpos[own] - stop) * way)
    return beyond


def conserves(subject: Subject) -> Iterator[Finding | Simulated]:
    """Without friction, damping and stops, a swing keeps its energy; what does not is driven."""
    bound, model = subject.bounds.energy_drift, subject.simulated
    if model.nv == 0:
        return
    middle, *ends = (_at_share(subject, model, share) for share in (0.5, 0.0, 1.0))
    task = Task(
        name="dynamics.energy", start=middle, velocity=np.full(model.nv, PUSH), lossless=True
    )
    with unlatched(model):
        effects = needed_effects(model, task)
        with only(model, effects):
            drift = energy_drift(model, middle, *ends)
    yield Simulated(check=task.name, effects=effects.told)
    if not drift <= bound.value:
        yield Finding(
            check="dynamics.energy",
            part="object",
            value=drift,
            bound=bound.at_most(),
            cause="swinging freely it gains or loses energy",
            remedy="look for near-singular inertia or a stiff spring",
        )


@contextmanager
def unlatched(model: mujoco.MjModel) -> Iterator[None]:
    """Within, latches do not pull: no integrator keeps the energy of a swing over the kink where
    their force ends."""
    before = model.tendon_stiffness.copy()
    model.tendon_stiffness[:] = before.clip(min=0.0)
    try:
        yield
    finally:
        model.tendon_stiffness[:] = before


def _at_share(subject: Subject, model: mujoco.MjModel, share: float) -> Floats:
    """qpos with every joint at a share of its range."""
    q = np.zeros(model.nq)
    for joint in subject.joints:
        if joint.limit is not None:
            reach = joint.limit.upper - joint.limit.lower
            q[model.joint(joint.name).id] = joint.limit.lower + share * reach
    return q


def energy_drift(model: mujoco.MjModel, start: Floats, *others: Floats) -> float:
    """Largest change of energy over a swing from `start`, as a share of kinetic energy and m g L.

    The step follows from the strongest pull at `start` and at `others`: where a lid stands upright
    gravity does not pull at all.
    """
    data = mujoco.MjData(model)
    with simulating(model, on=int(mujoco.mjtEnableBit.mjENBL_ENERGY)):
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
        model.opt.timestep = min(_fine_step(model, data, q) for q in (start, *others))
        data.qpos[:], data.qvel[:] = start, PUSH
        mujoco.mj_forward(model, data)
        before = float(data.energy.sum())
        scale = float(data.energy[1]) + _lever(model, data)
        drift = 0.0
        for _ in range(SWING_STEPS // (2 * CHUNK)):
            mujoco.mj_step(model, data, nstep=2 * CHUNK)
            mujoco.mj_forward(model, data)
            drift = float(np.fmax(drift, abs(data.energy.sum() - before)))
    return drift / scale if np.isfinite(data.qpos).all() else math.inf


def _lever(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    """m g L of the moving parts, J: their weight times how far they are from their joints."""
    arms = np.linalg.norm(data.xipos[1:] - data.xpos[1:], axis=1)
    return float(np.linalg.norm(model.opt.gravity) * (model.body_mass[1:] @ arms)) + 1e-12


def _fine_step(model: mujoco.MjModel, data: mujoco.MjData, q: Floats) -> float:
    """A sixtieth of the shortest period that gravity and springs can drive at `q`, s; 10 ms at
    most."""
    mass = np.zeros((model.nv, model.nv))
    data.qpos[:], data.qvel[:] = q, 0.0
    mujoco.mj_forward(model, data)
    mujoco.mj_fullM(model, data, mass)
    stiff = model.jnt_stiffness + np.abs(model.tendon_stiffness).max(initial=0.0) * latched(model)
    pull = np.abs(data.qfrc_bias) + stiff
    rate = math.sqrt(float((pull * np.diag(np.linalg.inv(mass))).max())) + PUSH
    longest = int(np.bincount(model.dof_treeid[model.dof_treeid >= 0]).max(initial=0))
    steps = STEPS_A_PERIOD * (2.0 if longest > 2 else 1.0)  # A chain whips as it falls.
    return min(0.01, 2.0 * math.pi / rate / steps)
