"""L4: pinocchio, which shares no code with MuJoCo or with us, moves and weighs the object alike."""

from collections.abc import Iterator, Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import mujoco
import numpy as np

from artgen.articulation.kinematics import resolved
from artgen.articulation.types import State
from artgen.core.mesh import Floats
from artgen.validate.motion import link_poses, random_states
from artgen.validate.report import Finding
from artgen.validate.subject import Subject

NEED = "pinocchio"
ABSENT = "pinocchio is not installed: pip install 'artgen[qa]' brings it"


def absent() -> str | None:
    """Why there is no second opinion to be had, or None."""
    return None if find_spec("pinocchio") else ABSENT


def pinocchio(subject: Subject) -> Iterator[Finding]:
    """Link poses, mass matrix and the torque of gravity, at random states."""
    # Half a second that only those pay who have it and ask for it.
    library = import_module("pinocchio")
    try:
        model = library.buildModelFromXML(subject.urdf_text)
    except ValueError as error:
        yield _finding(subject, "reading", str(error), "a model")
        return
    pair = _Pair(library, model, subject)
    worst = dict.fromkeys(("link poses", "mass matrix", "torque of gravity"), 0.0)
    for state in random_states(subject):
        for what, value in pair.differences(subject, state).items():
            worst[what] = float(np.maximum(worst[what], value))
    bound = subject.bounds.pinocchio
    for what, value in worst.items():
        if not value <= bound.value:
            yield _finding(subject, what, value, bound.at_most())


def _finding(subject: Subject, what: str, value: float | str, bound: str) -> Finding:
    return Finding(
        check="motion.pinocchio",
        part=what,
        value=value,
        bound=bound,
        cause=f"pinocchio reads another object from {subject.urdf_file} than MuJoCo and we do",
        remedy="look for what the URDF specification leaves open: defaults, frames, turned inertia",
    )


class _Pair:
    """The URDF as pinocchio and as MuJoCo read it, with their rows for the same joints."""

    def __init__(self, library: Any, model: Any, subject: Subject) -> None:
        self.library, self.model, self.data = library, model, model.createData()
        self.other = subject.model(subject.urdf_file)
        self.other_data = mujoco.MjData(self.other)
        names = [joint.name for joint in subject.joints]
        self.rows = [model.joints[model.getJointId(name)] for name in names]
        self.own = [row.idx_v for row in self.rows]
        self.other_own = [self.other.joint(name).id for name in names]
        self.frames = [model.getFrameId(name) for name in subject.links]
        gravity = float(np.linalg.norm(self.other.opt.gravity))
        self.weight = gravity * float(self.other.body_mass.sum())

    def differences(self, subject: Subject, state: State) -> dict[str, float]:
        """Largest relative difference of each kind at one state."""
        q = list(resolved(subject.joints, state).values())
        place = self.library.neutral(self.model)
        for row, value in zip(self.rows, q, strict=True):
            angle = [np.cos(value), np.sin(value)] if row.nq == 2 else [value]
            place[row.idx_q : row.idx_q + row.nq] = angle
        self.library.framesForwardKinematics(self.model, self.data, place)
        theirs = np.array([self.data.oMf[frame].homogeneous for frame in self.frames])
        ours = np.array(list(link_poses(subject, state).values()))
        upper = np.triu(self.library.crba(self.model, self.data, place))
        pull = self.library.computeGeneralizedGravity(self.model, self.data, place)
        mass = (upper + np.triu(upper, 1).T)[np.ix_(self.own, self.own)]
        expected_mass, expected_pull = self._by_mujoco(q)
        return {
            "link poses": float(np.abs(theirs - ours).max() / max(1.0, float(np.abs(ours).max()))),
            "mass matrix": _relative(mass, expected_mass, 0.0),
            "torque of gravity": _relative(pull[self.own], expected_pull, self.weight),
        }

    def _by_mujoco(self, q: Sequence[float]) -> tuple[Floats, Floats]:
        """Mass matrix and torque of gravity, rows as the joints."""
        model, data, own = self.other, self.other_data, self.other_own
        data.qpos[own] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_crb(model, data)
        mass, pull = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
        mujoco.mj_fullM(model, data, mass)
        mujoco.mj_rne(model, data, 0, pull)
        return mass[np.ix_(own, own)] - np.diag(model.dof_armature[own]), pull[own]


def _relative(one: Floats, other: Floats, scale: float) -> float:
    """Largest difference over the largest element, or over `scale` where that is larger."""
    if not one.size:
        return 0.0
    return float(np.abs(one - other).max() / max(float(np.abs(other).max()), scale))
