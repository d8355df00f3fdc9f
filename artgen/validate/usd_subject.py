"""A USD under test: rigid bodies and joints of UsdPhysics, judged by a model that we build."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import mujoco
import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdPhysics

from artgen.articulation.types import Latch, Spring
from artgen.core.errors import ArtgenError, ExportError, GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply, inverted, rigid
from artgen.validate.assembly import Assembly, FileJoint, Geometry, LinkMass, assembled
from artgen.validate.built_model import built_spec
from artgen.validate.foreign_subject import ForeignSubject
from artgen.validate.meshfile import as_bodies
from artgen.validate.places import inside
from artgen.validate.stated import StatedBody, StatedJoint

MAX_PRIMS = 200_000
Z_UP_FROM_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
UNKNOWN = (np.nan, np.nan, np.nan)
APART = 1e-4
"""m; float32 places of two bodies a few meters away agree to 1e-6."""
AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True, kw_only=True, eq=False)
class UsdSubject(ForeignSubject):
    """A stage of anyone's, in meters with z up, whatever it states."""

    def files(self) -> Iterable[Path]:
        """The file and the layers that it composes."""
        with suppress(ArtgenError, OSError, Tf.ErrorException):
            yield from self._layers()
            return
        yield self.source.file

    def _layers(self) -> list[Path]:
        """The file and every layer that it names; ExportError where one leads outside."""
        found, waiting = [], [self.source.file.resolve()]
        while waiting:
            path = waiting.pop()
            if path in found:
                continue
            found.append(path)
            if path.suffix.lower() == ".usdz":
                continue  # A package names what it holds itself.
            layer = Sdf.Layer.OpenAsAnonymous(str(path))
            for name in layer.GetCompositionAssetDependencies():
                waiting.append(inside(self.source.root, path.parent, name))
        return found

    def problems(self) -> Iterator[tuple[str, str]]:
        """The file itself, and the layers that it names."""
        file = self.source.file.name
        try:
            self._layers()
            if not any(prim.HasAPI(UsdPhysics.RigidBodyAPI) for prim in self.prims):
                yield file, "no prim has a PhysicsRigidBodyAPI; there is nothing to move"
            for joint in (UsdPhysics.Joint(prim) for prim in self.prims):
                if joint and self._loose(joint):
                    yield file, f"joint {joint.GetPrim().GetName()} holds what is no rigid body"
        except ArtgenError as error:
            yield file, str(error)
        except (Tf.ErrorException, OSError) as error:
            yield file, " ".join(f"cannot be read: {error}".split())

    @cached_property
    def stage(self) -> Usd.Stage:
        """The composed stage; Tf.ErrorException where it is none."""
        return Usd.Stage.Open(str(self.source.file))

    @cached_property
    def prims(self) -> list[Usd.Prim]:
        """Every prim, instances looked into; ExportError where there are too many."""
        prims: list[Usd.Prim] = []
        for prim in Usd.PrimRange.Stage(self.stage, Usd.TraverseInstanceProxies()):
            prims.append(prim)
            if len(prims) > MAX_PRIMS:
                raise ExportError(f"{self.source.file.name}: more than {MAX_PRIMS} prims")
        return prims

    @cached_property
    def bodies(self) -> Mapping[str, Usd.Prim]:
        """Name to rigid body; the path where names repeat."""
        own = [prim for prim in self.prims if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
        names = [prim.GetName() for prim in own]
        return {
            prim.GetName() if names.count(prim.GetName()) == 1 else str(prim.GetPath()): prim
            for prim in own
        }

    @cached_property
    def unit(self) -> float:
        """Meters a unit of the stage."""
        return float(UsdGeom.GetStageMetersPerUnit(self.stage))

    @cached_property
    def cache(self) -> UsdGeom.XformCache:
        """Poses of prims."""
        return UsdGeom.XformCache()

    def _affine(self, prim: Usd.Prim) -> Floats:
        """(4, 4) object_from_prim with its scale, m."""
        matrix = np.array(self.cache.GetLocalToWorldTransform(prim)).T
        matrix[:3, 3] *= self.unit
        if UsdGeom.GetStageUpAxis(self.stage) == UsdGeom.Tokens.y:
            matrix[:3] = Z_UP_FROM_Y_UP @ matrix[:3]
        return matrix

    def _pose(self, prim: Usd.Prim) -> tuple[Floats, Floats]:
        """Rigid (4, 4) object_from_prim, and its (3,) scale."""
        matrix = self._affine(prim)
        scale = np.linalg.norm(matrix[:3, :3], axis=0)
        return rigid(matrix[:3, :3] / scale, matrix[:3, 3]), scale

    def _link_of(self, prim: Usd.Prim) -> str | None:
        """The rigid body at or above a prim."""
        paths = {body.GetPath(): name for name, body in self.bodies.items()}
        while prim and not prim.IsPseudoRoot():
            if prim.GetPath() in paths:
                return paths[prim.GetPath()]
            prim = prim.GetParent()
        return None

    @cached_property
    def stated_links(self) -> Mapping[str, list[str]]:
        """Names of the rigid bodies."""
        return {self.source.file.name: list(self.bodies)}

    @cached_property
    def rows(self) -> list[FileJoint]:
        """Joints between two rigid bodies; one with the world holds the base and is passed over."""
        rows = []
        for prim in self.prims:
            joint = UsdPhysics.Joint(prim)
            if not joint or joint.GetExcludeFromArticulationAttr().Get():
                continue
            ends = [self._end(joint.GetBody0Rel()), self._end(joint.GetBody1Rel())]
            if None not in ends:
                rows.append(self._row(joint, str(ends[0]), str(ends[1])))
        return rows

    def _loose(self, joint: UsdPhysics.Joint) -> bool:
        """Whether an end of a joint is a prim that is no rigid body and holds none."""
        for relation in (joint.GetBody0Rel(), joint.GetBody1Rel()):
            for path in relation.GetTargets():
                bodies = (body.GetPath() for body in self.bodies.values())
                prim = self.stage.GetPrimAtPath(path)
                known = prim and self._link_of(prim) is not None
                if not known and not any(body.HasPrefix(path) for body in bodies):
                    return True
        return False

    def _end(self, relation: Usd.Relationship) -> str | None:
        targets = relation.GetTargets()
        prim = self.stage.GetPrimAtPath(targets[0]) if targets else None
        return self._link_of(prim) if prim else None

    def _row(self, joint: UsdPhysics.Joint, parent: str, child: str) -> FileJoint:
        """A joint in the frame of its child; limits of hinges are degrees."""
        prim, kind, axis = joint.GetPrim(), "floating", (1.0, 0.0, 0.0)
        lower, upper, unit = -np.inf, np.inf, self.unit
        if prim.IsA(UsdPhysics.FixedJoint):
            kind = "fixed"
        for schema, name in (
            (UsdPhysics.RevoluteJoint, "revolute"),
            (UsdPhysics.PrismaticJoint, "prismatic"),
        ):
            if prim.IsA(schema):
                kind, own = name, schema(prim)
                axis = AXES.get(own.GetAxisAttr().Get() or "X", UNKNOWN)
                unit = np.pi / 180.0 if name == "revolute" else unit
                lower, upper = own.GetLowerLimitAttr().Get(), own.GetUpperLimitAttr().Get()
        if kind == "revolute" and np.isinf([lower, upper]).all():
            kind, lower, upper = "continuous", np.nan, np.nan
        pose, scale = self._pose(self.bodies[child])
        turn = turn_of(joint.GetLocalRot1Attr().Get())
        place = (
            np.array(joint.GetLocalPos1Attr().Get() or (0.0, 0.0, 0.0), float) * scale * self.unit
        )
        above, above_scale = self._pose(self.bodies[parent])
        held = np.array(joint.GetLocalPos0Attr().Get() or (0.0, 0.0, 0.0), float)
        gap = apply(pose, place) - apply(above, held * above_scale * self.unit)
        drive = _drive(prim)
        pivot = UNKNOWN if np.linalg.norm(gap) > APART else tuple(place.tolist())
        stated = StatedJoint(
            file=self.source.file.name, name=prim.GetName(), type=kind, parent=parent, child=child,
            axis=tuple((turn @ axis).tolist()), origin=pivot,
            lower=float(lower) * unit, upper=float(upper) * unit,
            friction=_first(prim, FRICTION), damping=drive.damping,
            effort=drive.effort or _first(prim, EFFORT), velocity=_first(prim, VELOCITY),
        )  # fmt: skip
        return FileJoint(
            stated=stated,
            parent_from_joint=inverted(above) @ pose,
            anchor=apply(pose, place),
            spring=drive.spring,
            latch=_latch(prim),
        )

    @property
    def stated_joints(self) -> list[StatedJoint]:
        """Joints between rigid bodies."""
        return [row.stated for row in self.rows]

    @cached_property
    def masses(self) -> Mapping[str, LinkMass]:
        """Bodies whose MassAPI states a mass and a diagonal of inertia."""
        found = {}
        for name, prim in self.bodies.items():
            api = UsdPhysics.MassAPI(prim)
            mass, diagonal = api.GetMassAttr().Get(), api.GetDiagonalInertiaAttr().Get()
            if not mass or diagonal is None or not any(diagonal):
                continue  # 0 means "to be computed" in UsdPhysics.
            _, scale = self._pose(prim)
            turn = turn_of(api.GetPrincipalAxesAttr().Get())
            center = np.array(api.GetCenterOfMassAttr().Get(), float)
            unit = float(UsdPhysics.GetStageKilogramsPerUnit(self.stage))
            tensor = turn @ np.diag(np.array(diagonal, float)) @ turn.T
            found[name] = LinkMass(
                mass=float(mass) * unit,
                center=np.where(np.isfinite(center), center, 0.0) * scale * self.unit,
                tensor=tensor * unit * self.unit**2,
            )
        return found

    @property
    def stated_bodies(self) -> list[StatedBody]:
        """Mass properties that the bodies state."""
        file = self.source.file.name
        return [
            StatedBody(file=file, name=name, mass=m.mass, center=m.center, inertia=m.tensor)
            for name, m in self.masses.items()
        ]

    @cached_property
    def assembly(self) -> Assembly:
        """Parts and joints; the object frame is the pose of the base."""
        return assembled(list(self.bodies), self.masses, self.rows, base=self._base_pose())

    def _base_pose(self) -> Floats:
        children = {row.stated.child for row in self.rows}
        root = next((name for name in self.bodies if name not in children), None)
        return np.eye(4) if root is None else self._pose(self.bodies[root])[0]

    @cached_property
    def visuals(self) -> Sequence[Geometry]:
        """Meshes that are drawn."""
        return list(self._shapes(drawn=True))

    @cached_property
    def contact_shapes(self) -> Sequence[Geometry]:
        """Meshes and solids with a collision API."""
        return list(self._shapes(drawn=False))

    def _shapes(self, *, drawn: bool) -> Iterator[Geometry]:
        for prim in self.prims:
            if not prim.IsA(UsdGeom.Gprim) or (link := self._link_of(prim)) is None:
                continue
            collides = prim.HasAPI(UsdPhysics.CollisionAPI)
            purpose = UsdGeom.Imageable(prim).ComputePurpose()
            shown = purpose in (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)
            shown = shown and UsdGeom.Imageable(prim).ComputeVisibility() != "invisible"
            if shown if drawn else collides:
                pose, _ = self._pose(self.bodies[link])
                yield Geometry(
                    link=link,
                    label=f"{link}, {prim.GetName()}",
                    link_from_shape=np.eye(4),
                    read=partial(self._mesh, prim, inverted(pose)),
                )

    def _mesh(self, prim: Usd.Prim, link_from_object: Floats) -> TriMesh:
        """Triangles of a prim in its link's frame; GeometryError for what has none here."""
        affine = self._affine(prim)
        affine[:3, :3] *= self.unit
        points, faces = _surface(prim)
        placed = apply(affine, points)
        if np.linalg.det(affine[:3, :3]) < 0.0:
            faces = faces[:, ::-1]
        return as_bodies(apply(link_from_object, placed), faces)

    def spec(self, file: str) -> mujoco.MjSpec:
        """A model of our own making from what the stage states."""
        return built_spec(self.name, self.assembly, self.contact_meshes)


FRICTION = ("mjc:frictionloss", "newton:friction", "physxJoint:jointFriction")
EFFORT = ("artgen:effort",)
VELOCITY = ("artgen:velocity",)
"""Attributes that various writers use for what UsdPhysics has no word for."""


def _first(prim: Usd.Prim, names: Sequence[str]) -> float | None:
    """The first of some attributes that holds a number."""
    values = (prim.GetAttribute(name).Get() for name in names if prim.HasAttribute(name))
    return next((float(v) for v in values if isinstance(v, int | float)), None)


def _latch(prim: Usd.Prim) -> Latch | None:
    """What we state of a catch, if its numbers make one."""
    force, reach = (_first(prim, (f"artgen:latch:{word}",)) for word in ("force", "reach"))
    if force is None or reach is None or not min(force, reach) > 0.0:
        return None
    return Latch(force=force, reach=reach)


@dataclass(frozen=True, kw_only=True)
class Drive:
    """What a joint's drive does, per radian or meter; None where it does not say."""

    damping: float | None = None
    spring: Spring | None = None
    effort: float | None = None


def _drive(prim: Usd.Prim) -> Drive:
    """The drive of a joint; UsdPhysics counts angles in degrees here too."""
    for name, unit in (("angular", 180.0 / np.pi), ("linear", 1.0)):
        if not prim.HasAPI(UsdPhysics.DriveAPI, name):
            continue
        drive = UsdPhysics.DriveAPI(prim, name)
        damping, stiffness = drive.GetDampingAttr().Get(), drive.GetStiffnessAttr().Get()
        target, force = drive.GetTargetPositionAttr().Get(), drive.GetMaxForceAttr().Get()
        spring = Spring(stiffness=(stiffness or 0.0) * unit, reference=(target or 0.0) / unit)
        return Drive(
            damping=None if damping is None else float(damping) * unit,
            spring=spring if spring.stiffness > 0.0 else None,
            effort=float(force) if force is not None and np.isfinite(force) else None,
        )
    return Drive()


def turn_of(quaternion: Gf.Quatf | None) -> Floats:
    """(3, 3) of a quaternion; the identity where there is none or all its numbers are 0."""
    if quaternion is None or not quaternion.GetLength():
        return np.eye(3)
    # Normalized in float64: USD keeps 24 bits.
    return np.array(Gf.Matrix3d(Gf.Quatd(quaternion).GetNormalized())).T


def _surface(prim: Usd.Prim) -> tuple[Floats, np.ndarray]:  # type: ignore[type-arg]
    """(V, 3) points in the prim's frame and (F, 3) triangles; polygons become fans."""
    if prim.IsA(UsdGeom.Cube):
        half = float(UsdGeom.Cube(prim).GetSizeAttr().Get()) / 2.0
        signs = np.array(np.meshgrid(*[(-half, half)] * 3, indexing="ij")).reshape(3, -1).T
        return signs, CUBE
    if not prim.IsA(UsdGeom.Mesh):
        raise GeometryError(f"a {prim.GetTypeName()} has no surface here; write a mesh")
    mesh = UsdGeom.Mesh(prim)
    points = np.array(mesh.GetPointsAttr().Get() or [], np.float64).reshape(-1, 3)
    counts = np.array(mesh.GetFaceVertexCountsAttr().Get() or [], np.int64)
    corners = np.array(mesh.GetFaceVertexIndicesAttr().Get() or [], np.int64)
    if counts.sum() != len(corners) or (counts < 3).any() or not len(counts):
        raise GeometryError(f"{prim.GetPath()}: face counts and indices do not agree")
    starts = np.repeat(np.cumsum(counts) - counts, counts - 2)
    within = np.arange(len(starts)) - np.repeat(np.cumsum(counts - 2) - (counts - 2), counts - 2)
    faces = corners[np.stack([starts, starts + within + 1, starts + within + 2], axis=1)]
    flipped = mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded
    return points, faces[:, ::-1] if flipped else faces


CUBE = np.array([
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
    [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
])  # fmt: skip
"""Twelve outward triangles on corners numbered 4 x + 2 y + z."""
