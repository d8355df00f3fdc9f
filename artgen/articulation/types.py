"""The values that cross the house: Draft before finishing, ArticulatedObject after."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from artgen.core.errors import GeometryError, KinematicError
from artgen.core.mesh import Floats, TriMesh, frozen
from artgen.core.surface import SurfaceSpec
from artgen.geometry.solid import Solid

JointType = Literal["revolute", "continuous", "prismatic"]
Vector = tuple[float, float, float]
Axis = Literal["x", "y", "z"]
GripKind = Literal["handle", "knob", "button", "lever", "edge", "rim"]


@dataclass(frozen=True, kw_only=True)
class Decal:
    """One image laid flat on the faces that look along `normal`, seen by someone facing them.

    Attributes:
        origin: the image's lower left corner, m, object frame.
        right: unit vector along the image's rows, object frame.
        up: unit vector along the image's columns, object frame.
        size: (width, height) of the image, m; equals the surface's `tile`.
    """

    origin: Vector
    right: Vector
    up: Vector
    size: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Body:
    """One closed piece of one material, in the object frame at rest.

    Attributes:
        solid: the visible shape.
        surface: name of a surface of the Draft.
        density: kg/m3; an effective value where the real piece is hollow or foamed.
        edge: radius in m by which Blender rounds sharp convex edges; 0 leaves them sharp.
        collision: convex solids that together stand for this piece; empty for trims without
            contact.
        grain: axis along which the material's grain runs; None means the longest side.
        decal: flat image placement instead of meters on the surface.
    """

    solid: Solid
    surface: str
    density: float
    edge: float = 0.0
    collision: tuple[Solid, ...] = ()
    grain: Axis | None = None
    decal: Decal | None = None


@dataclass(frozen=True, kw_only=True)
class Grip:
    """Where a hand or a gripper takes hold of a part; a frame in the object frame at rest.

    Attributes:
        name: unique in the object, e.g. `door_handle`.
        kind: what is gripped: a handle, knob, button, lever, edge or rim.
        position: the middle of what the fingers close around or press, m.
        outward: unit vector from the part towards the approaching hand.
        pull: unit vector along which the hand moves as the part starts to open.
    """

    name: str
    kind: GripKind
    position: Vector
    outward: Vector
    pull: Vector

    def __post_init__(self) -> None:
        for word, vector in (("outward", self.outward), ("pull", self.pull)):
            norm = math.sqrt(sum(a * a for a in vector))
            if abs(norm - 1.0) > 1e-9:
                raise KinematicError(
                    f"grip {self.name}: {word} {vector} has length {norm!r}, expected 1 within "
                    "1e-9; normalize it"
                )


@dataclass(frozen=True, kw_only=True)
class DraftPart:
    """A rigid part before finishing; where bodies overlap, the later one displaces the earlier."""

    name: str
    label: str
    """Its role, a word of `artgen.articulation.roles`: base, lid, door, drawer, rack ..."""
    bodies: tuple[Body, ...]
    grips: tuple[Grip, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Limit:
    """Travel of a joint, rad or m; rest (0) lies inside and positive opens."""

    lower: float
    upper: float

    def __post_init__(self) -> None:
        if not (self.lower <= 0.0 <= self.upper and self.lower < self.upper):
            raise KinematicError(
                f"limit [{self.lower}, {self.upper}] must hold lower <= 0 <= upper and "
                "not be empty; rest is q = 0"
            )


@dataclass(frozen=True, kw_only=True)
class Spring:
    """Linear spring: force = stiffness * (reference - q), N or N m."""

    stiffness: float
    reference: float


@dataclass(frozen=True, kw_only=True)
class Latch:
    """What keeps a closed end closed: a magnet, a ball catch, a detent.

    It pulls towards rest with `force` (N or N m) at q = 0, less in proportion up to `reach` (rad or
    m), and not at all beyond. Its joint goes one way from rest.
    """

    force: float
    reach: float

    def __post_init__(self) -> None:
        if not (self.force > 0.0 and self.reach > 0.0):
            raise KinematicError(
                f"a latch of force {self.force} and reach {self.reach} holds nothing; both > 0"
            )


@dataclass(frozen=True, kw_only=True)
class Mimic:
    """q = multiplier * q[joint] + offset."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Joint:
    """How `child` moves relative to `parent`; axis and origin in the object frame at rest.

    Attributes:
        axis: unit direction; positive q opens.
        origin: a point on the axis, m; canonical form is the axis point nearest to the object
            frame's zero (revolute) or zero itself (prismatic).
        limit: None only for continuous joints.
        friction: constant resisting force, N m or N.
        damping: force per speed, N m s/rad or N s/m.
        effort: largest force a user or motor puts in, N m or N.
        velocity: largest speed, rad/s or m/s.
    """

    name: str
    type: JointType
    parent: str
    child: str
    axis: Vector
    origin: Vector = (0.0, 0.0, 0.0)
    limit: Limit | None
    friction: float
    damping: float
    effort: float
    velocity: float = 2.0
    spring: Spring | None = None
    latch: Latch | None = None
    mimic: Mimic | None = None

    def __post_init__(self) -> None:
        norm = math.sqrt(sum(a * a for a in self.axis))
        if abs(norm - 1.0) > 1e-12:
            raise KinematicError(
                f"joint {self.name}: axis {self.axis} has length {norm!r}, expected 1 "
                "within 1e-12; normalize it"
            )
        if (self.limit is None) != (self.type == "continuous"):
            need = "has no" if self.limit else "needs a"
            raise KinematicError(f"joint {self.name}: a {self.type} joint {need} limit")
        if self.latch is not None and (self.limit is None or self.limit.lower < 0.0):
            raise KinematicError(
                f"joint {self.name}: a latch holds a closed end; state a limit whose lower is 0"
            )
        if min(self.friction, self.damping) < 0.0 or min(self.effort, self.velocity) <= 0.0:
            raise KinematicError(
                f"joint {self.name}: friction {self.friction} and damping {self.damping} must "
                f"be >= 0, effort {self.effort} and velocity {self.velocity} > 0"
            )


