"""Paths of joints under chosen effects, and the proof that what was left off did not matter."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace

import mujoco
import numpy as np
from mujoco import rollout

from artgen.core.mesh import Floats
from artgen.simulation.effects import (
    PROMISE,
    Call,
    Effect,
    Effects,
    Task,
    needed_effects,
    only,
)

STRAY = 1e-3
"""rad or m beyond a stop, up to which the sweeps' word holds that no parts meet."""
ALL = Effects(tuple(Call(effect, True, "asked for") for effect in Effect))
"""Everything on."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Agreement:
    """A task's motion with the needed effects against the motion with all.

    Attributes:
        difference: largest, as a share of each joint's range.
        seconds, seconds_all: CPU time with the needed effects and with all.
    """

    task: str
    effects: Effects
    difference: float
    seconds: float
    seconds_all: float

    @property
    def holds(self) -> bool:
        """Whether the effects' promise was kept."""
        return self.difference <= PROMISE


def joint_path(
    model: mujoco.MjModel, task: Task, effects: Effects, *, steps: int, force: Floats | None = None
) -> Floats:
    """(steps, nq) positions after each step.

    Args:
        force: (nv,) rad/s^2-causing torque N m or force N that pushes all the while.
    """
    data = mujoco.MjData(model)
    data.qpos[:] = task.start
    if task.velocity is not None:
        data.qvel[:] = task.velocity
    pushed = np.zeros(model.nv) if force is None else force
    with only(model, effects):
        start = np.zeros((1, mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)))
        mujoco.mj_getState(model, data, start[0], mujoco.mjtState.mjSTATE_FULLPHYSICS)
        states, _ = rollout.rollout(
            [model],
            [data],
            start,
            np.broadcast_to(pushed, (1, steps, model.nv)).copy(),
            control_spec=int(mujoco.mjtState.mjSTATE_QFRC_APPLIED),
        )
    path: Floats = states[0, :, 1 : 1 + model.nq]
    return path


def agreement(
    model: mujoco.MjModel, task: Task, *, seconds: float, force: Floats | None = None
) -> Agreement:
    """The promise of `needed_effects`, measured over `seconds` of simulated time, or until a joint
    goes so far beyond a soft stop that parts may meet which the task calls clear."""
    steps = max(1, round(seconds / model.opt.timestep))
    effects = needed_effects(model, task)
    started = time.process_time()
    lean = joint_path(model, task, effects, steps=steps, force=force)
    halfway = time.process_time()
    full = joint_path(model, task, ALL, steps=steps, force=force)
    told = _first_stray(model, lean) if task.clear else steps
    return Agreement(
        task=task.name,
        effects=effects,
        difference=path_difference(model, lean[:told], full[:told]),
        seconds=halfway - started,
        seconds_all=time.process_time() - halfway,
    )


def _first_stray(model: mujoco.MjModel, path: Floats) -> int:
    """The first step, after one at least, that ends beyond a stop by more than `STRAY`."""
    limited = model.jnt_limited.astype(bool)
    lower, upper = model.jnt_range[limited].T
    beyond = np.maximum(lower - path[:, limited], path[:, limited] - upper)
    strayed = np.flatnonzero((beyond > STRAY).any(axis=1))
    return max(1, int(strayed[0])) if len(strayed) else len(path)


def price_of_dropping(
    model: mujoco.MjModel, task: Task, *, seconds: float, force: Floats | None = None
) -> Mapping[Effect, float]:
    """How far the motion goes wrong without each needed effect, as a share of the range."""
    steps = max(1, round(seconds / model.opt.timestep))
    effects = needed_effects(model, task)
    full = joint_path(model, task, ALL, steps=steps, force=force)
    return {
        call.effect: path_difference(
            model,
            joint_path(model, task, _without(effects, call.effect), steps=steps, force=force),
            full,
        )
        for call in effects.calls
        if call.needed
    }


def path_difference(model: mujoco.MjModel, one: Floats, other: Floats) -> float:
    """Largest difference between two (steps, nq) paths, as a share of each joint's range; a joint
    without limits counts one turn, or one meter."""
    turn = np.where(model.jnt_type == mujoco.mjtJoint.mjJNT_HINGE, 2.0 * np.pi, 1.0)
    ranges = np.where(model.jnt_limited, model.jnt_range[:, 1] - model.jnt_range[:, 0], turn)
    apart = np.abs(one - other) / ranges
    return float(apart.max()) if np.isfinite(apart).all() else float("inf")


def _without(effects: Effects, left_off: Effect) -> Effects:
    return Effects(
        tuple(
            replace(call, needed=False, reason="dropped to see what it does")
            if call.effect is left_off
            else call
            for call in effects.calls
        )
    )
