"""Which effects a simulation needs, derived from the model and from what is asked of it.

A derived set is a promise: with everything else switched on too, no joint would move differently by
more than `PROMISE` of its range. `artgen.simulation.proof` measures the promise.

Degrees of freedom are MuJoCo's; a hinge or slide has one, so joint and degree of freedom share
their number in the models of articulated assets with a fixed base.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum

import mujoco
import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats

PROMISE = 1e-6
"""Largest difference of a joint's path, as a share of its range, that leaving effects off makes."""
NEGLIGIBLE = 1e-9
"""Load on a joint, as a share of the weight times the size of what it carries, that counts as none:
rounding of positions of 1 m is 1e-16, and poses of a tilted axis were read from 17 digits."""
STILL = 1e-7
"""rad/s2 or m/s2; what a load may accelerate and still count as none: in the 2 s of the longest
check it moves a joint by 2e-7, less than the 1e-6 asked for. A light knob on a heavy door turns
under loads that are negligible beside the door's weight."""


class Effect(Enum):
    """What MuJoCo computes in a step, and can be told not to."""

    GRAVITY = "gravity"
    CONTACT = "contact"
    LIMIT = "limit"
    FRICTION = "friction loss"
    DAMPING = "damping"
    SPRING = "spring"
    LATCH = "latch"
    ACTUATION = "actuation"
    EQUALITY = "equality"
    SENSOR = "sensor"


DISABLE_BITS: Mapping[Effect, int] = {
    Effect.GRAVITY: mujoco.mjtDisableBit.mjDSBL_GRAVITY,
    Effect.CONTACT: mujoco.mjtDisableBit.mjDSBL_CONTACT,
    Effect.LIMIT: mujoco.mjtDisableBit.mjDSBL_LIMIT,
    Effect.FRICTION: mujoco.mjtDisableBit.mjDSBL_FRICTIONLOSS,
    Effect.DAMPING: mujoco.mjtDisableBit.mjDSBL_DAMPER,
    Effect.SPRING: mujoco.mjtDisableBit.mjDSBL_SPRING,
    Effect.LATCH: mujoco.mjtDisableBit.mjDSBL_SPRING,
    Effect.ACTUATION: mujoco.mjtDisableBit.mjDSBL_ACTUATION,
    Effect.EQUALITY: mujoco.mjtDisableBit.mjDSBL_EQUALITY,
    Effect.SENSOR: mujoco.mjtDisableBit.mjDSBL_SENSOR,
}
"""Springs and latches go by one bit: neither can be had without the other."""
LOSING = frozenset({Effect.CONTACT, Effect.LIMIT, Effect.FRICTION, Effect.DAMPING, Effect.EQUALITY})
"""What takes energy, or is too soft a constraint to give all of it back."""
CONSTRAINTS = frozenset({Effect.CONTACT, Effect.LIMIT, Effect.FRICTION, Effect.EQUALITY})
"""Without any of these the constraint solver has nothing to do."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Task:
    """What a check asks of a simulation that starts at `start`.

    Attributes:
        name: of the check.
        start: (nq,) rad or m.
        velocity: (nv,) rad/s or m/s; None starts at rest.
        driven: joints that the check itself pushes, by number.
        clear: an earlier check has shown that no two parts meet on the way.
        lossless: the check is about energy, so that losses, stops and ties are off by definition.
    """

    name: str
    start: Floats
    velocity: Floats | None = None
    driven: frozenset[int] = frozenset()
    clear: bool = False
    lossless: bool = False


@dataclass(frozen=True)
class Call:
    """Whether an effect is called for, and why."""

    effect: Effect
    needed: bool
    reason: str


@dataclass(frozen=True)
class Effects:
    """A decision on every effect, in the order of `Effect`."""

    calls: tuple[Call, ...]

    @property
    def needed(self) -> frozenset[Effect]:
        """What is switched on."""
        return frozenset(call.effect for call in self.calls if call.needed)

    @property
    def told(self) -> dict[str, str]:
        """Effect to `on: reason` or `off: reason`, for a report."""
        return {
            call.effect.value: f"{'on' if call.needed else 'off'}: {call.reason}"
            for call in self.calls
        }


def needed_effects(model: mujoco.MjModel, task: Task) -> Effects:
    """The effects without which the task's motion would come out differently.

    A joint stirs when it is driven, thrown, or loaded at the start, by weight or spring, beyond
    what its friction holds, or when it shares a kinematic tree with one that stirs. What acts only
    on joints that stand still is not needed.
    """
    loads = _Loads(model, task)
    calls = (
        _gravity(loads),
        _contact(model, loads, task),
        _limit(model, loads),
        _friction(model, loads),
        _damping(model, loads),
        _spring(model, loads),
        _latch(model, loads),
        _actuation(model),
        _equality(model, loads),
        Call(Effect.SENSOR, False, "positions are read from the state itself"),
    )
    return Effects(tuple(_conserving(call) if task.lossless else call for call in calls))


def _conserving(call: Call) -> Call:
    if call.effect in LOSING:
        return Call(call.effect, False, "the check is about energy, which it would change")
    return call


@contextmanager
def only(model: mujoco.MjModel, effects: Effects) -> Iterator[None]:
    """Within, MuJoCo computes these effects alone."""
    before = int(model.opt.disableflags)
    flags = before
    for bit in DISABLE_BITS.values():
        flags |= int(bit)
    for effect in effects.needed:
        flags &= ~int(DISABLE_BITS[effect])
    if not effects.needed & CONSTRAINTS:
        flags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    model.opt.disableflags = flags
    try:
        yield
    finally:
        model.opt.disableflags = before


class _Loads:
    """Generalized forces (nv,) at the start and over the joints' ranges, and what they stir."""

    def __init__(self, model: mujoco.MjModel, task: Task) -> None:
        data = mujoco.MjData(model)
        data.qpos[:] = task.start
        self.weight = np.zeros(model.nv)
        for pose in _poses(model, task.start):
            self.weight = np.maximum(self.weight, np.abs(_weight(model, data, pose)))
        self.scale = NEGLIGIBLE * _moments(model)
        at_start = -_weight(model, data, task.start) + _spring_force(model, data, task.start)
        moving = np.zeros(model.nv) if task.velocity is None else np.abs(task.velocity)
        thrown = moving > 0.0
        pushed = np.isin(np.arange(model.nv), list(task.driven))
        loaded = np.abs(at_start) > np.minimum(self.scale, STILL * model.dof_M0)
        self.loaded = loaded
        self.stirring = _with_their_trees(model, thrown | pushed | loaded)


