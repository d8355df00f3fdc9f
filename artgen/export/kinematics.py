"""What a written file says about parts and joints, in our frames: common ground of all formats."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import (
    ArticulatedObject,
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
    """Mass properties as read: kg, centre (3,) m, inertia (3, 3) kg m2 about it; object frame."""

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


@dataclass(frozen=True, kw_only=True)
class FileKinematics:
    """Everything one file states about how the object moves.

    Attributes:
        base: the part that no joint moves.
        masses: part name to mass properties; None for parts the format gives no mass.
        joints: in the file's order.
    """

    base: str
    masses: Mapping[str, FileMass | None]
    joints: tuple[FileJoint, ...]


def stated(obj: ArticulatedObject) -> FileKinematics:
    """What every format should say about an object."""
    masses = {
        part.name: FileMass(mass=part.mass.mass, center=part.mass.center, inertia=part.mass.inertia)
        for part in obj.parts
    }
    joints = tuple(as_file_joint(joint) for joint in obj.joints)
    return FileKinematics(base=obj.base.name, masses=masses, joints=joints)


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
