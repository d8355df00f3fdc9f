"""Sources: finished objects taken apart into what templates keep and what donors give."""

import dataclasses
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import manifold3d as m3
import numpy as np

from artgen.articulation.canonical import parents_first
from artgen.articulation.roles import ROLES
from artgen.articulation.types import (
    ArticulatedObject,
    Draft,
    DraftPart,
    Joint,
    Precondition,
)
from artgen.assembly.piece import Piece, body_boxes, joined, picked, piece_of_part
from artgen.assembly.split import Split, covers, split_bodies
from artgen.core.licence import OURS, Licence
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.export.manifest import open_bodies
from artgen.finish import Rounder, collision_mesh, joined_mesh, meshed, settle_overlaps
from artgen.geometry.clearance import shape_of_mesh
from artgen.geometry.solid import hull, slab

Side = Literal["out", "along", "left", "right", "bottom", "top", "rear", "turn"]
"""How a part opens: slid out to -y, slid otherwise, hinged at a side of its box (`rear`: a lid that
lies flat and is lifted), or turned about an axis along y or without end."""
Kind = Literal["front", "whole"]
"""Whether a front can be told from the works behind it, or all but the handle goes as one."""
ROUNDING = 1e-6
"""m; what collision pieces may stick out of a front."""
THINNEST = 1e-4
"""m; what has less extent along an axis is a sheet, which no scale brings to the box of a slot."""
INTRUDES = 1e-9
"""m3; works that share more with the box of their front keep other fronts out."""
HANDLE_LEAVES = frozenset({"handle", "knob", "pull"})
"""What sources call the bodies that a hand takes hold of."""
PRINTS = frozenset(
    {"printed_marks", "appliance_panel", "appliance_display", "carton_print", "screen", "keyboard"}
)
"""Recipes of images that belong to one place and size."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Member:
    """A moving part of a source, taken apart.

    Attributes:
        body: the front, or all but the handle where kind is `whole`.
        handle: what stands out before it to be taken hold of.
        works: what the object needs behind any front: boxes of drawers, hinges.
    """

    name: str
    label: str
    joint: Joint
    kind: Kind
    side: Side
    body: Piece
    handle: Piece | None = None
    works: Piece | None = None

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """All of it, in the order body, handle, works."""
        return tuple(p for p in (self.body, self.handle, self.works) if p is not None)


@dataclass(frozen=True, kw_only=True, eq=False)
class Source:
    """One object of a library.

    Attributes:
        id: unique in a library.
        family: what the source itself was made from, so that splits keep its like together.
        base: the fixed part.
        members: in canonical order.
    """

    id: str
    category: str
    base: Piece
    base_name: str
    members: tuple[Member, ...]
    surfaces: tuple[SurfaceSpec, ...]
    preconditions: tuple[Precondition, ...] = ()
    licence: Licence = OURS
    dataset: str = "artgen"
    family: str = field(default="")

    @property
    def joints(self) -> list[Joint]:
        """Parents before children."""
        names = [self.base_name, *(member.name for member in self.members)]
        return parents_first([member.joint for member in self.members], names)

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Base first, then all of every member."""
        return (self.base, *(p for member in self.members for p in member.pieces))


def source_of_draft(draft: Draft, *, id: str, rounder: Rounder) -> Source:
    """A draft finished part by part, fronts apart from handles and works; the draft is canonical.

    A front is settled without what lies in other groups, so that it has no holes where hinges of
    its own object sat.
    """
    joints = {joint.child: joint for joint in draft.joints}
    base, *movers = draft.parts
    parts, plans = [base], []
    for part in movers:
        split = split_draft(part, joints[part.name])
        groups = [split.front, split.handle, split.works] if split else [_all(part)]
        own = [_subset(part, group) for group in groups if group]
        plans.append((part, split, len(own)))
        parts += own
    pieces = iter(_finished(parts, draft.surfaces, rounder))
    base_piece = next(pieces)
    members = []
    for part, split, count in plans:
        own_pieces = [next(pieces) for _ in range(count)]
        members.append(_member(part, joints[part.name], split, own_pieces))
    return Source(
        id=id,
        category=draft.category,
        base=base_piece,
        base_name=base.name,
        members=tuple(members),
        surfaces=draft.surfaces,
        preconditions=draft.preconditions,
        family=id,
    )


