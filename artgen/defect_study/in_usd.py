"""Defects of a USD file."""

from collections.abc import Callable
from pathlib import Path

from pxr import Gf, Usd, UsdGeom, UsdPhysics

from artgen.defect_study.defect import Defect, Plant
from artgen.export.layout import USD


def in_stage(change: Callable[[Usd.Stage], None]) -> Plant:
    """A plant that edits the stage."""

    def plant(folder: Path) -> None:
        stage = Usd.Stage.Open(str(folder / USD))
        change(stage)
        stage.GetRootLayer().Save()
        del stage

    return plant


def joint(stage: Usd.Stage) -> Usd.Prim:
    """The first joint that moves between limits."""
    for prim in stage.Traverse():
        moves = prim.IsA(UsdPhysics.RevoluteJoint) or prim.IsA(UsdPhysics.PrismaticJoint)
        if moves and prim.GetAttribute("physics:upperLimit").HasAuthoredValue():
            return prim
    raise LookupError("no moving joint")


def moving(stage: Usd.Stage) -> Usd.Prim:
    """The part that the first joint moves."""
    targets = UsdPhysics.Joint(joint(stage)).GetBody1Rel().GetTargets()
    return stage.GetPrimAtPath(targets[0])


def on_joint(name: str, value: object) -> Plant:
    """Set an attribute of the first moving joint."""
    return in_stage(lambda stage: _set(joint(stage), name, value))


def on_part(name: str, value: object) -> Plant:
    """Set an attribute of the part it moves."""
    return in_stage(lambda stage: _set(moving(stage), name, value))


def _set(prim: Usd.Prim, name: str, value: object) -> None:
    prim.GetAttribute(name).Set(value)


def limits_swapped(stage: Usd.Stage) -> None:
    """Lower above upper."""
    prim = joint(stage)
    lower, upper = (prim.GetAttribute(f"physics:{end}Limit") for end in ("lower", "upper"))
    low, high = lower.Get(), upper.Get()
    lower.Set(high)
    upper.Set(low)


def without_body(stage: Usd.Stage) -> None:
    """The joint moves nothing."""
    UsdPhysics.Joint(joint(stage)).GetBody1Rel().ClearTargets(True)


def unknown_body(stage: Usd.Stage) -> None:
    """The joint moves a prim that is not there."""
    UsdPhysics.Joint(joint(stage)).GetBody1Rel().SetTargets(["/nix"])


def not_rigid(stage: Usd.Stage) -> None:
    """The part is no rigid body."""
    moving(stage).RemoveAPI(UsdPhysics.RigidBodyAPI)


def no_collision(stage: Usd.Stage) -> None:
    """The part cannot be touched."""
    for prim in Usd.PrimRange(moving(stage)):
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            prim.RemoveAPI(UsdPhysics.CollisionAPI)


def pivot_moved(stage: Usd.Stage) -> None:
    """The pivot on the parent's side lies 80 mm off the one on the child's."""
    attribute = joint(stage).GetAttribute("physics:localPos0")
    attribute.Set(attribute.Get() + Gf.Vec3f(0.08, 0.08, 0.0))


def points_cut(stage: Usd.Stage) -> None:
    """Faces name points that are not there."""
    for prim in Usd.PrimRange(moving(stage)):
        if prim.IsA(UsdGeom.Mesh):
            points = UsdGeom.Mesh(prim).GetPointsAttr()
            points.Set(list(points.Get())[: len(points.Get()) // 2])
            return
    raise LookupError("no mesh")


USD_DEFECTS = tuple(
    Defect(name=f"usd_{name}", format="usd", what=what, plant=plant)
    for name, what, plant in (
        ("limits_swapped", "lower above upper", in_stage(limits_swapped)),
        ("axis_unknown", "an axis that does not exist", on_joint("physics:axis", "W")),
        ("body_missing", "a joint that moves nothing", in_stage(without_body)),
        ("body_unknown", "a joint that moves a prim that is not there", in_stage(unknown_body)),
        ("not_rigid", "a part that is no rigid body", in_stage(not_rigid)),
        ("no_collision", "a part that cannot be touched", in_stage(no_collision)),
        ("pivot_moved", "a pivot torn in two", in_stage(pivot_moved)),
        ("mass_negative", "negative mass", on_part("physics:mass", -1.0)),
        ("mass_zero", "no mass", on_part("physics:mass", 0.0)),
        (
            "inertia_negative",
            "negative inertia",
            on_part("physics:diagonalInertia", Gf.Vec3f(-1, -1, -1)),
        ),
        (
            "triangle",
            "no body has this inertia",
            on_part("physics:diagonalInertia", Gf.Vec3f(1, 1, 3)),
        ),
        ("units", "centimeters", in_stage(lambda s: UsdGeom.SetStageMetersPerUnit(s, 0.01))),
        ("up_axis", "y is up", in_stage(lambda s: UsdGeom.SetStageUpAxis(s, "Y"))),
        ("points_cut", "faces of points that are not there", in_stage(points_cut)),
    )
)