def _weight(model: mujoco.MjModel, data: mujoco.MjData, pose: Floats) -> Floats:
    """(nv,) torque or force of gravity against each degree of freedom, N m or N."""
    data.qpos[:] = pose
    data.qvel[:] = 0.0
    flags = int(model.opt.disableflags)
    model.opt.disableflags = flags & ~int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    force = np.zeros(model.nv)
    try:
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 0, force)
    finally:
        model.opt.disableflags = flags
    return force


def _poses(model: mujoco.MjModel, start: Floats) -> list[Floats]:
    """The start, both ends and the middle of every joint alone, and all joints at each of these."""
    poses = [np.array(start)]
    if model.nq != model.nv:
        return poses  # A free base turns by quaternions; it falls anyhow.
    ends = np.where(model.jnt_limited[:, None], model.jnt_range, (-np.pi, np.pi))
    ends = np.where(np.isfinite(ends), ends, 0.0)
    for share in (0.0, 0.5, 1.0):
        together = ends[:, 0] + share * (ends[:, 1] - ends[:, 0])
        poses.append(together)
        for joint in range(model.nq):
            alone = np.array(start)
            alone[joint] = together[joint]
            poses.append(alone)
    return poses


def _moments(model: mujoco.MjModel) -> Floats:
    """(nv,) weight of all that a degree of freedom carries times the model's extent: N m, which for
    a slide stands for N of a body of 1 m."""
    carried = model.body_subtreemass[model.dof_bodyid]
    gravity = max(float(np.linalg.norm(model.opt.gravity)), NEGLIGIBLE)
    return np.asarray(carried * gravity * max(float(model.stat.extent), NEGLIGIBLE))


def _spring_force(model: mujoco.MjModel, data: mujoco.MjData, pose: Floats) -> Floats:
    """(nv,) of springs and latches at a pose, N m or N."""
    data.qpos[:] = pose
    data.qvel[:] = 0.0
    flags = int(model.opt.disableflags)
    model.opt.disableflags = flags & ~int(mujoco.mjtDisableBit.mjDSBL_SPRING)
    try:
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_tendon(model, data)
        mujoco.mj_passive(model, data)
    finally:
        model.opt.disableflags = flags
    return np.array(data.qfrc_spring)


