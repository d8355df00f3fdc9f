"""L6: set on a floor and let go, the object stays where it is."""

import math
from collections.abc import Iterator

import mujoco
import numpy as np

from artgen.core.errors import RuleError
from artgen.core.mesh import Floats
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.physics import compiled_spec, warnings_of
from artgen.validate.report import Finding, Skipped
from artgen.validate.semantics import packaged_rule
from artgen.validate.subject import Subject

SECONDS = 1.0
"""Time enough for an object whose weight lies beside its feet to tilt by degrees."""


def stands(subject: Subject) -> Iterator[Finding | Skipped]:
    """With a free base on a plane it neither tilts nor sinks; what MuJoCo warns of is told."""
    file = subject.model_files[0]
    if isinstance(subject, BundleSubject) and is_mounted(subject):
        yield Skipped(name="dynamics.free", reason="its rule says that it is mounted, not set down")
        return
    spec, base = subject.spec(file), subject.parts[0].name
    body = spec.body(base)
    if body is None or body.parent is None or body.parent.name != "world":
        yield Skipped(name="dynamics.free", reason=f"{base} is the world; it cannot be let go")
        return
    floor = min(float(piece.bounds[0, 2]) for own in subject.collision.values() for piece in own)
    body.add_freejoint()
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0.0, 0.0, 1.0), pos=(0.0, 0.0, floor)
    )
    tilt, drop, trouble = let_go(compiled_spec(spec), base)
    found = (
        ("tilt", tilt, subject.bounds.tilt, "its center of mass is not above its feet"),
        ("drop", drop, subject.bounds.drop, "no contact piece carries it at its lowest point"),
        ("simulation", float(len(trouble)), None, f"MuJoCo warns of {', '.join(trouble)}"),
    )
    for what, value, bound, cause in found:
        if not value <= (0.0 if bound is None else bound.value):
            yield Finding(
                check="dynamics.free",
                part=what,
                value=value,
                bound="no warning" if bound is None else bound.at_most(),
                cause=f"free on a floor for {SECONDS:g} s: {cause}",
                remedy="author contact pieces for the feet, and check masses and their centers",
            )


def is_mounted(subject: BundleSubject) -> bool:
    """Whether the category's rule says so; not where there is no rule."""
    try:
        return packaged_rule(subject.bundle.category).mounted
    except RuleError:
        return False


def let_go(model: mujoco.MjModel, base: str) -> tuple[float, float, list[str]]:
    """Degrees that the base tilts and meters that it sinks or rises, and MuJoCo's warnings."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    number = model.body(base).id
    before, height = _upright(data, number), float(data.xipos[number, 2])
    mujoco.mj_step(model, data, nstep=round(SECONDS / model.opt.timestep))
    cosine = float(np.clip(before @ _upright(data, number), -1.0, 1.0))
    sunk = abs(float(data.xipos[number, 2]) - height)
    return math.degrees(math.acos(cosine)), sunk, warnings_of(data)


def _upright(data: mujoco.MjData, body: int) -> Floats:
    """(3,) the body's own z axis in the world."""
    return np.array(data.xmat[body].reshape(3, 3)[:, 2])
