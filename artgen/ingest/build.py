"""Build: a foreign object as a finished object of ours, with an account of what was done to it."""

import dataclasses
import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from artgen.articulation.canonical import canonical_pivot, parents_first
from artgen.articulation.types import ArticulatedObject, Joint, JointType, Part, Spring
from artgen.core.conventions import GRAVITY
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.ingest.account import Account, provenance
from artgen.ingest.balance import ANGLES, balancing, weight_torque
from artgen.ingest.foreign import ForeignJoint, ForeignObject
from artgen.ingest.options import Options
from artgen.ingest.parts import cleaned, finished_parts, ordered_names
from artgen.ingest.placing import Place, PlacedJoint, carried, placed, placed_joint, swept_poses
from artgen.ingest.reading import ReadMeshes, read_meshes
from artgen.ingest.reduce import bounded_slides, capped, without_still_joints
from artgen.ingest.rest import Rest, found_rests, outline
from artgen.ingest.roles import dynamics, held_roles, role_label
from artgen.ingest.surfaces import surfaces_of
from artgen.textures.images import TextureSet

VELOCITY = 2.0
"""rad/s or m/s; what people move doors and drawers by at most."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Built:
    """A finished object, and the images that its surfaces need a library to keep."""

    obj: ArticulatedObject
    images: tuple[tuple[SurfaceSpec, TextureSet], ...]


def build(foreign: ForeignObject, options: Options, *, asset_id: str, category: str) -> Built:
    """The object with its provenance.

    Raises:
        IngestError: it cannot be used. GeometryError, KinematicError: what it states makes no
            object.
    """
    meshes = read_meshes(foreign)
    foreign = _prepared(without_still_joints(foreign), meshes, options)
    labels = role_labels(foreign)
    outlines = {p.name: outline(meshes.corners(p), p.name) for p in foreign.parts}
    rests = found_rests(foreign.parts[0].name, foreign.joints, labels, outlines)
    points = {part.name: meshes.points(part) for part in foreign.parts}
    place = placed(foreign, rests, points, meters_per_unit=options.meters_per_unit)
    bodies, washed = cleaned(foreign, meshes, place)
    surfaces = surfaces_of([body for own in bodies.values() for body in own])
    names = ordered_names(bodies, labels)
    stated = {part.name: part.mass for part in foreign.parts if part.mass is not None}
    poses = swept_poses([part.name for part in foreign.parts], foreign.joints, rests, place)
    parts = finished_parts(bodies, names, labels, surfaces, options, stated, poses)
    joints = _joints(foreign, rests, place, names, parts, held=held_roles(category))
    sprung = tuple(joint.name for joint in joints if joint.spring is not None)
    account = Account(
        foreign=foreign,
        sprung=sprung,
        dropped=meshes.dropped,
        place=place,
        rests=rests,
        bodies=bodies,
        names=names,
        washed=washed,
        unreadable_images=surfaces.unreadable,
        options=options,
    )
    obj = ArticulatedObject(
        category=category,
        asset_id=asset_id,
        parts=parts,
        joints=joints,
        surfaces=surfaces.specs,
        provenance=provenance(account),
    )
    pairs = zip(surfaces.specs, surfaces.images, strict=True)
    images = tuple((spec, own) for spec, own in pairs if spec.recipe == "picture")
    return Built(obj=obj, images=images)


def role_labels(foreign: ForeignObject) -> dict[str, str]:
    """Part name to its role; the base's is `base`."""
    types = {joint.child: joint.type for joint in foreign.joints}
    return {part.name: role_label(part.word, types.get(part.name)) for part in foreign.parts}


def _prepared(foreign: ForeignObject, meshes: ReadMeshes, options: Options) -> ForeignObject:
    """Few enough parts, slides with stops, and the user's rests."""
    spans = {part.name: np.ptp(meshes.points(part), axis=0) for part in foreign.parts}
    sizes = {name: float(np.linalg.norm(span)) for name, span in spans.items()}
    foreign = capped(foreign, sizes, most=options.max_parts)
    reach = {j.child: float(np.abs(j.axis) @ spans[j.child]) for j in foreign.joints}
    joints, doubts = bounded_slides(foreign.joints, reach)
    given = {rest.number: rest.q for rest in options.rests if rest.id == foreign.id}
    chosen = tuple(_with_rest(joint, given.get(joint.number)) for joint in joints)
    beyond = tuple(
        f"joint {joint.name}: the closed pose given, {given[joint.number]}, lies beyond its range"
        for joint in chosen
        if joint.rest is not None and not np.isclose(_q(joint, given[joint.number]), joint.rest)
    )
    return dataclasses.replace(foreign, joints=chosen, doubts=(*foreign.doubts, *doubts, *beyond))


