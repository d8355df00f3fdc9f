"""A few convex solids that together cover a part: what is cut out of its neighbors.

Cutting with the part itself would print the noise of its surface into everything it passes; a cover
is smooth, small, and its way along a joint is a union of hulls.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import manifold3d as m3
import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.normals import face_vectors
from artgen.geometry.solid import Solid, hull, union
from model.reconstruct.clipping import points_within

MOST = 8
"""Convex pieces of a cover."""
SPARE = 0.04
"""Share of the part's hull that the cover may hold beyond the part."""
CONVEX = 0.9
"""Share of its hull that a piece fills to count as convex."""
PLANE = 0.03
"""Share of the surface that looks along an axis at one height and suggests a cut there."""
BINS = 48
"""Heights along an axis that are told apart."""
COARSE = 600
"""Triangles on which cuts are tried."""
CORNERS = 48
"""Corners of a convex piece from which they are merged."""
OCTANTS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
SIDES = np.array([[-1.0], [1.0]])
Convex = tuple[Solid, ...]


def convex_cover(solid: Solid, *, tolerance: float) -> Convex:
    """Convex solids around `solid`, to `tolerance` m; cut where the hulls of both sides shrink
    most."""
    sketch, mesh = coarse(solid, COARSE), solid.trimesh()
    reach = float(solid.extent.max())
    pieces: list[tuple[Solid, Floats]] = [(sketch, solid.bounds + reach * SIDES)]
    room = SPARE * sketch.hull().volume
    while len(pieces) < MOST:
        spare = [part.hull().volume - part.volume for part, _ in pieces]
        if sum(spare) <= room:
            break
        worst = int(np.argmax(spare))
        cut = _best_cut(pieces[worst][0], least=room / MOST)
        if cut is None:
            break
        own, cell = pieces.pop(worst)
        pieces += zip(_split(own, *cut), _halves(cell, *cut), strict=True)
    found = (hull(points_within(mesh, cell)) for _, cell in pieces)
    return tuple(_plain_hull(tight, tolerance) for tight in found if tight.volume > 0.0)


def coarse(solid: Solid, triangles: int) -> Solid:
    """The solid with fewer triangles, merged within more and more."""
    reach = float(np.linalg.norm(solid.extent))
    tolerance = 1e-4 * reach
    while solid.manifold.num_tri() > triangles and tolerance < 0.03 * reach:
        simple = solid.manifold.simplify(tolerance)
        if simple.is_empty() or simple.volume() < 0.5 * solid.volume:
            break
        solid, tolerance = Solid(simple), 2.0 * tolerance
    return solid


def _plain_hull(tight: Solid, tolerance: float) -> Solid:
    """A convex solid around another, its corners merged within `tolerance` m, or within as much
    more as leaves few; what merging takes off is given back on all sides."""
    plain = tight
    reach = float(np.linalg.norm(tight.extent))
    while tolerance < 0.05 * reach:
        simple = tight.manifold.simplify(tolerance)
        if simple.is_empty():
            break
        plain = Solid(simple).hull()
        if plain.manifold.num_vert() <= CORNERS:
            break
        tolerance *= 1.5
    (around,) = grown((plain,), lacking(plain, tight.trimesh().vertices))
    return around


def lacking(convex: Solid, points: Floats) -> float:
    """How far points lie outside of a convex solid at most, m."""
    mesh = convex.trimesh()
    vectors = face_vectors(mesh)
    area = np.linalg.norm(vectors, axis=1)
    normals = vectors[area > 0.0] / area[area > 0.0, None]
    heights = np.einsum("ij,ij->i", normals, mesh.triangles[area > 0.0][:, 0])
    return max(float((points @ normals.T - heights).max()), 0.0)


def _split(solid: Solid, axis: int, height: float) -> tuple[Solid, Solid]:
    """What lies above and below a plane across an axis."""
    above, below = solid.manifold.split_by_plane(np.eye(3)[axis], height)
    return Solid(above), Solid(below)


def _halves(cell: Floats, axis: int, height: float) -> tuple[Floats, Floats]:
    """The parts of a (2, 3) box above and below a plane across an axis."""
    above, below = cell.copy(), cell.copy()
    above[0, axis] = below[1, axis] = height
    return above, below


def _best_cut(solid: Solid, *, least: float) -> tuple[int, float] | None:
    """The plane that takes most from the hulls, if it takes `least` m3; else the one that takes the
    largest convex piece off, as each wall of a tray is."""
    whole = solid.hull().volume
    best: tuple[float, tuple[int, float] | None] = (least, None)
    piece: tuple[float, tuple[int, float] | None] = (0.0, None)
    for axis in range(3):
        for height in _heights(solid, axis):
            sides = _split(solid, axis, height)
            if any(side.is_empty for side in sides):
                continue
            hulls = [side.hull().volume for side in sides]
            best = max(best, (whole - sum(hulls), (axis, height)), key=lambda own: own[0])
            for side, tight in zip(sides, hulls, strict=True):
                if side.volume > CONVEX * tight:
                    piece = max(piece, (side.volume, (axis, height)), key=lambda own: own[0])
    return best[1] or piece[1]


def _heights(solid: Solid, axis: int) -> Iterator[float]:
    """Where the solid has large faces across an axis, and its quarters."""
    mesh = solid.trimesh()
    lower, upper = mesh.bounds[:, axis]
    vectors = face_vectors(mesh)
    area = np.linalg.norm(vectors, axis=1)
    facing = np.abs(vectors[:, axis]) > 0.9 * area
    middles = mesh.triangles[:, :, axis].mean(axis=1)
    share, edges = np.histogram(
        middles[facing], bins=BINS, range=(lower, upper), weights=area[facing]
    )
    for place in np.flatnonzero(share > PLANE * area.sum()):
        near = facing & (middles >= edges[place]) & (middles <= edges[place + 1])
        height = float(np.average(middles[near], weights=area[near]))
        if lower + 1e-4 < height < upper - 1e-4:
            yield height
    yield from (lower + (upper - lower) * np.array([0.25, 0.5, 0.75])).tolist()


def grown(pieces: Sequence[Solid], gap: float) -> Convex:
    """Each convex piece with all points within `gap` m of it along each axis."""
    if gap == 0.0:
        return tuple(pieces)
    return tuple(
        hull((piece.trimesh().vertices[:, None] + gap * OCTANTS).reshape(-1, 3)) for piece in pieces
    )


def swept(pieces: Sequence[Solid], course: Floats, *, within: Floats | None = None) -> Solid:
    """All that convex pieces pass through on (K, 4, 4) poses, straight from each to the next.

    Args:
        within: (2, 3) bounds of what is asked for; passages outside are left out.
    """
    hulls = []
    for piece in pieces:
        points = piece.trimesh().vertices
        placed = points @ course[:, :3, :3].transpose(0, 2, 1) + course[:, None, :3, 3]
        ends = [placed[[0, -1]]] if _straight(course) else map(np.stack, pairwise(placed))
        for pair in ends:
            cloud = pair.reshape(-1, 3)
            if within is None or _meet(cloud, within):
                hulls.append(m3.Manifold.hull_points(cloud))
    return union([Solid(own) for own in hulls])


def _meet(cloud: Floats, bounds: Floats) -> bool:
    """Whether the box around points shares a volume with another."""
    lower, upper = cloud.min(axis=0), cloud.max(axis=0)
    return bool((lower < bounds[1]).all() and (upper > bounds[0]).all())


def _straight(course: Floats) -> bool:
    """Whether poses differ by a shift along one line, in order."""
    return bool((np.abs(course[:, :3, :3] - course[0, :3, :3]) < 1e-12).all())