def _with_their_trees(model: mujoco.MjModel, stirred: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(nv,) all degrees of freedom of the kinematic trees in which one is stirred, and of those
    that an equality ties to them."""
    trees = set(model.dof_treeid[stirred].tolist())
    ties = _tied_trees(model)
    while grown := {other for pair in ties if pair & trees for other in pair} - trees:
        trees |= grown
    return np.isin(model.dof_treeid, sorted(trees))


def _tied_trees(model: mujoco.MjModel) -> list[set[int]]:
    ties = []
    for kind, first, second in zip(model.eq_type, model.eq_obj1id, model.eq_obj2id, strict=True):
        if kind == mujoco.mjtEq.mjEQ_JOINT and second >= 0:
            dofs = model.jnt_dofadr[[first, second]]
            ties.append({int(model.dof_treeid[dof]) for dof in dofs})
    return ties


def _gravity(loads: _Loads) -> Call:
    strongest = _largest(loads.weight, loads.scale)
    if strongest is None:
        return Call(Effect.GRAVITY, False, "no joint lifts or lowers anything, at any pose")
    return Call(Effect.GRAVITY, True, f"weight loads a joint with up to {strongest:.3g} N or N m")


def _contact(model: mujoco.MjModel, loads: _Loads, task: Task) -> Call:
    if not loads.stirring.any():
        return Call(Effect.CONTACT, False, "nothing moves")
    if task.clear:
        return Call(Effect.CONTACT, False, "the sweeps have shown that no parts meet on the way")
    if model.ngeom < 2:
        return Call(Effect.CONTACT, False, "there is nothing to touch")
    return Call(Effect.CONTACT, True, "parts may meet on the way; no sweep has shown otherwise")


def _limit(model: mujoco.MjModel, loads: _Loads) -> Call:
    limited = model.jnt_limited[model.dof_jntid].astype(bool)
    return _acting(Effect.LIMIT, limited & loads.stirring, "may reach its stop", "reaches a stop")


def _friction(model: mujoco.MjModel, loads: _Loads) -> Call:
    rubbing = (model.dof_frictionloss > 0.0) & loads.stirring
    return _acting(
        Effect.FRICTION, rubbing, "rubs while it moves or is held", "both rubs and moves"
    )


def _damping(model: mujoco.MjModel, loads: _Loads) -> Call:
    damped = (model.dof_damping != 0.0) & loads.stirring
    return _acting(Effect.DAMPING, damped, "is damped while it moves", "is both damped and moving")


def _spring(model: mujoco.MjModel, loads: _Loads) -> Call:
    """MuJoCo leaves out every passive force with springs and dampers, a medium's drag too."""
    if model.opt.density > 0.0 or model.opt.viscosity > 0.0 or model.ngravcomp:
        return Call(Effect.SPRING, True, "a medium or a counterweight acts with the springs")
    sprung = (model.jnt_stiffness[model.dof_jntid] != 0.0) & loads.stirring
    return _acting(Effect.SPRING, sprung, "works against a spring", "has a spring and moves")


def _latch(model: mujoco.MjModel, loads: _Loads) -> Call:
    """A tendon with a spring of its own; latches are those along one joint."""
    held = latched(model) & loads.stirring
    return _acting(Effect.LATCH, held, "is held by a latch or tendon", "has a latch and moves")


def latched(model: mujoco.MjModel) -> NDArray[np.bool_]:
    """(nv,) whether a tendon with stiffness pulls at each degree of freedom."""
    sprung = np.zeros(model.nv, bool)
    for tendon in np.flatnonzero(model.tendon_stiffness):
        first, count = model.tendon_adr[tendon], model.tendon_num[tendon]
        own = slice(first, first + count)
        if (model.wrap_type[own] != mujoco.mjtWrap.mjWRAP_JOINT).any():
            return np.ones(model.nv, bool)  # It runs through space, and may pull anywhere.
        sprung[model.jnt_dofadr[model.wrap_objid[own]]] = True
    return sprung


def _actuation(model: mujoco.MjModel) -> Call:
    if model.nu == 0:
        return Call(Effect.ACTUATION, False, "the asset has no actuator; checks push joints")
    return Call(Effect.ACTUATION, True, f"the asset has {model.nu} actuators")


def _equality(model: mujoco.MjModel, loads: _Loads) -> Call:
    if not model.eq_active0.any():
        return Call(Effect.EQUALITY, False, "no joint follows another")
    if not loads.stirring.any():
        return Call(Effect.EQUALITY, False, "nothing moves")
    return Call(Effect.EQUALITY, True, "a joint follows another")


def _acting(effect: Effect, dofs: NDArray[np.bool_], does: str, none: str) -> Call:
    count = int(dofs.sum())
    if count == 0:
        return Call(effect, False, f"no joint {none}")
    return Call(effect, True, f"{count} joint{'s' if count > 1 else ''}: each {does}")


def _largest(values: Floats, scale: Sequence[float] | Floats) -> float | None:
    above = np.asarray(values)[np.asarray(values) > np.asarray(scale)]
    return float(above.max()) if above.size else None
