"""Assembled objects with one thing wrong: what the invariants must catch."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from artgen.articulation.types import Joint
from artgen.assembly.assemble import Assembled
from artgen.assembly.case import Case
from artgen.assembly.piece import Piece, joined
from artgen.assembly.source import Member


def with_new(case: Case, **changes) -> Case:
    return replace(case, new=replace(case.new, **changes))


def with_piece(case: Case, name: str, change: Callable[[Piece], Piece]) -> Case:
    """All bodies of a part changed."""
    parts = tuple((n, lab, change(p) if n == name else p) for n, lab, p in case.new.parts)
    return with_new(case, parts=parts)


def with_layer(case: Case, name: str, layer: str, change: Callable[[Piece], Piece]) -> Case:
    """The front, the handle or the works of a filled part changed."""
    layers = [(key, case.new.layer(name, key)) for key in ("body", "handle", "works")]
    whole = joined([change(p) if key == layer else p for key, p in layers if p is not None])
    return with_piece(case, name, lambda piece: whole)


def with_joint(case: Case, name: str, change: Callable[[Joint], Joint]) -> Case:
    """The joint that moves a part changed."""
    return with_new(
        case, joints=tuple(change(j) if j.child == name else j for j in case.new.joints)
    )


def scaled(piece: Piece, factor: float) -> Piece:
    middle = piece.bounds.mean(axis=0)
    return moved_by(piece, lambda points: middle + factor * (points - middle))


def moved_by(piece: Piece, way: Callable[[np.ndarray], np.ndarray]) -> Piece:
    return replace(piece, mesh=replace(piece.mesh, vertices=way(piece.mesh.vertices)))


def filled_member(new: Assembled, template, side: str) -> Member:
    """A filled part that opens in a way."""
    return next(m for m in template.members if m.name in new.seams and m.side == side)


def has(*sides: str, layer: str = "body") -> Callable[[Case], bool]:
    """Whether a filled part opens in one of some ways and has a layer."""

    def found(case: Case) -> bool:
        return part_with(case, *sides, layer=layer) is not None

    return found


def part_with(case: Case, *sides: str, layer: str = "body") -> Member | None:
    for member in case.template.members:
        if (
            member.name in case.new.seams
            and member.side in sides
            and case.new.layer(member.name, layer)
        ):
            return member
    return None
