"""Predicted surfaces as closed solids: crumbs dropped, needless triangles merged, never empty."""

import dataclasses
from dataclasses import dataclass

import manifold3d as m3
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.errors import GeometryError
from artgen.core.mesh import Ints
from artgen.geometry.measure import welded
from artgen.geometry.solid import Solid, hull, slab
from model.reconstruct.cover import OCTANTS
from model.reconstruct.guess import PartGuess

CRUMB = 0.02
"""Pieces below this share of a part's largest piece are floaters of the field."""
MOST_EMPTY = 0.3
"""Share of the longest side of its predicted box that a surface spans at least; a smaller one is a
crumb of the field."""
MOST_LOST = 0.05
"""Share of its volume that a part may gain or lose by one round of merging triangles."""
LEAST_HOLLOW = 1e-10
"""m3; a tenth of what validators call an overlap. A smaller hollow may be filled, whatever it was
cut for."""
ROUNDS = (1e-4, 2e-4, 4e-4, 8e-4)
"""m; within which triangles are merged in turn, until none is flat."""
GRID = 1e-6
"""m; vertices of a finished part lie on it, so that finishing moves them no more."""
SMALLEST = 2e-14
"""m2; twice what validators ask of a triangle."""
LEAST_SIDE = 0.002
"""m; a predicted box is not thinner."""
ROUND = 0.1
"""Radius of a rounded box's edges as a share of half its shortest side."""
TURNS = np.linspace(0.0, np.pi / 2.0, 4)
ROUNDING = np.array(
    [[np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)] for u in TURNS for v in TURNS]
)
"""Points of an eighth of a ball."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """The solid that stands for a part, and what had to be done for it."""

    solid: Solid
    changes: tuple[str, ...]


def shape_of(guess: PartGuess, *, tolerance: float, triangles: int) -> Shape:
    """The part as a solid whose surface lies within `tolerance` m of the predicted one, or within
    as much more as brings it down to some `triangles`."""
    changes: list[str] = []
    if guess.boxed:
        return Shape(solid=rounded_box(guess), changes=())
    manifold = _closed(guess, guess.faces, changes)
    if manifold is None:
        changes.append("its predicted box stands for it")
        return Shape(solid=predicted_box(guess), changes=tuple(changes))
    if manifold.volume() < 0.0:
        changes.append("its surface was turned inside out")
        manifold = _closed(guess, guess.faces[:, ::-1], changes) or manifold
    solid = _tidy(Solid(manifold), tolerance, triangles, changes)
    longest = float((guess.box[1] - guess.box[0]).max())
    if float(solid.extent.max()) < MOST_EMPTY * longest:
        changes.append(
            f"its surface spans {solid.extent.max():.2g} m of a box of {longest:.2g} m; the box "
            "stands for it"
        )
        return Shape(solid=predicted_box(guess), changes=tuple(changes))
    return Shape(solid=solid, changes=tuple(changes))


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
    whole, dropped = without_small_pieces(solid, CRUMB)
    if dropped:
        changes.append(f"{dropped} floating crumbs or bubbles were dropped")
    moved = 0.0
    while moved == 0.0 or whole.manifold.num_tri() > triangles:
        simple = whole.manifold.simplify(tolerance)
        if simple.is_empty() or abs(simple.volume() / whole.volume - 1.0) > MOST_LOST:
            break
        whole, moved, tolerance = Solid(simple), moved + tolerance, 1.5 * tolerance
    return whole


def without_small_pieces(
    solid: Solid, share: float, *, hollow: float | None = None
) -> tuple[Solid, int]:
    """The solid less its connected surfaces, outer or inner, that enclose less than a share of what
    the largest does; and how many those are.

    Args:
        hollow: m3 from which inner ones stay, however small their share; None for that share.
    """
    mesh = solid.trimesh()
    faces, count = mesh.faces, len(mesh.vertices)
    ends = np.concatenate([faces[:, :2], faces[:, 1:]])
    links = coo_array((np.ones(len(ends)), tuple(ends.T)), shape=(count, count))
    pieces, label = connected_components(links, directed=False)
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    sixfold = np.einsum("ij,ij->i", a, np.cross(b, c))
    signed = np.bincount(label[faces[:, 0]], weights=sixfold, minlength=pieces)
    size = np.abs(signed)
    kept = size >= share * size.max()
    if hollow is not None:
        kept |= signed <= -6.0 * hollow
    if kept.all():
        return solid, 0
    used, index = np.unique(faces[kept[label[faces[:, 0]]]], return_inverse=True)
    found = m3.Mesh64(mesh.vertices[used], index.reshape(-1, 3).astype(np.uint64))
    return Solid(m3.Manifold(found)), int((~kept).sum())


def predicted_box(guess: PartGuess) -> Solid:
    """The box of the heads."""
    middle = guess.box.mean(axis=0)
    half = np.maximum(guess.box[1] - guess.box[0], LEAST_SIDE) / 2.0
    return slab(middle - half, middle + half)


def rounded_box(guess: PartGuess) -> Solid:
    """The box of the heads with round edges."""
    middle = guess.box.mean(axis=0)
    half = np.maximum(guess.box[1] - guess.box[0], LEAST_SIDE) / 2.0
    edge = ROUND * float(half.min())
    corners = OCTANTS[:, None, :] * (half - edge + edge * ROUNDING[None])
    return hull(middle + corners.reshape(-1, 3))


def boxed(part: PartGuess) -> PartGuess:
    """The part as a rounded box of the predicted size."""
    mesh = rounded_box(part).trimesh()
    rgb = np.tile(part.rgb.mean(axis=0), (len(mesh.vertices), 1))
    if part.shade is not None:
        rgb = part.shade(mesh.vertices)
    return dataclasses.replace(part, vertices=mesh.vertices, faces=mesh.faces, rgb=rgb, boxed=True)


def mended(solid: Solid, tolerance: float) -> Solid:
    """The solid less pieces that booleans leave where surfaces nearly touch, and less triangles
    that say nothing; its surface moves by `tolerance` m at most. Hollows stay: what they were cut
    for lies in them.

    Raises:
        GeometryError: nothing is left.
    """
    if solid.is_empty:
        raise GeometryError("a reconstructed part vanished under its neighbors")
    whole, _ = without_small_pieces(solid, CRUMB**2, hollow=LEAST_HOLLOW)
    simple = merged(whole, tolerance)
    return whole if simple.is_empty else simple


def merged(solid: Solid, tolerance: float) -> Solid:
    """The solid with triangles merged within `tolerance` m, those that came of different solids as
    well: manifold3d leaves the edges between what booleans joined alone."""
    return Solid(solid.manifold.as_original().simplify(tolerance))


def sound(solid: Solid) -> Solid:
    """The solid without triangles that finishing, which rounds to 1e-7 m, would flatten: merged
    within more and more, as little as it takes."""
    best = solid
    for tolerance in (0.0, *ROUNDS):
        simple = merged(solid, tolerance) if tolerance else solid
        if simple.is_empty:
            break
        best = _on_grid(simple)
        if _smallest(best) > SMALLEST:
            return best
    return best


def _on_grid(solid: Solid) -> Solid:
    """Vertices rounded to `GRID` m, where that leaves a closed surface."""
    mesh = solid.trimesh()
    vertices, faces = welded(np.round(mesh.vertices / GRID) * GRID, mesh.faces)
    if not len(faces):
        return solid
    found = m3.Manifold(m3.Mesh64(vertices, faces.astype(np.uint64)))
    closed = found.status() == m3.Error.NoError and not found.is_empty()
    return Solid(found) if closed else solid


def _smallest(solid: Solid) -> float:
    """Area of the smallest triangle as finishing rounds it, m2."""
    mesh = solid.trimesh()
    a, b, c = np.round(mesh.triangles, VERTEX_DECIMALS).transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).min()) / 2.0
