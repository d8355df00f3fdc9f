"""Convex contact pieces that lie inside of a solid: boxes along the axes, or its hull where that
lies inside as well.

A hull around a cabinet closes it, and pieces that stick out of their part jam its neighbors. So
space is divided by the planes in which the part has large faces, and by even steps between them;
cells that lie inside are joined to large boxes (a greedy cover).
"""

from collections.abc import Iterator
from itertools import pairwise, permutations

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_cdt

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.normals import face_vectors
from artgen.geometry.solid import Solid, slab

MOST_PIECES = 40
ENOUGH = 0.5
"""Share of the part's volume that boxes hold to be content with."""
LITTLE = 0.1
"""The same of thin parts, such as the frame of a door, for which cells become finer still."""
STEPS = {14: 1.0, 28: ENOUGH, 56: ENOUGH, 112: LITTLE, 224: LITTLE}
"""Cells along the longest side, between the planes of faces, and the share of the part's volume
that coarser ones hold where so fine ones are no longer tried."""
MOST_CELLS = 400_000
"""Of a grid; 56 along each of three sides are 180,000, so finer ones serve slender parts alone."""
CANDIDATES = 200
"""Largest triangles whose normals are tried as axes of a frame."""
ALIKE = 0.97
"""Cosine between normals that count as one direction."""
SEEDS = 6
"""Cells from which boxes are grown, of which the largest is taken."""
FACE = 0.02
"""Share of the surface that looks one way along an axis and makes a plane of its own."""
INSET = 2e-5
"""m; samples and faces of boxes stay this far inside planes, against rounding."""
OUTSIDE = 2e-9
"""m3; what of a piece may lie outside of its part: 0.1 mm of an edge of 4 x 5 mm."""
SAMPLES = (0.02, 0.5, 0.98)
"""Places across a cell that have to lie inside."""
LEAST = 0.002
"""Share of the part's volume that a box fills at least."""
KERNELS = 20
"""Largest triangles behind which a cube is looked for."""
SMALLEST = 2e-5
"""m; half the side of the smallest cube, whose corners stick out by 0.04 mm at most."""
MOST_HITS = 64
"""Surfaces that a line through a part meets at most."""

Cells = NDArray[np.bool_]


def contact_pieces(solid: Solid, *, slanted: int) -> tuple[Solid, ...]:
    """Convex solids inside of `solid`, largest first; its hull where that lies inside as well, and
    a small cube where no box fits in: a hull around a frame would close it.

    Args:
        slanted: boxes at most that are not along the axes; a bundle holds each as a file.
    """
    hull = solid.hull()
    if (hull - solid).volume <= OUTSIDE:
        return (hull,)
    best = boxes_inside(solid)
    if _volume(best) < ENOUGH * solid.volume:
        turn = np.eye(4)
        turn[:3, :3] = face_frame(solid.trimesh())
        turned = boxes_inside(solid.transformed(turn))[:slanted]
        if _volume(turned) > _volume(best):
            best = tuple(piece.transformed(turn.T) for piece in turned)
    return best or (kernel(solid),)


def _volume(pieces: tuple[Solid, ...]) -> float:
    return sum(piece.volume for piece in pieces)


def boxes_inside(solid: Solid) -> tuple[Solid, ...]:
    """Disjoint boxes along the axes, on the coarsest grid whose boxes hold enough."""
    mesh = solid.trimesh()
    best: tuple[Solid, ...] = ()
    for steps, content in STEPS.items():
        if _volume(best) >= content * solid.volume:
            break
        lines = [grid_lines(mesh, axis, steps) for axis in range(3)]
        if np.prod([len(own) - 1 for own in lines]) > MOST_CELLS:
            break
        least = LEAST * solid.volume
        boxes = cover(cells_inside(mesh, lines), lines, least=least)
        found = tuple(piece for box in boxes for piece in held(box, solid, least=least))
        if _volume(found) > _volume(best):
            best = found
    return best


