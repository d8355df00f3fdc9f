"""L6: left alone, joints stay where friction, springs and stops hold them."""

from collections.abc import Iterator

import mujoco
import numpy as np

from artgen.articulation.types import Joint
from artgen.core.errors import RuleError
from artgen.core.mesh import Floats
from artgen.simulation.effects import Task, needed_effects, only
from artgen.validate.bounds import Bounds
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.physics import coarse_step, simulating, warnings_of
from artgen.validate.report import Finding, Simulated
from artgen.validate.semantics import packaged_rule
from artgen.validate.subject import Subject

SETTLE_SECONDS = 2.0
"""Long enough for friction creep and for a part that is not held to swing away."""
HELD_POSES = 21
TAKEN_ALONG = 1e-3
"""Share of what the loosest joint of a chain gives way by which the chain's others may move."""


def settles(subject: Subject) -> Iterator[Finding | Simulated]:
    """Left alone for two seconds, joints stay within the sag and creep of soft constraints."""
    model = subject.simulated
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    # Where nothing touches at rest and all that moves is held, contact cannot act.
    task = Task(name="dynamics.settle", start=np.array(data.qpos), clear=data.ncon == 0)
    effects = needed_effects(model, task)
    yield Simulated(check=task.name, effects=effects.told)
    with simulating(model), only(model, effects):
        model.opt.timestep = coarse_step(model)
        allowed = drift_bound(model, data, subject.bounds)
        mujoco.mj_step(model, data, nstep=round(SETTLE_SECONDS / model.opt.timestep))
    for name in warnings_of(data):
        yield _settle_finding("simulation", name, "no warning", "the simulation is unstable")
    drift = np.abs(data.qpos)
    for joint in subject.joints:
        number = model.joint(joint.name).id
        found, bound = float(drift[number]), float(allowed[number])
        if not found <= bound:
            cause = "gravity or a spring moves it from rest, or contact pushes it"
            yield _settle_finding(joint.name, found, f"<= {bound:.3g} rad or m", cause)


def _settle_finding(part: str, value: float | str, bound: str, cause: str) -> Finding:
    return Finding(
        check="dynamics.settle",
        part=part,
        joint=None if part == "simulation" else part,
        value=value,
        bound=bound,
        cause=f"after {SETTLE_SECONDS:g} s: {cause}",
        remedy="raise the joint's friction, or move its stop to where it comes to rest",
    )


def drift_bound(model: mujoco.MjModel, data: mujoco.MjData, bounds: Bounds) -> Floats:
    """How far each joint (a degree of freedom each) may move while friction or a stop holds it.

    MuJoCo's constraints are soft: with impedance d and the acceleration a that the load on a joint
    would give it, it ends where the reference acceleration is (1 - d) / d a. So a stop (solref t,
    z) sags by (1 - d) / d a (dmax t z)^2 / d, a coupling too, and friction creeps at
    (1 - d) / d a dmax t / 2 (MuJoCo manual, Computation, Parameters); t counts as two steps where
    it is less (`refsafe`). Joints above and below are taken along a little. A joint that none of
    them holds has no such excuse.
    """
    load, slack = coupled(model, np.abs(data.qfrc_smooth))
    free, least = model.dof_invweight0 * load, 2.0 * model.opt.timestep
    stop = _softness(model.jnt_solimp) * free
    times = np.fmax(model.jnt_solref[:, 0], least) * model.jnt_solref[:, 1]
    sag = stop * (model.jnt_solimp[:, 1] * times) ** 2
    slow = model.dof_solimp[:, 1] * np.fmax(model.dof_solref[:, 0], least)
    creep = _softness(model.dof_solimp) * free * slow / 2.0
    held = np.where(model.dof_frictionloss > 0.0, creep * SETTLE_SECONDS, 0.0)
    stopped = np.where(model.jnt_limited, sag / model.jnt_solimp[:, 0], 0.0)
    given = held + stopped + slack
    for tree in range(model.ntree):
        own = model.dof_treeid == tree
        given[own] += TAKEN_ALONG * given[own].max(initial=0.0)
    return np.asarray(bounds.settle_factor.value * given + bounds.settle_floor.value)


def coupled(model: mujoco.MjModel, load: Floats) -> tuple[Floats, Floats]:
    """(nv,) loads, N m or N, where of two coupled joints either may carry both, and how far the
    couplings give way, rad or m. Joint 1 moves ratio times as far as joint 2."""
    load, slack = load.copy(), np.zeros(model.nv)
    for tie in np.flatnonzero(model.eq_type == mujoco.mjtEq.mjEQ_JOINT):
        pair = model.eq_obj1id[tie], model.eq_obj2id[tie]
        ratio, impedance = abs(float(model.eq_data[tie, 1])), model.eq_solimp[tie]
        if pair[1] < 0 or ratio == 0.0:
            continue
        one, other = load[[*pair]]
        load[[*pair]] = one + other / ratio, other + ratio * one
        time, damping = model.eq_solref[tie]
        times = max(time, 2.0 * model.opt.timestep) * damping * impedance[1]
        apart = (model.dof_invweight0[[*pair]] * load[[*pair]]).sum()
        sag = (1.0 - impedance[0]) / impedance[0] ** 2 * apart * times**2
        slack[[*pair]] += sag, sag / ratio
    return load, slack


def _softness(solimp: Floats) -> Floats:
    """(1 - d) / d at the softest impedance d of each constraint."""
    return np.asarray((1.0 - solimp[:, 0]) / solimp[:, 0])


def holds(subject: BundleSubject) -> Iterator[Finding]:
    """Parts that must stay where they are put have friction for the load of gravity and spring, at
    every angle."""
    model, bound = subject.simulated, subject.bounds.hold_margin
    data = mujoco.MjData(model)
    held = {part.name for part in subject.parts if part.label in held_labels(subject)}
    for joint in subject.joints:
        if joint.child not in held or joint.limit is None:
            continue
        path = np.linspace(joint.limit.lower, joint.limit.upper, HELD_POSES)[1:-1]
        share, q = min((joint.friction / max(_load(model, data, joint, q), 1e-12), q) for q in path)
        if share < bound.value:
            yield Finding(
                check="dynamics.hold",
                part=joint.child,
                joint=joint.name,
                state={joint.name: float(q)},
                value=float(share),
                bound=bound.at_least(),
                cause=f"friction of {joint.friction:g} does not hold it at {q:.3g}",
                remedy="raise the friction, or balance the part by a spring",
            )


def held_labels(subject: BundleSubject) -> tuple[str, ...]:
    """Labels of parts that the category's rule wants held; none where there is no rule."""
    try:
        return packaged_rule(subject.bundle.category).held
    except RuleError:
        return ()


def _load(model: mujoco.MjModel, data: mujoco.MjData, joint: Joint, q: float) -> float:
    """What friction must hold at `q` with all others at rest, N m or N."""
    number = model.joint(joint.name).id
    mujoco.mj_resetData(model, data)
    data.qpos[number] = q
    mujoco.mj_forward(model, data)
    return abs(float(data.qfrc_bias[number] - data.qfrc_passive[number]))
