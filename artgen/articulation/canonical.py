"""Canonical form: base first, then low to high, front to back, left to right; pivots and ground
fixed."""

import dataclasses
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from artgen.articulation.types import Body, Decal, Draft, DraftPart, Joint, Vector
from artgen.core.mesh import Floats

TIE = 0.02
"""Centres closer than this share of the object's diagonal count as level; two doors of one row
differ by rounding only, two rows by far more."""

LEVEL = 1e-12
"""m; an object this near to its place is not moved again, so that doing it twice changes
nothing."""


def canonical_order(bounds: Sequence[Floats]) -> list[int]:
    """Indices in canonical order for (2, 3) rest bounds; index 0 is the base and stays first.

    Centers are grouped from the lowest up: a group ends at the first gap wider than the tie.
    Groups, unlike rounding to a grid, do not flip under noise unless a gap is within the noise of
    the tie."""
    boxes = np.asarray(bounds)
    centers = boxes.mean(axis=1)
    diagonal = np.linalg.norm(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0))
    movers = _ordered(list(range(1, len(boxes))), centers, (2, 1, 0), TIE * float(diagonal))
    return [0, *movers]


def _ordered(indices: list[int], centers: Floats, axes: tuple[int, ...], tie: float) -> list[int]:
    if len(indices) < 2 or not axes:
        return indices
    ranked = sorted(indices, key=lambda i: centers[i, axes[0]])
    groups: list[list[int]] = [[ranked[0]]]
    for before, index in pairwise(ranked):
        if centers[index, axes[0]] - centers[before, axes[0]] > tie:
            groups.append([])
        groups[-1].append(index)
    return [i for group in groups for i in _ordered(sorted(group), centers, axes[1:], tie)]


def canonicalize(draft: Draft) -> Draft:
    """The same object in canonical form: standing on z = 0, centered in x and y, parts and joints
    in order, pivots at the axis point nearest to zero. Idempotent."""
    bounds = [part_bounds(part) for part in draft.parts]
    low, high = np.min([b[0] for b in bounds], axis=0), np.max([b[1] for b in bounds], axis=0)
    middle = (low + high) / 2.0
    shift = np.array([-middle[0], -middle[1], -low[2]])
    shift[np.abs(shift) < LEVEL] = 0.0
    parts = tuple(moved_part(draft.parts[i], shift) for i in canonical_order(bounds))
    joints = [canonical_pivot(moved_joint(joint, shift)) for joint in draft.joints]
    names = [part.name for part in parts]
    return dataclasses.replace(draft, parts=parts, joints=tuple(parents_first(joints, names)))


def part_bounds(part: DraftPart) -> Floats:
    """(2, 3) m."""
    boxes = np.array([body.solid.bounds for body in part.bodies])
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def parents_first(joints: Sequence[Joint], names: Sequence[str]) -> list[Joint]:
    """Joints in the order of their children in `names`, but never before the joint of their
    parent."""
    waiting = sorted(joints, key=lambda joint: names.index(joint.child))
    placed, ordered = {names[0]}, []
    while waiting:
        ready = next((j for j in waiting if j.parent in placed), waiting[0])
        waiting.remove(ready)
        placed.add(ready.child)
        ordered.append(ready)
    return ordered


def canonical_pivot(joint: Joint) -> Joint:
    """The joint with its free choices fixed: the axis point nearest to zero, or zero when it
    slides."""
    if joint.type == "prismatic":
        return dataclasses.replace(joint, origin=(0.0, 0.0, 0.0))
    axis, origin = np.asarray(joint.axis), np.asarray(joint.origin)
    return dataclasses.replace(joint, origin=_vector(origin - (origin @ axis) * axis))


def moved_joint(joint: Joint, shift: Floats) -> Joint:
    """The joint with its origin moved."""
    return dataclasses.replace(joint, origin=_vector(np.add(joint.origin, shift)))


def moved_part(part: DraftPart, shift: Floats) -> DraftPart:
    """The part with every solid, collision piece, decal and grip moved."""
    if not shift.any():
        return part
    return dataclasses.replace(
        part,
        bodies=tuple(_moved_body(b, shift) for b in part.bodies),
        grips=tuple(
            dataclasses.replace(g, position=_vector(np.add(g.position, shift))) for g in part.grips
        ),
    )


def _moved_body(body: Body, shift: Floats) -> Body:
    return dataclasses.replace(
        body,
        solid=body.solid.at(*shift),
        collision=tuple(piece.at(*shift) for piece in body.collision),
        decal=body.decal and _moved_decal(body.decal, shift),
    )


def _moved_decal(decal: Decal, shift: Floats) -> Decal:
    return dataclasses.replace(decal, origin=_vector(np.add(decal.origin, shift)))


def _vector(values: Floats) -> Vector:
    x, y, z = (float(v) + 0.0 for v in values)  # + 0.0 turns -0.0 into 0.0
    return x, y, z
