"""Chunks: pieces of bodies with their hulls, cut in two and made into convex meshes."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import manifold3d as m3
import numpy as np

from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.measure import welded
from artgen.geometry.solid import slab
from artgen.ingest.meshes.clean import Body
from artgen.ingest.meshes.cuts import FULL, area_of, best_cut, clipped

FILM = 1e-7
"""Of a solid: a cut along a face leaves films of no volume, which are no pieces."""
PLATE = 0.25
"""Of its next longer side: what is thinner is a plate."""
SHEET = 1e-3
"""m; thickness of the piece of a flat shell, behind its outer side."""
LEAST = 1e-4
"""m; a hull that would be left thinner than this by a limit keeps what is beyond it."""
Plane = tuple[Floats, float]
"""Unit normal (3,) and offset, m: what lies on the side of the normal has a larger product."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Chunk:
    """A piece of a body.

    Attributes:
        corners: surface triangles (F, 3, 3).
        solid: if the body was closed.
        hull: convex, around the surface; of a shell, also around a sheet behind it.
        excess: how much of the hull is empty beyond what is allowed, m3.
        limits: planes beyond which the hull lies, as a sheet behind a surface may lead back.
    """

    corners: Floats
    solid: m3.Manifold | None
    hull: m3.Manifold
    excess: float
    limits: tuple[Plane, ...] = ()

    @cached_property
    def mesh(self) -> TriMesh:
        """The convex mesh that stands for it, on the grid of vertices."""
        return _mesh(self)

    @cached_property
    def room(self) -> m3.Manifold:
        """The solid of `mesh`."""
        return m3.Manifold.hull_points(np.array(self.mesh.vertices))

    @property
    def slack(self) -> float:
        """m3 of the hull that the body does not fill; of a shell, all but a sheet."""
        if self.solid is not None:
            return float(self.hull.volume() - self.solid.volume())
        return float(self.hull.volume() - area_of(self.corners) * SHEET)


def chunk_of_body(body: Body, wall: float) -> Chunk:
    """All of a body in one piece; `wall` is how thick walls may be, m."""
    solid = None
    if body.closed:
        faces = body.soup.faces.astype(np.uint64)
        solid = m3.Manifold(m3.Mesh64(np.array(body.soup.vertices), faces))
    return made(body.soup.vertices[body.soup.faces], solid, wall)


def made(
    corners: Floats, solid: m3.Manifold | None, wall: float, limits: tuple[Plane, ...] = ()
) -> Chunk:
    """A chunk with its hull; see `Chunk`."""
    if solid is not None:
        hull = solid.hull()
        excess = float(FULL * hull.volume() - solid.volume())
        return Chunk(corners=corners, solid=solid, hull=hull, excess=excess, limits=limits)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    sheet = SHEET * (normal / length.clip(min=1e-300)[:, None])[:, None]
    points = np.concatenate([corners, corners - sheet]).reshape(-1, 3)
    hull = _limited(m3.Manifold.hull_points(points), points, limits)
    area = float(length.sum()) / 2.0
    shown = min(1.0, _face_area(corners, normal) * 2.0 / max(float(hull.surface_area()), 1e-300))
    allowed = min(max(area / 2.0 * wall, wall**3), float(hull.volume()) * shown / FULL)
    excess = float(hull.volume() - allowed)
    return Chunk(corners=corners, solid=None, hull=hull, excess=excess, limits=limits)


def _limited(hull: m3.Manifold, points: Floats, limits: Sequence[Plane]) -> m3.Manifold:
    """The hull without what a sheet adds on the wrong side of planes."""
    for normal, offset in limits:
        height = points @ normal
        if height.min() < offset and height.max() > offset + LEAST:
            hull = hull.trim_by_plane(tuple(normal), offset)
    return hull


def _face_area(corners: Floats, normal: Floats) -> float:
    """m2 of a shell that stand for its hull's larger side: of a plate, what looks along its thin
    axis to the one side or to the other, as it may have both; else all."""
    spans = np.ptp(corners.reshape(-1, 3), axis=0)
    thin, *wide = np.argsort(spans)
    if spans[thin] > PLATE * spans[wide[0]]:
        return float(np.linalg.norm(normal, axis=1).sum()) / 2.0
    along = normal[:, thin] / 2.0
    return float(max(along[along > 0.0].sum(), -along[along < 0.0].sum()))


def settled(chunk: Chunk) -> Chunk:
    """A chunk that is not cut again."""
    return Chunk(
        corners=chunk.corners, solid=chunk.solid, hull=chunk.hull, excess=0.0, limits=chunk.limits
    )


def halves(chunk: Chunk, wall: float) -> Iterator[Chunk]:
    """Both sides of the best cut across an axis that are not empty; of a solid, every body that it
    falls into."""
    axis, place = best_cut(chunk.corners, wall, solid=chunk.solid is not None)
    for side in split(chunk, (np.eye(3)[axis], place), wall):
        yield from side


def split(chunk: Chunk, plane: Plane, wall: float) -> tuple[list[Chunk], list[Chunk]]:
    """What lies beyond a plane, on the side of its normal, and what before it; of a solid, every
    body that it falls into."""
    normal, offset = plane
    if chunk.solid is None:
        beyond, before = clipped(chunk.corners, chunk.corners @ normal - offset)
        limits = (*chunk.limits, plane)
        return (
            [made(beyond, None, wall, limits)] if len(beyond) else [],
            [made(before, None, wall, chunk.limits)] if len(before) else [],
        )
    first, second = chunk.solid.split_by_plane(tuple(normal), offset)
    least = FILM * chunk.solid.volume()
    return _bodies(first, least, wall), _bodies(second, least, wall)


def _bodies(half: m3.Manifold, least: float, wall: float) -> list[Chunk]:
    found = []
    for body in half.decompose():
        if body.volume() > least:
            mesh = body.to_mesh64()
            points = np.asarray(mesh.vert_properties, np.float64)[:, :3]
            found.append(made(points[np.asarray(mesh.tri_verts, np.int64)], body, wall))
    return found


def _mesh(chunk: Chunk) -> TriMesh:
    """The hull on the grid of vertices; the box of the chunk where the hull has no volume."""
    mesh = chunk.hull.to_mesh64()
    points = np.asarray(mesh.vert_properties, np.float64)[:, :3]
    if len(points) >= 4:
        faces = np.asarray(mesh.tri_verts, np.int32)
        points, faces = welded(np.round(points, VERTEX_DECIMALS) + 0.0, faces)
        hull = m3.Manifold.hull_points(points)
        if hull.volume() > SHEET**3:
            again = hull.to_mesh64()
            return TriMesh(
                vertices=np.asarray(again.vert_properties, np.float64)[:, :3],
                faces=np.asarray(again.tri_verts, np.int32),
            )
    lower, upper = chunk.corners.min(axis=(0, 1)), chunk.corners.max(axis=(0, 1))
    if not np.isfinite([lower, upper]).all():
        raise GeometryError("a body without extent has no collision piece")
    middle, half = (lower + upper) / 2.0, np.maximum(upper - lower, SHEET) / 2.0
    lower, upper = (np.round(corner, VERTEX_DECIMALS) for corner in (middle - half, middle + half))
    return slab(lower, upper).trimesh()