def source_of_object(
    obj: ArticulatedObject, *, id: str, licence: Licence, dataset: str, family: str = ""
) -> Source:
    """A finished object taken apart body by body.

    A part whose front is a sheet without thickness, or whose works reach into the box of its front,
    is kept whole.
    """
    base, *movers = obj.parts
    members = []
    for part in movers:
        joint = obj.joint_of(part.name)
        if joint is None:
            continue
        whole = piece_of_part(part, shells_of(obj.provenance, part.name))
        boxes = body_boxes(whole.mesh)
        called = named_bodies(obj.provenance, part.name, HANDLE_LEAVES)
        split = split_bodies(boxes, joint, part.grips, handles=called)
        groups = [split.front, split.handle, split.works] if split else [range(len(boxes))]
        own = [piece for group in groups if (piece := picked(whole, group)) is not None]
        if split and not _fits_before(own[0], own[-1] if split.works else None):
            split, own = None, [dataclasses.replace(whole, grips=())]
        own = [dataclasses.replace(own[0], grips=part.grips), *own[1:]]
        members.append(_sorted_grips(_named(part.name, part.label, joint, split, own)))
    return Source(
        id=id,
        category=obj.category,
        base=piece_of_part(base, shells_of(obj.provenance, base.name)),
        base_name=base.name,
        members=tuple(members),
        surfaces=obj.surfaces,
        preconditions=obj.preconditions,
        licence=licence,
        dataset=dataset,
        family=family or id,
    )


def named_bodies(
    provenance: Mapping[str, Any], part: str, leaves: Collection[str]
) -> tuple[int, ...]:
    """Numbers of the bodies of a part that its source calls by one of some names: `fragments` of
    an ingested object lists runs of bodies by the name of their leaf."""
    stated = provenance.get("fragments")
    runs = stated.get(part, ()) if isinstance(stated, Mapping) else ()
    starts = [run["bodies"] for run in runs if str(run["leaf"]).lower() in leaves]
    return tuple(k for first, count in starts for k in range(first, first + count))


def shells_of(provenance: Mapping[str, Any], part: str) -> dict[int, float]:
    """Numbers of a part's bodies that an ingested object states to be open surfaces, and the m that
    each weighs as."""
    numbers = open_bodies(provenance, part)
    return dict.fromkeys(numbers, float(provenance["shells"]["thickness"])) if numbers else {}


def split_draft(part: DraftPart, joint: Joint) -> Split | None:
    """The split of a part of a draft; None where its works reach into the box of its front."""
    boxes = np.array([body.solid.bounds for body in part.bodies])
    split = split_bodies(boxes, joint, part.grips)
    if split is None:
        return None
    room = slab(boxes[list(split.front), 0].min(axis=0), boxes[list(split.front), 1].max(axis=0))
    shared = (float((part.bodies[k].solid & room).volume) for k in split.works)
    return None if any(volume > INTRUDES for volume in shared) else split


def _fits_before(front: Piece, works: Piece | None) -> bool:
    """Whether a front has a thickness, and works keep out of its box; open works with their box."""
    lower, upper = front.bounds
    if (upper - lower).min() < THINNEST:
        return False
    if works is None:
        return True
    room = m3.Manifold.cube(upper - lower).translate(lower)
    boxes = body_boxes(works.mesh)
    shared = np.minimum(boxes[:, 1], upper) - np.maximum(boxes[:, 0], lower)
    return all(
        shared[k].clip(min=0.0).prod() <= INTRUDES
        if k in works.shells
        else body.status() == m3.Error.NoError and (body ^ room).volume() <= INTRUDES
        for k, body in enumerate(shape_of_mesh(works.mesh).bodies)
    )


