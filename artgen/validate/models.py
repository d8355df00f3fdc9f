"""L3: MuJoCo compiles MJCF and URDF, and the models hold what the manifest states."""

from collections.abc import Iterator, Mapping

import mujoco
import numpy as np

from artgen.articulation.types import Joint
from artgen.export.bundle import BundlePart
from artgen.export.layout import MJCF, URDF
from artgen.validate import bounds
from artgen.validate.physics import body_names
from artgen.validate.report import Finding
from artgen.validate.subject import Subject

SLIDE = int(mujoco.mjtJoint.mjJNT_SLIDE)
HINGE = int(mujoco.mjtJoint.mjJNT_HINGE)


def compiles(subject: Subject) -> Iterator[Finding]:
    """MuJoCo compiles MJCF and URDF."""
    for file in (MJCF, URDF):
        try:
            subject.model(file)
        except ValueError as error:
            yield Finding(
                check="compile.file",
                part=file,
                value=" ".join(str(error).split()),
                bound="a model",
                message="MuJoCo refuses the file; its message tells the element",
            )


def joints(subject: Subject) -> Iterator[Finding]:
    """Every joint is there, of its kind, and its limits are really in force."""
    for file in (MJCF, URDF):
        model = subject.model(file)
        if model.nv != len(subject.bundle.joints):
            yield _compile_finding(
                "compile.dof",
                file,
                float(model.nv),
                f"{len(subject.bundle.joints)} degrees of freedom",
            )
            continue
        for joint in subject.bundle.joints:
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
    message = "the compiled model differs from the manifest; check the exporter, then export anew"
    return Finding(check=check, part=part, value=value, bound=bound, message=message)


def bodies(subject: Subject) -> Iterator[Finding]:
    """Every part is a body of its own."""
    for file in (MJCF, URDF):
        names = body_names(subject.model(file))
        for part in subject.bundle.parts:
            if part.name not in names:
                yield _compile_finding("compile.body", f"{part.name} ({file})", "missing", "a body")


def masses(subject: Subject) -> Iterator[Finding]:
    """Compiled mass, center and inertia of each body are those of the manifest."""
    for file in (MJCF, URDF):
        data = mujoco.MjData(subject.model(file))
        mujoco.mj_kinematics(subject.model(file), data)
        for part in subject.bundle.parts:
            for what, value in _mass_errors(subject.model(file), data, part).items():
                if not value <= bounds.AGREEMENT.value:
                    label = f"{part.name} ({file})"
                    expected = f"{what} of the manifest within {bounds.AGREEMENT.value:g}"
                    yield _compile_finding("compile.mass", label, value, expected)


def _mass_errors(
    model: mujoco.MjModel, data: mujoco.MjData, part: BundlePart
) -> Mapping[str, float]:
    """Relative errors of mass and tensor, and the center's in m, of one compiled body at rest."""
    body = model.body(part.name).id
    axes = data.ximat[body].reshape(3, 3)
    tensor = (axes * model.body_inertia[body]) @ axes.T
    largest = np.abs(part.mass.inertia).max()
    return {
        "mass": abs(float(model.body_mass[body]) / part.mass.mass - 1.0),
        "center": float(np.abs(data.xipos[body] - part.mass.center).max()),
        "inertia": float(np.abs(tensor - part.mass.inertia).max() / largest),
    }
