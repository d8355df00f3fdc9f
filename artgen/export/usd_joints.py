"""UsdPhysics joints: axes along ours, limits in the degrees that USD wants, drives as dampers.

UsdPhysics has no dry friction, coupling, effort or speed. Friction is stated in the published
schemas of MuJoCo (`mjc:frictionloss`) and Newton (`newton:friction`), a coupling in Newton's and
exactly in `artgen:` attributes, effort, speed and latches in `artgen:` attributes, in SI units.
"""

import json
import math
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Usd, UsdPhysics

from artgen.articulation.types import Joint, JointType, Latch, Mimic, Precondition, Spring
from artgen.core.errors import ExportError
from artgen.core.mesh import Floats
from artgen.core.transform import rigid
from artgen.export.kinematics import FileGrip, FileJoint, FileKinematics, FileMass, vector
from artgen.export.layout import USD
from artgen.export.principal import matrix_from_quaternion, rotation_between

AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
FIXED = "base_to_world"
GRIPS = "grips"
DEGREE = math.pi / 180.0
FLOAT, DOUBLE = Sdf.ValueTypeNames.Float, Sdf.ValueTypeNames.Double


def add_base_joint(stage: Usd.Stage, scope: Sdf.Path, base: Sdf.Path) -> None:
    """Hold the base part where it stands; delete this prim to set the object free."""
    fixed = UsdPhysics.FixedJoint.Define(stage, scope.AppendChild(FIXED))
    fixed.CreateBody1Rel().SetTargets([base])


def add_joint(
    stage: Usd.Stage,
    scope: Sdf.Path,
    top: Sdf.Path,
    joint: Joint,
    frames: Mapping[str, Floats],
    preconditions: Iterable[Precondition],
) -> None:
    """One joint; contact between its two parts stays on, as clearances are designed."""
    kind = UsdPhysics.PrismaticJoint if joint.type == "prismatic" else UsdPhysics.RevoluteJoint
    made = kind.Define(stage, scope.AppendChild(joint.name))
    made.CreateBody0Rel().SetTargets([top.AppendChild(joint.parent)])
    made.CreateBody1Rel().SetTargets([top.AppendChild(joint.child)])
    token, turn = axis_frame(joint.axis)
    made.CreateAxisAttr(token)
    made.CreateLocalPos0Attr(Gf.Vec3f(*np.subtract(joint.origin, frames[joint.parent]).tolist()))
    made.CreateLocalPos1Attr(Gf.Vec3f(0.0))
    made.CreateLocalRot0Attr(turn)
    made.CreateLocalRot1Attr(turn)
    made.CreateCollisionEnabledAttr(True)
    unit = 1.0 if joint.type == "prismatic" else DEGREE
    if joint.limit is not None:
        made.CreateLowerLimitAttr(joint.limit.lower / unit)
        made.CreateUpperLimitAttr(joint.limit.upper / unit)
    _add_drive(made.GetPrim(), joint, unit)
    _add_facts(made.GetPrim(), joint, unit, preconditions)


def axis_frame(axis: Iterable[float]) -> tuple[str, Gf.Quatf]:
    """USD's axis token and the joint frame that turns it onto `axis`; exact for coordinate axes."""
    direction = np.asarray(tuple(axis))
    token = "XYZ"[int(np.argmax(np.abs(direction)))]
    w, x, y, z = rotation_between(np.array(AXES[token]), direction).tolist()
    return token, Gf.Quatf(w, x, y, z)


def _add_drive(prim: Usd.Prim, joint: Joint, unit: float) -> None:
    """Damping and spring as a drive without force limit; USD counts angles in degrees here too."""
    name = "linear" if joint.type == "prismatic" else "angular"
    drive = UsdPhysics.DriveAPI.Apply(prim, name)
    drive.CreateTypeAttr("force")
    drive.CreateDampingAttr(joint.damping * unit)
    drive.CreateTargetVelocityAttr(0.0)
    spring = joint.spring
    drive.CreateStiffnessAttr(0.0 if spring is None else spring.stiffness * unit)
    drive.CreateTargetPositionAttr(0.0 if spring is None else spring.reference / unit)


def _add_facts(
    prim: Usd.Prim, joint: Joint, unit: float, preconditions: Iterable[Precondition]
) -> None:
    numbers = {
        "mjc:frictionloss": joint.friction,
        "newton:friction": joint.friction,
        "artgen:effort": joint.effort,
        "artgen:velocity": joint.velocity,
    }
    if joint.latch is not None:
        numbers |= {
            "artgen:latch:force": joint.latch.force,
            "artgen:latch:reach": joint.latch.reach,
        }
    if joint.mimic is not None:
        numbers |= _mimic_numbers(joint.mimic, unit)
        leader = prim.GetParent().GetPath().AppendChild(joint.mimic.joint)
        for name in ("artgen:mimic:joint", "newton:mimicJoint"):
            prim.CreateRelationship(name).SetTargets([leader])
        prim.AddAppliedSchema("NewtonMimicAPI")
    for name, value in numbers.items():
        # Newton's schema has single precision.
        kind = FLOAT if name.startswith("newton:") else DOUBLE
        prim.CreateAttribute(name, kind).Set(value)
    rules = [[r.requires, r.at_least] for r in preconditions if r.joint == joint.name]
    if rules:
        attribute = prim.CreateAttribute("artgen:requires", Sdf.ValueTypeNames.String)
        attribute.Set(json.dumps(rules))


