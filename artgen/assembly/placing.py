"""Finished objects in canonical form: on the ground, centered, parts and pivots in order."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from artgen.articulation.canonical import (
    LEVEL,
    canonical_order,
    canonical_pivot,
    moved_joint,
    parents_first,
)
from artgen.articulation.types import Joint
from artgen.assembly.piece import Piece
from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.mesh import Floats, TriMesh
from artgen.export.kinematics import vector

Named = tuple[str, str, Piece]
"""Name, label and bodies of a part."""


def placed(parts: Sequence[Named], joints: Sequence[Joint]) -> tuple[list[Named], list[Joint]]:
    """The same object in canonical form; the first part is the base and stays first.

    It is moved by whole steps of the grid that vertices lie on, so that they stay exact.
    """
    boxes = [piece.bounds for _, _, piece in parts]
    low, high = np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]
    middle = (low + high) / 2.0
    shift = np.round(np.array([-middle[0], -middle[1], -low[2]]), VERTEX_DECIMALS)
    shift[np.abs(shift) < max(LEVEL, 10.0**-VERTEX_DECIMALS)] = 0.0
    order = canonical_order(boxes)
    moved = [(parts[k][0], parts[k][1], shifted(parts[k][2], shift)) for k in order]
    pivoted = [canonical_pivot(moved_joint(joint, shift)) for joint in joints]
    return moved, parents_first(pivoted, [name for name, _, _ in moved])


def shifted(piece: Piece, shift: Floats) -> Piece:
    """A piece moved by (3,) m."""
    if not shift.any():
        return piece
    return dataclasses.replace(
        piece,
        mesh=dataclasses.replace(piece.mesh, vertices=on_grid(piece.mesh.vertices + shift)),
        collision=tuple(
            TriMesh(vertices=on_grid(c.vertices + shift), faces=c.faces) for c in piece.collision
        ),
        grips=tuple(
            dataclasses.replace(g, position=vector(np.add(g.position, shift))) for g in piece.grips
        ),
    )


def on_grid(points: Floats) -> Floats:
    """Rounded to the grid of finished vertices, without negative zeros."""
    return np.asarray(np.round(points, VERTEX_DECIMALS) + 0.0)
