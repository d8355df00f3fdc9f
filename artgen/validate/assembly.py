"""Links and joints of a stranger's file, brought to the object frame: parts that move."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Joint, Latch, Limit, Mass, Mimic, Spring
from artgen.core.errors import KinematicError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from artgen.export.kinematics import vector
from artgen.geometry.measure import inertia
from artgen.validate.stated import StatedJoint
from artgen.validate.subject import Link, SubjectPart


@dataclass(frozen=True, kw_only=True, eq=False)
class Geometry:
    """A visual or collision shape of a link.

    Attributes:
        label: link, kind and number, for findings.
        link_from_shape: (4, 4).
        read: the triangles in the shape's frame; raises ArtgenError or OSError.
    """

    link: str
    label: str
    link_from_shape: Floats
    read: Callable[[], TriMesh]


@dataclass(frozen=True, kw_only=True, eq=False)
class LinkMass:
    """Mass properties of a link: kg, (3,) m in the link's frame, (3, 3) kg m2 along its axes."""

    mass: float
    center: Floats
    tensor: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class FileJoint:
    """A joint as a file states it: `parent_from_joint` (4, 4) at rest, the axis in the joint's
    frame, which is the child's; `anchor` (3,) is a point on the axis in the object frame, the
    frame's origin if None."""

    stated: StatedJoint
    parent_from_joint: Floats
    anchor: Floats | None = None
    spring: Spring | None = None
    latch: Latch | None = None
    mimic: Mimic | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Assembly:
    """Everything a file says, in the object frame at rest; the first part is the base."""

    parts: tuple[SubjectPart, ...]
    joints: tuple[Joint, ...]
    links: Mapping[str, Link]


def assembled(
    links: Sequence[str],
    masses: Mapping[str, LinkMass],
    joints: Sequence[FileJoint],
    base: Floats | None = None,
) -> Assembly:
    """Parts and joints; links that fixed joints connect become one part, named by the one nearest
    to the base. `base` is the pose (4, 4) of the first link in the object frame, none if None.

    Raises:
        KinematicError: the joints make no tree, or a joint's numbers make no joint.
    """
    order = _parents_first(links, joints)
    children = {joint.stated.child for joint in order}
    root = next(name for name in links if name not in children)
    placed = {root: Link(part=root, object_from_link=np.eye(4) if base is None else base)}
    moving = []
    for joint in order:
        stated, parent = joint.stated, placed[joint.stated.parent]
        pose = parent.object_from_link @ joint.parent_from_joint
        part = stated.child if stated.moves else parent.part
        placed[stated.child] = Link(part=part, object_from_link=pose)
        if stated.moves:
            moving.append(_joint(joint, parent.part, pose))
    _check_mimics(moving)
    names = [root, *(joint.child for joint in moving)]
    parts = tuple(
        SubjectPart(name=name, label=name, mass=_mass(name, placed, masses)) for name in names
    )
    return Assembly(parts=parts, joints=tuple(moving), links=placed)


def _check_mimics(joints: Sequence[Joint]) -> None:
    """Raise KinematicError for a joint that follows none, itself, or one that follows another."""
    by_name = {joint.name: joint for joint in joints}
    for joint in joints:
        if joint.mimic is None:
            continue
        leader = by_name.get(joint.mimic.joint)
        if leader is None or leader.mimic is not None:
            raise KinematicError(
                f"joint {joint.name} follows {joint.mimic.joint!r}, which is no joint that "
                "moves by itself"
            )
        if not np.isfinite([joint.mimic.multiplier, joint.mimic.offset]).all():
            raise KinematicError(f"joint {joint.name}: its mimic's numbers are not finite")


def _parents_first(links: Sequence[str], joints: Sequence[FileJoint]) -> list[FileJoint]:
    """Joints ordered from the root outward; raises KinematicError where they make no tree."""
    below: dict[str, list[FileJoint]] = {}
    for joint in joints:
        below.setdefault(joint.stated.parent, []).append(joint)
    children = {joint.stated.child for joint in joints}
    waiting = [name for name in links if name not in children]
    order: list[FileJoint] = []
    if len(waiting) != 1:
        raise KinematicError(f"{len(waiting)} links hang on no joint; exactly one is the base")
    while waiting:
        own = below.pop(waiting.pop(0), [])
        order += own
        waiting += [joint.stated.child for joint in own]
    if len(order) != len(joints) or len(order) != len(links) - 1:
        raise KinematicError(f"{len(joints)} joints do not make a tree of {len(links)} links")
    return order


def _joint(joint: FileJoint, parent: str, pose: Floats) -> Joint:
    """A moving joint in the object frame at rest."""
    stated = joint.stated
    axis = pose[:3, :3] @ np.array(stated.axis)
    limited = stated.lower == stated.lower and stated.limited
    return Joint(
        name=stated.name,
        type=stated.type,  # type: ignore[arg-type]  # Joint refuses what is not one.
        parent=parent,
        child=stated.child,
        axis=vector(axis / np.linalg.norm(axis)),
        origin=vector(pose[:3, 3] if joint.anchor is None else joint.anchor),
        limit=Limit(lower=stated.lower, upper=stated.upper) if limited else None,
        friction=stated.friction or 0.0,
        damping=stated.damping or 0.0,
        effort=np.inf if stated.effort is None else stated.effort,
        velocity=np.inf if stated.velocity is None else stated.velocity,
        spring=joint.spring,
        latch=joint.latch,
        mimic=joint.mimic,
    )


def _mass(part: str, placed: Mapping[str, Link], masses: Mapping[str, LinkMass]) -> Mass | None:
    """Mass of all links of a part together, about their common center, in the object frame."""
    own = [
        (link.object_from_link, masses[name])
        for name, link in placed.items()
        if link.part == part and name in masses
    ]
    if not own:
        return None
    mass = sum(link.mass for _, link in own)
    centers = np.array([apply(pose, link.center) for pose, link in own])
    center = np.array([link.mass for _, link in own]) @ centers / mass
    tensor = np.zeros((3, 3))
    for (pose, link), at in zip(own, centers, strict=True):
        turn, arm = pose[:3, :3], at - center
        tensor += turn @ link.tensor @ turn.T + inertia(link.mass * np.outer(arm, arm))
    return Mass(mass=mass, center=center, inertia=(tensor + tensor.T) / 2.0)


def merged(meshes: Sequence[TriMesh]) -> TriMesh:
    """One mesh of several; bodies keep their order and are numbered on."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    counts = np.cumsum([0, *(int(np.asarray(mesh.body).max()) + 1 for mesh in meshes)])
    return TriMesh(
        vertices=np.concatenate([mesh.vertices for mesh in meshes]),
        faces=np.concatenate([m.faces + s for m, s in zip(meshes, starts, strict=False)]),
        body=np.concatenate([np.asarray(m.body) + c for m, c in zip(meshes, counts, strict=False)]),
    )


def moved(mesh: TriMesh, pose: Floats) -> TriMesh:
    """A mesh under a rigid (4, 4) pose."""
    return TriMesh(vertices=apply(pose, mesh.vertices), faces=mesh.faces, body=mesh.body)