def kernel(solid: Solid) -> Solid:
    """The largest cube behind the middle of a large face that lies inside, by halving."""
    mesh = solid.trimesh()
    vectors = face_vectors(mesh)
    area = np.linalg.norm(vectors, axis=1)
    half = float(solid.extent.max()) / 8.0
    large = np.argsort(area, kind="stable")[::-1][:KERNELS]
    while True:
        for place in large:
            inward = -vectors[place] / area[place]
            middle = mesh.triangles[place].mean(axis=0) + 2.0 * half * inward
            cube = slab((middle - half).tolist(), (middle + half).tolist())
            if half <= SMALLEST or (cube - solid).volume <= 1e-6 * cube.volume:
                return cube
        half = max(half / 2.0, SMALLEST)


def held(box: Solid, solid: Solid, *, least: float) -> Iterator[Solid]:
    """The box, if it lies inside the solid; else its halves that do, down to `least` m3.

    A groove between samples would else be filled.
    """
    if (box - solid).volume <= OUTSIDE:
        yield box
    elif box.volume >= 2.0 * least:
        axis = int(np.argmax(box.extent))
        middle = float(box.bounds[:, axis].mean())
        for half in box.manifold.split_by_plane(np.eye(3)[axis], middle):
            yield from held(Solid(half), solid, least=least)


def face_frame(mesh: TriMesh) -> Floats:
    """(3, 3) rotation that lays most of the surface across the axes: its rows are the direction
    that most area looks along, and that which most looks along of those across it."""
    vectors = face_vectors(mesh)
    area = np.linalg.norm(vectors, axis=1)
    large = np.argsort(area, kind="stable")[::-1][:CANDIDATES]
    normals = vectors / np.where(area > 0.0, area, 1.0)[:, None]
    candidates = normals[large]
    along = np.abs(candidates @ normals.T) > ALIKE
    first = candidates[int(np.argmax(along @ area))]
    across = np.abs(candidates @ first) < 1.0 - ALIKE
    rivals = candidates[across] if across.any() else np.eye(3)[[int(np.argmin(np.abs(first)))]]
    second = rivals[int(np.argmax((np.abs(rivals @ normals.T) > ALIKE) @ area))]
    second = second - (second @ first) * first
    second /= np.linalg.norm(second)
    return np.stack([first, second, np.cross(first, second)])


def grid_lines(mesh: TriMesh, axis: int, steps: int) -> Floats:
    """Coordinates along one axis at which cells end: inner planes of large faces, bounds, steps."""
    vectors = face_vectors(mesh)
    area = np.linalg.norm(vectors, axis=1)
    lower, upper = mesh.bounds[:, axis]
    longest = float((mesh.bounds[1] - mesh.bounds[0]).max())
    step = longest / steps
    planes = [lower, upper]
    for sign in (1.0, -1.0):
        facing = sign * vectors[:, axis] > 0.95 * area
        if facing.any():
            heights = mesh.triangles[facing][:, :, axis].mean(axis=1)
            planes += list(_planes(heights, area[facing], sign, step / 4.0, FACE * area.sum()))
    return _filled(np.unique(np.round(planes, 6)), step)


def _planes(
    heights: Floats, areas: Floats, sign: float, width: float, least: float
) -> Iterator[float]:
    """The inner side of each cluster of faces whose heights lie within `width` m."""
    order = np.argsort(heights)
    heights, areas = heights[order], areas[order]
    cuts = np.flatnonzero(np.diff(heights) > width) + 1
    for own, weight in zip(np.split(heights, cuts), np.split(areas, cuts), strict=True):
        if weight.sum() < least:
            continue
        share = np.cumsum(weight) / weight.sum()
        inner = 0.1 if sign > 0.0 else 0.9
        yield float(own[min(int(np.searchsorted(share, inner)), len(own) - 1)])


def _filled(planes: Floats, step: float) -> Floats:
    """Planes with even ones between them, none farther than `step` m from the next."""
    lines = [planes[:1]]
    for low, high in pairwise(planes.tolist()):
        count = max(1, int(np.ceil((high - low) / step)))
        lines.append(np.linspace(low, high, count + 1)[1:])
    return np.concatenate(lines)


def cells_inside(mesh: TriMesh, lines: list[Floats]) -> Cells:
    """(X, Y, Z) which cells between the lines have all their samples inside the mesh."""
    places = [_samples(own) for own in lines]
    inside = points_inside(mesh, places)
    shape = [len(own) - 1 for own in lines]
    count = len(SAMPLES)
    split = inside.reshape(shape[0], count, shape[1], count, shape[2], count)
    return np.asarray(split.all(axis=(1, 3, 5)))