def _all(part: DraftPart) -> tuple[int, ...]:
    return tuple(range(len(part.bodies)))


def _subset(part: DraftPart, bodies: Sequence[int]) -> DraftPart:
    return dataclasses.replace(part, bodies=tuple(part.bodies[k] for k in bodies))


def _finished(
    parts: Sequence[DraftPart], surfaces: tuple[SurfaceSpec, ...], rounder: Rounder
) -> list[Piece]:
    slots = {surface.name: k for k, surface in enumerate(surfaces)}
    settled = [settle_overlaps(part) for part in parts]
    return [
        Piece(
            mesh=joined_mesh(part, bodies, slots, surfaces),
            densities=tuple(body.density for body in part.bodies),
            collision=tuple(collision_mesh(c) for body in part.bodies for c in body.collision),
        )
        for part, bodies in zip(settled, meshed(settled, rounder), strict=True)
    ]


def _member(part: DraftPart, joint: Joint, split: Split | None, own: list[Piece]) -> Member:
    own = [dataclasses.replace(own[0], grips=part.grips), *own[1:]]
    return _sorted_grips(_named(part.name, part.label, joint, split, own))


def _named(name: str, label: str, joint: Joint, split: Split | None, own: list[Piece]) -> Member:
    rest = iter(own[1:])
    handle = next(rest) if split and split.handle else None
    works = next(rest) if split and split.works else None
    lifted = label in ROLES and ROLES[label].closes and covers(joint, own[0].bounds)
    return Member(
        name=name,
        label=label,
        joint=joint,
        kind="front" if split else "whole",
        side="rear" if lifted else side_of(joint, own[0].bounds),
        body=kept_within(own[0]) if split else own[0],
        handle=handle,
        works=works,
    )


def kept_within(front: Piece) -> Piece:
    """A front whose collision pieces end where it does: those of a hollow door reach back through
    the lining, which belongs to the works."""
    lower, upper = front.bounds
    room = slab(lower, upper)

    def cut(piece: TriMesh) -> TriMesh:
        low, high = piece.bounds
        within = (low >= lower - ROUNDING).all() and (high <= upper + ROUNDING).all()
        return piece if within else collision_mesh(hull(piece.vertices) & room)

    own = [c for c in front.collision if ((c.bounds[1] > lower) & (c.bounds[0] < upper)).all()]
    return dataclasses.replace(front, collision=tuple(cut(piece) for piece in own))


def _sorted_grips(member: Member) -> Member:
    """Grips of kinds that handles have, moved from the body to the handle where there is one."""
    if member.handle is None:
        return member
    held = tuple(g for g in member.body.grips if g.kind in ("handle", "knob"))
    kept = tuple(g for g in member.body.grips if g not in held)
    return dataclasses.replace(
        member,
        body=dataclasses.replace(member.body, grips=kept),
        handle=dataclasses.replace(member.handle, grips=held),
    )


def side_of(joint: Joint, box: Floats) -> Side:
    """How a part opens, told by its joint and the box of its body."""
    axis, origin = np.array(joint.axis), np.array(joint.origin)
    if joint.type == "prismatic":
        return "out" if axis[1] < -0.9 else "along"
    along = int(np.argmax(np.abs(axis)))
    if joint.type == "continuous" or along == 1:
        return "turn"
    across = 0 if along == 2 else 2
    low = abs(origin[across] - box[0, across]) <= abs(origin[across] - box[1, across])
    if along == 2:
        return "left" if low else "right"
    return "bottom" if low else "top"


def whole_mesh(member: Member) -> TriMesh:
    """All bodies of a member in one mesh."""
    return joined(member.pieces).mesh
