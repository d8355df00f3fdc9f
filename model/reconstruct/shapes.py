"""Predicted surfaces as closed solids: crumbs dropped, needless triangles merged, never empty."""

from dataclasses import dataclass

import manifold3d as m3
import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import Ints
from artgen.geometry.solid import Solid, slab, union
from model.reconstruct.guess import PartGuess

CRUMB = 0.02
"""Pieces below this share of a part's largest piece are floaters of the field."""
MOST_LOST = 0.05
"""Share of its volume that a part may gain or lose by one round of merging triangles."""
LEAST_SIDE = 0.002
"""m; a predicted box is not thinner."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """The solid that stands for a part, and what had to be done for it."""

    solid: Solid
    changes: tuple[str, ...]


def shape_of(guess: PartGuess, *, tolerance: float, triangles: int) -> Shape:
    """The part as a solid whose surface lies within `tolerance` m of the predicted one, or within
    as much more as brings it down to some `triangles`."""
    changes: list[str] = []
    manifold = _closed(guess, guess.faces, changes)
    if manifold is None:
        changes.append("its predicted box stands for it")
        return Shape(solid=predicted_box(guess), changes=tuple(changes))
    if manifold.volume() < 0.0:
        changes.append("its surface was turned inside out")
        manifold = _closed(guess, guess.faces[:, ::-1], changes) or manifold
    return Shape(
        solid=_tidy(Solid(manifold), tolerance, triangles, changes), changes=tuple(changes)
    )


def _closed(guess: PartGuess, faces: Ints, changes: list[str]) -> m3.Manifold | None:
    """The surface as manifold3d takes it; None where it is empty, open or without a volume."""
    if not len(faces):
        changes.append("it has no surface")
        return None
    manifold = m3.Manifold(m3.Mesh64(np.array(guess.vertices), faces.astype(np.uint64)))
    if manifold.status() != m3.Error.NoError or manifold.volume() == 0.0:
        changes.append(f"its surface encloses nothing ({manifold.status().name})")
        return None
    return manifold


def _tidy(solid: Solid, tolerance: float, triangles: int, changes: list[str]) -> Solid:
    pieces = solid.pieces()
    largest = max(piece.volume for piece in pieces)
    kept = [piece for piece in pieces if piece.volume >= CRUMB * largest]
    if len(kept) < len(pieces):
        changes.append(f"{len(pieces) - len(kept)} floating crumbs were dropped")
    whole = kept[0] if len(kept) == 1 else union(kept)
    moved = 0.0
    while moved == 0.0 or whole.manifold.num_tri() > triangles:
        simple = whole.manifold.simplify(tolerance)
        if simple.is_empty() or abs(simple.volume() / whole.volume - 1.0) > MOST_LOST:
            break
        whole, moved, tolerance = Solid(simple), moved + tolerance, 1.5 * tolerance
    return whole


def predicted_box(guess: PartGuess) -> Solid:
    """The box of the heads."""
    middle = guess.box.mean(axis=0)
    half = np.maximum(guess.box[1] - guess.box[0], LEAST_SIDE) / 2.0
    return slab(middle - half, middle + half)


def mended(solid: Solid, tolerance: float) -> Solid:
    """The solid less pieces that booleans leave where surfaces nearly touch, and less triangles
    that say nothing; its surface moves by `tolerance` m at most.

    Raises:
        GeometryError: nothing is left.
    """
    pieces = solid.pieces()
    if not pieces:
        raise GeometryError("a reconstructed part vanished under its neighbors")
    largest = max(piece.volume for piece in pieces)
    kept = [piece for piece in pieces if piece.volume >= CRUMB**2 * largest]
    whole = solid if len(kept) == len(pieces) else union(kept)
    simple = whole.manifold.simplify(tolerance)
    return whole if simple.is_empty() else Solid(simple)