def _samples(lines: Floats) -> Floats:
    """(S * cells,) coordinates of samples, those at the ends `INSET` m inside at most."""
    low, high = lines[:-1, None], lines[1:, None]
    share = np.array(SAMPLES)
    away = np.minimum((high - low) * share[0], INSET)
    return np.clip(low + (high - low) * share, low + away, high - away).ravel()


def points_inside(mesh: TriMesh, places: list[Floats]) -> Cells:
    """(X, Y, Z) which points of a grid lie inside a closed mesh: lines along z are followed through
    all the surfaces that they meet."""
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, np.asarray(mesh.vertices, np.float32), np.array(mesh.faces))
    upward = face_vectors(mesh)[:, 2]
    x, y = np.meshgrid(places[0], places[1], indexing="ij")
    count = x.size
    start = float(mesh.bounds[0, 2]) - 1.0
    ways = np.tile(np.array([0.0, 0.0, 1.0], np.float32), (count, 1))
    winding = np.zeros((count, len(places[2])), np.int32)
    height, alive = np.full(count, start), np.arange(count)
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    for _ in range(MOST_HITS):
        origins = np.stack([x.ravel()[alive], y.ravel()[alive], height[alive]], axis=1)
        hit = scene.run(origins.astype(np.float32), ways[alive])
        met = hit >= 0
        alive, hit, origins = alive[met], hit[met], origins[met]
        if not len(alive):
            break
        slope = np.where(upward[hit] == 0.0, 1.0, upward[hit])
        rise = np.einsum("ij,ij->i", normal[hit], a[hit] - origins) / slope
        level = origins[:, 2] + np.maximum(rise, 0.0)
        above = places[2][None, :] > level[:, None]
        winding[alive] += np.where(upward[hit] < 0.0, 1, -1)[:, None] * above
        height[alive] = level + 1e-6
    return (winding > 0).reshape(len(places[0]), len(places[1]), len(places[2]))


def cover(cells: Cells, lines: list[Floats], *, least: float) -> Iterator[Solid]:
    """Disjoint boxes of cells, the largest that grows from any cell first."""
    free = cells.copy()
    for _ in range(MOST_PIECES):
        span = _largest(free, lines)
        if span is None:
            return
        low = np.array([lines[k][span[k][0]] for k in range(3)])
        high = np.array([lines[k][span[k][1]] for k in range(3)])
        if float((high - low).prod()) < least:
            return
        free[tuple(slice(first, last) for first, last in span)] = False
        yield slab((low + INSET).tolist(), (high - INSET).tolist())


Span = list[list[int]]
ORDERS = list(permutations(range(3)))


def _largest(free: Cells, lines: list[Floats]) -> Span | None:
    """The largest box of free cells that grows from one of the cells deepest inside: along one axis
    as far as it goes, then along another, then along the last, in all orders."""
    if not free.any():
        return None
    depth = distance_transform_cdt(np.pad(free, 1), metric="chessboard")[1:-1, 1:-1, 1:-1]
    widths = [np.diff(own) for own in lines]
    room = depth * np.einsum("i,j,k->ijk", *widths)
    seeds = np.argsort(room.ravel(), kind="stable")[::-1][:SEEDS]
    best: tuple[float, Span | None] = (0.0, None)
    for seed in zip(*np.unravel_index(seeds, free.shape), strict=True):
        if not free[seed]:
            continue
        for order in ORDERS:
            span = [[int(place), int(place) + 1] for place in seed]
            for axis in order:
                _stretch(free, span, axis)
            volume = float(np.prod([w[a:b].sum() for w, (a, b) in zip(widths, span, strict=True)]))
            if volume > best[0]:
                best = volume, span
    return best[1]


def _stretch(free: Cells, span: Span, axis: int) -> None:
    """Widen a span along an axis while all its cells are free."""
    window = tuple(slice(None) if k == axis else slice(*span[k]) for k in range(3))
    others = tuple(k for k in range(3) if k != axis)
    clear = free[window].all(axis=others)
    low, high = span[axis]
    before = np.flatnonzero(~clear[:low])
    after = np.flatnonzero(~clear[high:])
    span[axis][0] = int(before[-1]) + 1 if len(before) else 0
    span[axis][1] = high + (int(after[0]) if len(after) else len(clear) - high)