@dataclass(frozen=True, kw_only=True)
class Precondition:
    """`joint` may leave rest only while q[requires] >= at_least (rad or m)."""

    joint: str
    requires: str
    at_least: float


@dataclass(frozen=True, kw_only=True)
class Draft:
    """What builders return: solids and joints, base part first, joints stated at rest."""

    category: str
    parts: tuple[DraftPart, ...]
    joints: tuple[Joint, ...]
    surfaces: tuple[SurfaceSpec, ...]
    preconditions: tuple[Precondition, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Mass:
    """Mass properties in the object frame at rest.

    Attributes:
        mass: kg.
        center: (3,) center of mass, m.
        inertia: (3, 3) about the center of mass, kg m2.
    """

    mass: float
    center: Floats
    inertia: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", frozen(self.center, np.float64))
        object.__setattr__(self, "inertia", frozen(self.inertia, np.float64))
        a, b, c = np.linalg.eigvalsh(self.inertia)
        if not (self.mass > 0.0 and a > 0.0 and a + b >= c * (1.0 - 1e-9)):
            raise GeometryError(
                f"mass {self.mass} kg with principal inertia {a:.3e}, {b:.3e}, {c:.3e} kg m2 is "
                "not a rigid body (needs mass > 0 and A + B >= C); check that every body is closed "
                "and outward"
            )


@dataclass(frozen=True, kw_only=True, eq=False)
class Part:
    """A finished rigid part; mesh and collision in the object frame at rest.

    `densities[i]` (kg/m3) belongs to the body that `mesh.body == i`; None where they are not known.
    """

    name: str
    label: str
    mesh: TriMesh
    collision: tuple[TriMesh, ...]
    mass: Mass
    densities: tuple[float, ...] | None = None
    grips: tuple[Grip, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class ArticulatedObject:
    """A finished object: parts in canonical order (base first), joints parents before children.

    `surfaces[i]` is what `mesh.slot == i` refers to, in every part.
    """

    category: str
    asset_id: str
    parts: tuple[Part, ...]
    joints: tuple[Joint, ...]
    surfaces: tuple[SurfaceSpec, ...]
    preconditions: tuple[Precondition, ...] = ()
    provenance: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check_tree([part.name for part in self.parts], self.joints, self.preconditions)

    @property
    def base(self) -> Part:
        """The fixed part."""
        return self.parts[0]

    def joint_of(self, part_name: str) -> Joint | None:
        """The joint that moves a part; None for the base."""
        return next((joint for joint in self.joints if joint.child == part_name), None)


def check_tree(
    names: list[str], joints: tuple[Joint, ...], preconditions: tuple[Precondition, ...]
) -> None:
    """Raise KinematicError unless the joints make one tree rooted at `names[0]`, parents first."""
    if len(set(names)) != len(names):
        raise KinematicError(f"part names repeat: {sorted(names)}; rename one of the twins")
    placed = {names[0]}
    for joint in joints:
        if joint.parent not in placed or joint.child in placed or joint.child not in names:
            raise KinematicError(
                f"joint {joint.name}: {joint.parent} -> {joint.child} does not extend the tree of "
                f"{sorted(placed)}; list parents before children and move each part by one joint"
            )
        placed.add(joint.child)
    if loose := sorted(set(names) - placed):
        raise KinematicError(f"parts {loose} hang on no joint; only {names[0]} may be fixed")
    known = {joint.name for joint in joints}
    if len(known) != len(joints):
        raise KinematicError("joint names repeat; rename one of the twins")
    for rule in preconditions:
        if missing := {rule.joint, rule.requires} - known:
            raise KinematicError(f"a precondition names unknown joints {sorted(missing)}")


State = Mapping[str, float]
"""Joint name to q (rad or m); a joint that is not named is at rest."""
