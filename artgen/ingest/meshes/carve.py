"""Carve: a chunk cut along the faces of what stands in its way, until its pieces leave that free.

A hull is convex, so whatever of a body lies outside of it lies beyond one of its faces. Cut off
along these faces, the pieces of a body that does not touch the hull are clear of it, and nothing is
lost. What then lies inside is given up only if it is as thin as a film.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import manifold3d as m3
import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.ingest.meshes.chunks import SHEET, Chunk, split
from artgen.ingest.meshes.cuts import area_of, clipped

GAP = 1e-5
"""m that is left between a piece and what it was cut for."""
LOSS = 6e-4
"""m; thickness of what may be given up between two parts."""
SHARE = 0.25
"""Of a chunk that may be given up."""
CUTS = 24
"""Cuts that one chunk may take for the sake of one hull."""
MEET = 2e-5
"""m; hulls that can be told apart by one of their faces, but for this, do not meet."""
CRUMB = SHEET**3
"""m3; a piece that is smaller than this is given up."""
FLAT = 1e-6
"""Differences of normals (1) and offsets (m) below which two planes are one."""
FACES = 96
"""Faces of a tool that are cut along, at most."""
ALIKE = 0.1
"""Differences of normals below which only the larger of two faces is kept of a tool with more."""
SAMPLES = 6
"""Points along a triangle's edges that stand for it when planes are compared."""
POINTS = 3000
"""Points that stand for a surface when planes are compared, at most."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Tool:
    """A convex solid and the planes of its faces: outward normals (P, 3), offsets (P,), m."""

    solid: m3.Manifold
    normals: Floats
    offsets: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Carved:
    """The pieces that are left of a chunk, and the m3 of it that were given up."""

    chunks: tuple[Chunk, ...]
    lost: float


def tool_of(points: Floats) -> Tool | None:
    """The hull of (N, 3) points; None if it is flat."""
    solid = m3.Manifold.hull_points(points)
    if solid.is_empty() or solid.volume() <= 0.0:
        return None
    mesh = solid.to_mesh64()
    own = np.asarray(mesh.vert_properties, np.float64)[:, :3]
    corners = own[np.asarray(mesh.tri_verts, np.int64)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1)
    normals, corners = normals[length > 1e-14], corners[length > 1e-14]
    normals = normals / length[length > 1e-14][:, None]
    offsets = (corners @ normals[:, :, None])[..., 0].max(axis=1)
    planes = np.concatenate([normals, offsets[:, None]], axis=1)
    kept = _distinct(planes / FLAT, length[length > 1e-14])
    if len(kept) > FACES:
        kept = kept[_distinct(normals[kept] / ALIKE, length[length > 1e-14][kept])][:FACES]
    return Tool(solid=solid, normals=normals[kept], offsets=offsets[kept])


def _distinct(rows: Floats, size: Floats) -> NDArray[np.intp]:
    """Numbers of rows that differ when rounded, of equal ones the largest; the largest first."""
    order = np.argsort(-size, kind="stable")
    _, first = np.unique(np.round(rows[order]), axis=0, return_index=True)
    return np.asarray(order[np.sort(first)])


def swept(chunk: Chunk, poses: Sequence[Floats]) -> Tool | None:
    """The hull of a chunk's piece at (4, 4) poses."""
    points = np.asarray(chunk.mesh.vertices)
    return tool_of(np.concatenate([apply(pose, points) for pose in poses]))


def near(one: Chunk, other: Chunk, way: Floats) -> bool:
    """Whether the boxes of two pieces meet, the second moved by a (4, 4) pose."""
    points = apply(way, np.asarray(other.mesh.vertices))
    lower, upper = one.mesh.bounds
    return bool(
        (points.max(axis=0) > lower + MEET).all() and (points.min(axis=0) < upper - MEET).all()
    )


def meets(chunk: Chunk, tool: Tool) -> bool:
    """Whether a chunk's piece and the tool share room that is worth a cut."""
    points = np.asarray(chunk.mesh.vertices)
    if ((tool.offsets - (tool.normals @ points.T).min(axis=1)) < MEET).any():
        return False
    return (chunk.room ^ tool.solid).volume() > MEET**3


