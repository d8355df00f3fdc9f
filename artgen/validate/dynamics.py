"""L6: left alone, opened, closed and swung, the object does what its joints promise."""

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco
import numpy as np

from artgen.core.mesh import Floats
from artgen.validate.bounds import Bounds
from artgen.validate.report import Finding
from artgen.validate.subject import Subject

SETTLE_SECONDS = 2.0
"""Long enough for friction creep and for a part that is not held to swing away."""


def settles(subject: Subject) -> Iterator[Finding]:
    """Left alone for two seconds, joints stay within the sag and creep of soft constraints."""
    model = subject.simulated
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    allowed = drift_bound(model, data, subject.bounds)
    with contact_as_needed(model, data):
        mujoco.mj_step(model, data, nstep=round(SETTLE_SECONDS / model.opt.timestep))
    for number, warning in enumerate(data.warning):
        if warning.number > 0:
            name = mujoco.mjtWarning(number).name
            yield _settle_finding("simulation", name, "no warning", "the simulation is unstable")
    drift = np.abs(data.qpos)
    for joint in subject.joints:
        number = model.joint(joint.name).id
        found, bound = float(drift[number]), float(allowed[number])
        if not found <= bound:
            cause = "gravity or a spring moves it from rest, or contact pushes it"
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
        check="dynamics.settle",
        part=part,
        value=value,
        bound=bound,
        cause=f"after {SETTLE_SECONDS:g} s: {cause}",
        remedy="raise the joint's friction, or move its stop to where it comes to rest",
    )


def drift_bound(model: mujoco.MjModel, data: mujoco.MjData, bounds: Bounds) -> Floats:
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
    return np.asarray(bounds.settle_factor.value * (held + stopped) + bounds.settle_floor.value)


def _softness(solimp: Floats) -> Floats:
    """(1 - d) / d at the softest impedance d of each constraint."""
    return np.asarray((1.0 - solimp[:, 0]) / solimp[:, 0])