def _mimic_numbers(mimic: Mimic, unit: float) -> dict[str, float]:
    return {
        "artgen:mimic:multiplier": mimic.multiplier,
        "artgen:mimic:offset": mimic.offset,
        "newton:mimicCoef0": mimic.offset / unit,
        "newton:mimicCoef1": mimic.multiplier,
    }


def load_kinematics(folder: Path) -> FileKinematics:
    """Parts and joints of `folder`/asset.usdc in the object frame; float32 where USD stores that.

    Raises:
        ExportError: the stage has no default prim.
    """
    stage = Usd.Stage.Open(str(folder / USD))
    if not stage or not stage.GetDefaultPrim():
        raise ExportError(f"{folder / USD} has no default prim; export the asset anew")
    root = stage.GetDefaultPrim()
    bodies = [prim for prim in root.GetChildren() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    frames = {prim.GetName(): _translation(prim) for prim in bodies}
    masses = {prim.GetName(): _file_mass(prim, frames[prim.GetName()]) for prim in bodies}
    base, joints = "", []
    for prim in root.GetChild("joints").GetChildren():
        if prim.IsA(UsdPhysics.FixedJoint):
            base = UsdPhysics.Joint(prim).GetBody1Rel().GetTargets()[0].name
        else:
            joints.append(_file_joint(prim, frames))
    grips = [
        _file_grip(grip, prim.GetName(), frames[prim.GetName()])
        for prim in bodies
        if (scope := prim.GetChild(GRIPS))
        for grip in scope.GetChildren()
    ]
    return FileKinematics(base=base, masses=masses, joints=tuple(joints), grips=tuple(grips))


def _file_grip(prim: Usd.Prim, part: str, pivot: Floats) -> FileGrip:
    turn = prim.GetAttribute("xformOp:orient").Get()
    rotation = matrix_from_quaternion(np.array([turn.GetReal(), *turn.GetImaginary()]))
    return FileGrip(
        name=prim.GetName(),
        part=part,
        frame=rigid(rotation, pivot + _translation(prim)),
        kind=prim.GetAttribute("artgen:grip:kind").Get(),
        outward=vector(np.array(prim.GetAttribute("artgen:grip:outward").Get())),
        pull=vector(np.array(prim.GetAttribute("artgen:grip:pull").Get())),
    )


def _translation(prim: Usd.Prim) -> Floats:
    return np.array(prim.GetAttribute("xformOp:translate").Get())


def _file_mass(prim: Usd.Prim, pivot: Floats) -> FileMass:
    api = UsdPhysics.MassAPI(prim)
    axes = api.GetPrincipalAxesAttr().Get()
    turn = matrix_from_quaternion(np.array([axes.GetReal(), *axes.GetImaginary()]))
    tensor = (turn * np.array(api.GetDiagonalInertiaAttr().Get(), float)) @ turn.T
    center = pivot + np.array(api.GetCenterOfMassAttr().Get(), float)
    return FileMass(mass=float(api.GetMassAttr().Get()), center=center, inertia=tensor)


def _file_joint(prim: Usd.Prim, frames: Mapping[str, Floats]) -> FileJoint:
    slides = prim.IsA(UsdPhysics.PrismaticJoint)
    joint = UsdPhysics.PrismaticJoint(prim) if slides else UsdPhysics.RevoluteJoint(prim)
    unit = 1.0 if slides else DEGREE
    parent = joint.GetBody0Rel().GetTargets()[0].name
    lower, upper = joint.GetLowerLimitAttr().Get(), joint.GetUpperLimitAttr().Get()
    limited = math.isfinite(lower)
    turn = joint.GetLocalRot0Attr().Get()
    rotation = matrix_from_quaternion(np.array([turn.GetReal(), *turn.GetImaginary()]))
    drive = UsdPhysics.DriveAPI(prim, "linear" if slides else "angular")
    turning: JointType = "revolute" if limited else "continuous"
    stiffness = drive.GetStiffnessAttr().Get() / unit
    target = drive.GetTargetPositionAttr().Get() * unit
    return FileJoint(
        name=prim.GetName(),
        type="prismatic" if slides else turning,
        parent=parent,
        child=joint.GetBody1Rel().GetTargets()[0].name,
        axis=vector(rotation @ AXES[joint.GetAxisAttr().Get()]),
        origin=vector(frames[parent] + np.array(joint.GetLocalPos0Attr().Get(), float)),
        lower=lower * unit if limited else None,
        upper=upper * unit if limited else None,
        friction=prim.GetAttribute("mjc:frictionloss").Get(),
        damping=drive.GetDampingAttr().Get() / unit,
        effort=prim.GetAttribute("artgen:effort").Get(),
        velocity=prim.GetAttribute("artgen:velocity").Get(),
        spring=Spring(stiffness=stiffness, reference=target) if stiffness > 0.0 else None,
        latch=_file_latch(prim),
        mimic=_file_mimic(prim),
    )


def _file_latch(prim: Usd.Prim) -> Latch | None:
    if not prim.HasAttribute("artgen:latch:force"):
        return None
    return Latch(
        force=prim.GetAttribute("artgen:latch:force").Get(),
        reach=prim.GetAttribute("artgen:latch:reach").Get(),
    )


def _file_mimic(prim: Usd.Prim) -> Mimic | None:
    leader = prim.GetRelationship("artgen:mimic:joint")
    if not leader:
        return None
    return Mimic(
        joint=leader.GetTargets()[0].name,
        multiplier=prim.GetAttribute("artgen:mimic:multiplier").Get(),
        offset=prim.GetAttribute("artgen:mimic:offset").Get(),
    )
