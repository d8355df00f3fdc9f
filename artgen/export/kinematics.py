"""What a written file says about parts and joints, in our frames: common ground of all formats."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.grips import grip_frame
from artgen.articulation.types import (
    ArticulatedObject,
    Grip,
    Joint,
    JointType,
    Latch,
    Mimic,
    Spring,
    Vector,
)
from artgen.core.mesh import Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class FileMass:
    """Mass properties as read: kg, center (3,) m, inertia (3, 3) kg m2 about it; object frame."""

    mass: float
    center: Floats
    inertia: Floats


@dataclass(frozen=True, kw_only=True)
class FileJoint:
    """A joint as read, in the object frame at rest; None where the format cannot say.

    `lower` and `upper` are None for a continuous joint.
    """

    name: str
    type: JointType
    parent: str
    child: str
    axis: Vector
    origin: Vector
    lower: float | None
    upper: float | None
    friction: float | None
    damping: float | None
    effort: float | None
    velocity: float | None
    spring: Spring | None
    latch: Latch | None
    mimic: Mimic | None


@dataclass(frozen=True, kw_only=True, eq=False)
class FileGrip:
    """A grip as read: its frame (4, 4) in the object frame at rest, as `grip_frame` makes it, and
    its own words and directions where the format has them."""

    name: str
    part: str
    frame: Floats
    kind: str | None = None
    outward: Vector | None = None
    pull: Vector | None = None


@dataclass(frozen=True, kw_only=True)
class FileKinematics:
    """Everything one file states about how the object moves.

    Attributes:
        base: the part that no joint moves.
        masses: part name to mass properties; None for parts the format gives no mass.
        joints: in the file's order.
        grips: in the file's order.
    """

    base: str
    masses: Mapping[str, FileMass | None]
    joints: tuple[FileJoint, ...]
    grips: tuple[FileGrip, ...]


def stated(obj: ArticulatedObject) -> FileKinematics:
    """What every format should say about an object."""
    masses = {
        part.name: FileMass(mass=part.mass.mass, center=part.mass.center, inertia=part.mass.inertia)
        for part in obj.parts
    }
    joints = tuple(as_file_joint(joint) for joint in obj.joints)
    grips = tuple(as_file_grip(part.name, grip) for part in obj.parts for grip in part.grips)
    return FileKinematics(base=obj.base.name, masses=masses, joints=joints, grips=grips)


def as_file_grip(part: str, grip: Grip) -> FileGrip:
    """A grip in the form that readers return."""
    return FileGrip(
        name=grip.name,
        part=part,
        frame=grip_frame(grip),
        kind=grip.kind,
        outward=grip.outward,
        pull=grip.pull,
    )


def as_file_joint(joint: Joint) -> FileJoint:
    """A joint in the form that readers return."""
    return FileJoint(
        name=joint.name,
        type=joint.type,
        parent=joint.parent,
        child=joint.child,
        axis=joint.axis,
        origin=joint.origin,
        lower=joint.limit.lower if joint.limit else None,
        upper=joint.limit.upper if joint.limit else None,
        friction=joint.friction,
        damping=joint.damping,
        effort=joint.effort,
        velocity=joint.velocity,
        spring=joint.spring,
        latch=joint.latch,
        mimic=joint.mimic,
    )


def vector(values: Floats) -> Vector:
    """Three numbers as a tuple."""
    x, y, z = (float(v) for v in np.ravel(values))
    return x, y, z
