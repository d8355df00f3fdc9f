"""L3: MuJoCo compiles the files, and the models hold what the asset states."""

from collections.abc import Iterator, Mapping, Sequence

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from artgen.articulation.types import Joint
from artgen.core.mesh import Floats
from artgen.validate.report import Finding
from artgen.validate.subject import Subject, SubjectPart

SLIDE = int(mujoco.mjtJoint.mjJNT_SLIDE)
EFFECTS = {
    "contact": int(mujoco.mjtDisableBit.mjDSBL_CONTACT),
    "constraint": int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT),
    "equality": int(mujoco.mjtDisableBit.mjDSBL_EQUALITY),
    "frictionloss": int(mujoco.mjtDisableBit.mjDSBL_FRICTIONLOSS),
    "limit": int(mujoco.mjtDisableBit.mjDSBL_LIMIT),
    "gravity": int(mujoco.mjtDisableBit.mjDSBL_GRAVITY),
    "spring": int(mujoco.mjtDisableBit.mjDSBL_SPRING),
    "damper": int(mujoco.mjtDisableBit.mjDSBL_DAMPER),
}
HINGE = int(mujoco.mjtJoint.mjJNT_HINGE)


def compiles(subject: Subject) -> Iterator[Finding]:
    """MuJoCo compiles the files."""
    for file in subject.model_files:
        try:
            subject.model(file)
        except ValueError as error:
            yield Finding(
                check="compile.file",
                part=file,
                value=" ".join(str(error).split()),
                bound="a model",
                cause="MuJoCo refuses the file",
                remedy="mend the element that its message names",
            )


def effects(subject: Subject) -> Iterator[Finding]:
    """No effect that the object needs is switched off in the file."""
    for file in subject.model_files:
        off = subject.model(file).opt.disableflags
        for name, bit in EFFECTS.items():
            if off & bit:
                yield Finding(
                    check="compile.effect",
                    part=file,
                    value=f"{name} is off",
                    bound=f"{name} in force",
                    cause="the file switches it off, so whatever it should do does not happen",
                    remedy="remove the flag",
                )


def joints(subject: Subject) -> Iterator[Finding]:
    """Every joint is there, of its kind, and its limits are really in force."""
    for file in subject.model_files:
        model = subject.model(file)
        if model.nv != len(subject.joints):
            expected = f"{len(subject.joints)} degrees of freedom"
            yield _compile_finding("compile.dof", file, float(model.nv), expected)
            continue
        for joint in subject.joints:
            yield from _joint_findings(file, model, joint)


def _joint_findings(file: str, model: mujoco.MjModel, joint: Joint) -> Iterator[Finding]:
    label = f"{joint.name} ({file})"
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint.name)
    if number < 0:
        yield _compile_finding("compile.joint", label, "missing", "a joint of that name")
        return
    kind = SLIDE if joint.type == "prismatic" else HINGE
    if model.jnt_type[number] != kind:
        yield _compile_finding("compile.joint", label, f"type {model.jnt_type[number]}", f"{kind}")
    limited = bool(model.jnt_limited[number])
    if limited != (joint.limit is not None):
        yield _compile_finding("compile.limit", label, f"limited = {limited}", joint.type)
    elif joint.limit is not None:
        found = model.jnt_range[number].tolist()
        if found != [joint.limit.lower, joint.limit.upper]:
            expected = f"[{joint.limit.lower}, {joint.limit.upper}]"
            yield _compile_finding("compile.limit", label, str(found), expected)


def _compile_finding(check: str, part: str, value: float | str, bound: str) -> Finding:
    return Finding(
        check=check,
        part=part,
        value=value,
        bound=bound,
        cause="the compiled model differs from what the asset states",
        remedy="check the exporter, then export anew",
    )


def bodies(subject: Subject) -> Iterator[Finding]:
    """Every link is a body of its own."""
    for file in subject.model_files:
        for name in subject.links:
            if mujoco.mj_name2id(subject.model(file), mujoco.mjtObj.mjOBJ_BODY, name) < 0:
                yield _compile_finding("compile.body", f"{name} ({file})", "missing", "a body")


def masses(subject: Subject) -> Iterator[Finding]:
    """Compiled mass, center and inertia of each part are those that the asset states."""
    bound = subject.bounds.agreement.value
    for file in subject.model_files:
        model = subject.model(file)
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        for part in subject.parts:
            own = [name for name, link in subject.links.items() if link.part == part.name]
            for what, value in _mass_errors(model, data, part, own).items():
                if not value <= bound:
                    label, expected = f"{part.name} ({file})", f"{what} as stated within {bound:g}"
                    yield _compile_finding("compile.mass", label, value, expected)


def _mass_errors(
    model: mujoco.MjModel, data: mujoco.MjData, part: SubjectPart, links: Sequence[str]
) -> Mapping[str, float]:
    """Relative errors of mass and tensor, and the center's in m, of one compiled part at rest."""
    if part.mass is None:
        return {}
    mass, center, tensor = compiled_mass(model, data, [model.body(name).id for name in links])
    largest = np.abs(part.mass.inertia).max()
    return {
        "mass": abs(mass / part.mass.mass - 1.0),
        "center": float(np.abs(center - part.mass.center).max()),
        "inertia": float(np.abs(tensor - part.mass.inertia).max() / largest),
    }


def compiled_mass(
    model: mujoco.MjModel, data: mujoco.MjData, bodies: Sequence[int]
) -> tuple[float, Floats, Floats]:
    """Mass (kg), center (3,) m and tensor (3, 3) kg m2 about it of bodies together, as posed.

    Principal axes are taken from the model: kinematics leaves a turn of less than 1e-6 out of
    `ximat` (`body_sameframe`).
    """
    own = model.body_mass[bodies]
    mass = float(own.sum())
    center = own @ data.xipos[bodies] / mass
    turns = data.xmat[bodies].reshape(-1, 3, 3)
    axes = turns @ Rotation.from_quat(model.body_iquat[bodies], scalar_first=True).as_matrix()
    tensor = ((axes * model.body_inertia[bodies][:, None, :]) @ axes.transpose(0, 2, 1)).sum(axis=0)
    arms = data.xipos[bodies] - center
    second = np.einsum("i,ij,ik->jk", own, arms, arms)
    return mass, center, tensor + np.trace(second) * np.eye(3) - second