def _with_rest(joint: ForeignJoint, given: float | None) -> ForeignJoint:
    """The joint with the user's closed pose (degrees or units), inside its limits."""
    if given is None or joint.lower is None or joint.upper is None:
        return joint
    return dataclasses.replace(joint, rest=min(max(_q(joint, given), joint.lower), joint.upper))


def _q(joint: ForeignJoint, given: float) -> float:
    """rad or units of what the user states in degrees or units."""
    return math.radians(given) if joint.type == "revolute" else given


def _joints(
    foreign: ForeignObject,
    rests: Mapping[str, Rest],
    place: Place,
    names: Mapping[str, str],
    parts: tuple[Part, ...],
    *,
    held: Collection[str],
) -> tuple[Joint, ...]:
    """Joints in the object frame, parents first; friction and effort by role and load."""
    by_name = {part.name: part for part in parts}
    moved = carried([part.name for part in foreign.parts], foreign.joints)
    joints = []
    for joint in foreign.joints:
        at = placed_joint(joint, rests[joint.name], place)
        child = by_name[names[joint.child]]
        carries = [by_name[names[name]] for name in moved[joint.child]]
        load = _load(joint, at.axis, at.origin, carries)
        rated = partial(
            dynamics, child.label, joint.type, inertia=_inertia(joint.type, at, carries)
        )
        stays = child.label in held
        forces = rated(load=load, held=stays)
        spring = None
        if stays and load > forces.friction and (found := _balance(at, carries)) is not None:
            spring, left = found
            friction = rated(load=left, held=True).friction
            forces = dataclasses.replace(forces, friction=friction)
        joints.append(
            canonical_pivot(
                Joint(
                    name=f"{child.name}_joint",
                    type=joint.type,
                    parent=names[joint.parent],
                    child=child.name,
                    axis=at.axis,
                    origin=at.origin,
                    limit=at.limit,
                    friction=forces.friction,
                    damping=forces.damping,
                    effort=forces.effort,
                    velocity=VELOCITY,
                    spring=spring,
                )
            )
        )
    return tuple(parents_first(joints, [part.name for part in parts]))


def _load(
    joint: ForeignJoint,
    axis: tuple[float, float, float],
    origin: tuple[float, float, float],
    carries: Sequence[Part],
) -> float:
    """Most that weight can ask of a joint: N along a slide, N m about a hinge."""
    mass, center = _weight(carries)
    along = np.array(axis)
    if joint.type == "prismatic":
        return float(mass * GRAVITY * abs(along[2]))
    arm = np.cross(along, center - np.array(origin))
    level = float(np.hypot(along[0], along[1]))
    return float(mass * GRAVITY * np.linalg.norm(arm) * level)


def _balance(at: PlacedJoint, carries: Sequence[Part]) -> tuple[Spring, float] | None:
    """The spring that carries what hangs on a hinge, and the torque that is left, N m."""
    if at.limit is None:
        return None
    mass, center = _weight(carries)
    angles = np.linspace(at.limit.lower, at.limit.upper, ANGLES)
    return balancing(weight_torque(at.axis, center - np.array(at.origin), mass, angles), angles)


def _inertia(joint: JointType, at: PlacedJoint, carries: Sequence[Part]) -> float:
    """kg that slide, or kg m2 that turn about the axis."""
    if joint == "prismatic":
        return sum(part.mass.mass for part in carries)
    axis, origin = np.array(at.axis), np.array(at.origin)
    arms = [np.cross(axis, part.mass.center - origin) for part in carries]
    return float(sum(
        axis @ part.mass.inertia @ axis + part.mass.mass * arm @ arm
        for part, arm in zip(carries, arms, strict=True)
    ))  # fmt: skip


def _weight(parts: Sequence[Part]) -> tuple[float, Floats]:
    """Mass (kg) and center (3,) at rest."""
    mass = sum(part.mass.mass for part in parts)
    return mass, np.asarray(sum(part.mass.mass * part.mass.center for part in parts) / mass)