def carved(chunk: Chunk, tool: Tool, wall: float) -> Carved | None:
    """The chunk cut so that no piece of it meets the tool; None if that would cost more of the
    body than a film."""
    waiting, done, lost, cuts = [chunk], list[Chunk](), 0.0, 0
    most = SHARE * content(chunk)
    while waiting:
        own = waiting.pop()
        if not meets(own, tool):
            done.append(own)
            continue
        plane = _best_plane(own, tool)
        if plane is None or cuts == CUTS:
            loss = _film(own, tool)
            if loss is None or lost + loss > most:
                return None
            lost += loss
            continue
        cuts += 1
        for pieces, side in zip(split(own, plane, wall), (done, waiting), strict=True):
            side += [piece for piece in pieces if piece.hull.volume() > CRUMB]
            lost += sum(content(piece) for piece in pieces if piece.hull.volume() <= CRUMB)
    return Carved(chunks=tuple(done), lost=lost) if done else None


def content(chunk: Chunk) -> float:
    """m3 of the body itself; a shell is as thick as a sheet."""
    return chunk.solid.volume() if chunk.solid is not None else area_of(chunk.corners) * SHEET


def local_tool(chunk: Chunk, pose: Floats, other: Chunk) -> Tool | None:
    """The hull of what a chunk, moved by a (4, 4) pose, has inside the box of another; None if it
    has nothing there."""
    corners = apply(pose, chunk.corners.reshape(-1, 3)).reshape(-1, 3, 3)
    points = np.asarray(other.mesh.vertices)
    lower, upper = points.min(axis=0) - GAP, points.max(axis=0) + GAP
    for axis in range(3):
        corners, _ = clipped(corners, corners[..., axis] - lower[axis])
        _, corners = clipped(corners, corners[..., axis] - upper[axis])
    return tool_of(corners.reshape(-1, 3)) if len(corners) else None


def _best_plane(chunk: Chunk, tool: Tool) -> tuple[Floats, float] | None:
    """The face of the tool beyond which most of the chunk's surface lies; None if nothing lies
    beyond any."""
    points, weights = _samples(chunk.corners)
    heights = points @ tool.normals.T - tool.offsets - GAP
    top = heights.max(axis=0)
    best = int(np.argmax(np.where(top > GAP, weights @ (heights > 0.0) + 1e-9 * top, -1.0)))
    return (tool.normals[best], float(tool.offsets[best] + GAP)) if top[best] > GAP else None


def _samples(corners: Floats) -> tuple[Floats, Floats]:
    """(S, 3) corners and inner points of triangles, and the m2 that each stands for; of many
    triangles the largest."""
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    count = SAMPLES if len(corners) < POINTS / 30 else 1
    grid = np.array([(i, j, count - i - j) for i in range(count + 1) for j in range(count + 1 - i)])
    bary = np.concatenate([(grid + 1.0 / 3.0) / (count + 1.0), np.eye(3)])
    chosen = np.sort(np.argsort(-area, kind="stable")[: POINTS // len(bary)])
    points = np.einsum("gk,fkd->fgd", bary, corners[chosen]).reshape(-1, 3)
    return points, np.repeat(area[chosen] / (2.0 * len(bary)), len(bary))


def _film(chunk: Chunk, tool: Tool) -> float | None:
    """m3 that are lost with a chunk whose surface lies inside the tool; None if it is no film."""
    if chunk.solid is not None:
        inside = chunk.solid ^ tool.solid
        if inside.is_empty():
            return float(chunk.solid.volume()) if chunk.solid.volume() < LOSS**3 else None
        thick = 2.0 * inside.volume() / max(inside.surface_area(), 1e-300)
        return float(chunk.solid.volume()) if thick <= LOSS else None
    points, _ = _samples(chunk.corners)
    depth = (tool.offsets - points @ tool.normals.T).min(axis=1).max()
    return content(chunk) if depth <= LOSS else None
