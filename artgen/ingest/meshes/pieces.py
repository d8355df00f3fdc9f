"""Pieces: convex collision for closed bodies and shells, by cuts along the axes.

A body whose hull it nearly fills is its own piece. Others are cut where that saves the most room,
the emptiest piece first, until all are full enough or there are as many as allowed. A shell is
full if its hull is no thicker than a wall and shows no more surface than it has; so hollows of open
surfaces stay open, and so do frames.
"""

import heapq
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import manifold3d as m3
import numpy as np

from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.measure import welded
from artgen.geometry.solid import slab
from artgen.ingest.meshes.clean import Body

FULL = 0.9
"""Of its hull that a solid fills which stands for its own piece."""
WALL = 0.02
"""Of the part's diagonal: a shell whose hull is thinner than this in the mean is full."""
CRUMB = 2e-5
"""Of the cube of the part's diagonal: a hollow of less room is not worth a cut."""
FILM = 1e-7
"""Of a solid: a cut along a face leaves films of no volume, which are no pieces."""
PLATE = 0.25
"""Of its next longer side: what is thinner is a plate."""
PEEL = 0.05
"""Of a chunk's area that a wall has at least to be taken off."""
SHEET = 1e-3
"""m; thickness of the piece of a flat shell, behind its outer side."""
ROUNDS = 6
"""Times that pieces which meet another part's are halved."""
DEEP = 1e-4
"""m; pieces that share less than this in depth touch."""
SLACK = 0.02
"""Of its hull: a piece with less slack is not cut for another part's sake."""
PLACES = 14
"""Places along an axis at which a cut is tried."""
GAIN = 0.97
"""A cut that leaves more of the boxes' volume than this saves nothing; the longest side is halved
then."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Chunk:
    """A piece of a body: surface triangles (F, 3, 3), its solid if the body was closed, its hull,
    and how much of the hull is empty beyond what is allowed, m3."""

    corners: Floats
    solid: m3.Manifold | None
    hull: m3.Manifold
    excess: float


def convex_pieces(
    parts: Mapping[str, Sequence[Body]],
    *,
    most: int,
    poses: Sequence[Mapping[str, Floats]] = (),
) -> dict[str, tuple[TriMesh, ...]]:
    """Part name to convex meshes that together cover its bodies: one a body, and up to `most` cuts
    more; those that lie within others are left out.

    Pieces of different parts that meet at rest are then cut on, as long as one of them is not full
    and for as many cuts again: a hull's slack must not stand in another part's way. Then likewise
    for those that meet at the other poses, (4, 4) a part.
    """
    walls = {name: _wall(own) for name, own in parts.items()}
    found = {name: _cut(own, walls[name], most) for name, own in parts.items()}
    rest = dict.fromkeys(parts, np.eye(4))
    for group in ([rest], list(poses)):
        left = dict.fromkeys(parts, most)
        for _ in range(ROUNDS):
            meeting: dict[str, set[int]] = {}
            for pose in group:
                _add_meeting(meeting, found, left, pose)
            if not meeting:
                break
            for name, numbers in meeting.items():
                kept = [chunk for k, chunk in enumerate(found[name]) if k not in numbers]
                for number in sorted(numbers):
                    kept += list(_halves(found[name][number], walls[name]))
                left[name] -= len(numbers)
                found[name] = kept
    return {n: tuple(_mesh(chunk) for chunk in _uncovered(own)) for n, own in found.items()}


def _wall(bodies: Sequence[Body]) -> float:
    """m; as thick as walls of the part may be."""
    corners = np.concatenate([body.soup.vertices for body in bodies])
    return WALL * float(np.linalg.norm(np.ptp(corners, axis=0)))


def _cut(bodies: Sequence[Body], wall: float, most: int) -> list[Chunk]:
    """Chunks of one part, the emptiest cut first."""
    crumb = CRUMB * (wall / WALL) ** 3
    waiting: list[tuple[float, int, Chunk]] = []
    for number, body in enumerate(bodies):
        chunk = _chunk(body.soup.vertices[body.soup.faces], _solid(body), wall)
        heapq.heappush(waiting, (-chunk.excess, number, chunk))
    serial, cuts = len(bodies), 0
    while cuts < most and waiting[0][0] < -crumb:
        _, _, chunk = heapq.heappop(waiting)
        halves = list(_halves(chunk, wall))
        for half in halves if len(halves) > 1 else [_settled(chunk)]:
            heapq.heappush(waiting, (-half.excess, serial, half))
            serial += 1
        cuts += 1
    return [chunk for _, _, chunk in sorted(waiting, key=lambda entry: entry[1])]


def _add_meeting(
    meeting: dict[str, set[int]],
    found: Mapping[str, Sequence[Chunk]],
    left: Mapping[str, int],
    pose: Mapping[str, Floats],
) -> None:
    """Note by part: chunks that share room with another part's at a pose and have slack, as many
    as cuts are left."""
    owners = [(name, k) for name, own in found.items() for k in range(len(own))]
    hulls = [found[name][k].hull.transform(pose[name][:3]) for name, k in owners]
    boxes = np.array([_bounds(hull) for hull in hulls])
    groups = np.array([list(found).index(name) for name, _ in owners])
    depth = np.minimum(boxes[:, None, 1], boxes[None, :, 1]) - np.maximum(
        boxes[:, None, 0], boxes[None, :, 0]
    )
    near = (depth > DEEP).all(axis=2) & (groups[:, None] < groups[None, :])
    for i, j in zip(*np.nonzero(near), strict=True):
        known = all(k in meeting.get(name, ()) for name, k in (owners[i], owners[j]))
        if known or (hulls[i] ^ hulls[j]).volume() <= DEEP**3:
            continue
        for name, number in (owners[i], owners[j]):
            chunk = found[name][number]
            room = len(meeting.get(name, ())) < left[name]
            if room and _slack(chunk) > SLACK * chunk.hull.volume():
                meeting.setdefault(name, set()).add(number)


def _slack(chunk: Chunk) -> float:
    """m3 of a hull that its body does not fill; of a shell, all but a sheet."""
    if chunk.solid is not None:
        return float(chunk.hull.volume() - chunk.solid.volume())
    return float(chunk.hull.volume() - _area(chunk.corners) * SHEET)


def _bounds(hull: m3.Manifold) -> Floats:
    lower_x, lower_y, lower_z, x, y, z = hull.bounding_box()
    return np.array([[lower_x, lower_y, lower_z], [x, y, z]])


def _solid(body: Body) -> m3.Manifold | None:
    if not body.closed:
        return None
    return m3.Manifold(m3.Mesh64(np.array(body.soup.vertices), body.soup.faces.astype(np.uint64)))


def _chunk(corners: Floats, solid: m3.Manifold | None, wall: float) -> Chunk:
    if solid is not None:
        hull = solid.hull()
        return Chunk(
            corners=corners,
            solid=solid,
            hull=hull,
            excess=float(FULL * hull.volume() - solid.volume()),
        )
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    sheet = SHEET * (normal / length.clip(min=1e-300)[:, None])[:, None]
    hull = m3.Manifold.hull_points(np.concatenate([corners, corners - sheet]).reshape(-1, 3))
    area = float(length.sum()) / 2.0
    shown = min(1.0, _face_area(corners, normal) * 2.0 / max(float(hull.surface_area()), 1e-300))
    allowed = min(max(area / 2.0 * wall, wall**3), float(hull.volume()) * shown / FULL)
    return Chunk(corners=corners, solid=None, hull=hull, excess=float(hull.volume() - allowed))


def _face_area(corners: Floats, normal: Floats) -> float:
    """m2 of a shell that stand for its hull's larger side: of a plate, what looks along its thin
    axis to the one side or to the other, as it may have both; else all."""
    spans = np.ptp(corners.reshape(-1, 3), axis=0)
    thin, *wide = np.argsort(spans)
    if spans[thin] > PLATE * spans[wide[0]]:
        return float(np.linalg.norm(normal, axis=1).sum()) / 2.0
    along = normal[:, thin] / 2.0
    return float(max(along[along > 0.0].sum(), -along[along < 0.0].sum()))


def _settled(chunk: Chunk) -> Chunk:
    """A chunk that is not cut again."""
    return Chunk(corners=chunk.corners, solid=chunk.solid, hull=chunk.hull, excess=0.0)


def _halves(chunk: Chunk, wall: float) -> Iterator[Chunk]:
    """Both sides of the best cut that are not empty; of a solid, every body that it falls into."""
    axis, place = best_cut(chunk.corners, wall, solid=chunk.solid is not None)
    if chunk.solid is None:
        for side in clipped(chunk.corners, axis, place):
            if len(side):
                yield _chunk(side, None, wall)
        return
    normal = np.eye(3)[axis]
    for half in chunk.solid.split_by_plane(normal, place):
        for body in half.decompose():
            if body.volume() > FILM * chunk.solid.volume():
                mesh = body.to_mesh64()
                points = np.asarray(mesh.vert_properties, np.float64)[:, :3]
                yield _chunk(points[np.asarray(mesh.tri_verts, np.int64)], body, wall)


def best_cut(corners: Floats, wall: float, *, solid: bool) -> tuple[int, float]:
    """Axis and place of a plane to cut at: the one that leaves the least volume of boxes on both
    its sides; where that saves nothing, the one that takes off the largest wall, as walls have to
    be taken off a hollow one by one; where there is none, the middle of the longest side.

    A wall is not longest across the cut that takes it off. One of a solid has two sides. Boxes of
    open surfaces are padded, as some have no volume.
    """
    thick, offsets = (2.0 * wall, (0.0,)) if solid else (wall, (-wall / 4.0, wall / 4.0))
    lower, upper = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    pad = 0.0 if solid else wall / 4.0
    best, found = GAIN * float(np.prod(upper - lower + pad)), None
    largest, peeled = PEEL * _area(corners), None
    for axis in range(3):
        for place in _places(corners[..., axis], wall, offsets):
            sides = [side for side in clipped(corners, axis, place) if len(side)]
            if len(sides) < 2:
                continue
            spans = [np.ptp(side.reshape(-1, 3), axis=0) for side in sides]
            if (volume := float(sum(np.prod(span + pad) for span in spans))) < best:
                best, found = volume, (axis, float(place))
            for side, span in zip(sides, spans, strict=True):
                area = _area(side)
                face = float(np.prod(np.sort(span)[1:]))
                full = area >= FULL * face and np.prod(span) <= area / 2.0 * thick
                if area > largest and full and int(np.argmax(span)) != axis:
                    largest, peeled = area, (axis, float(place))
    axis = int(np.argmax(upper - lower))
    return found or peeled or (axis, float((lower[axis] + upper[axis]) / 2.0))


def _area(corners: Floats) -> float:
    edges = corners[:, 1:] - corners[:, :1]
    return float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()) / 2.0


def _places(values: Floats, wall: float, offsets: Sequence[float]) -> Floats:
    """Places where vertices are, which is where walls end, or just beside."""
    at = np.unique(np.round(values, 6))
    if len(at) > PLACES:
        at = at[np.linspace(0, len(at) - 1, PLACES).astype(int)]
    beside = np.concatenate([at + offset for offset in offsets])
    margin = 1e-6 + 0.01 * wall
    return np.unique(beside[(beside > at[0] + margin) & (beside < at[-1] - margin)])


def clipped(corners: Floats, axis: int, place: float) -> tuple[Floats, Floats]:
    """Triangles (F, 3, 3) above and below a plane across an axis; those it crosses are cut."""
    height = corners[..., axis] - place
    above, below = (height >= 0.0).all(axis=1), (height <= 0.0).all(axis=1)
    crossing = ~(above | below)
    tops, bottoms = [corners[above]], [corners[below & ~above]]
    if crossing.any():
        own, level = corners[crossing], height[crossing]
        lone = np.where((level > 0.0).sum(axis=1) == 1, level.argmax(axis=1), level.argmin(axis=1))
        order = (lone[:, None] + np.arange(3)) % 3
        tip, left, right = np.take_along_axis(own, order[..., None], axis=1).transpose(1, 0, 2)
        a, b, c = np.take_along_axis(level, order, axis=1).T
        on_left = tip + (a / (a - b))[:, None] * (left - tip)
        on_right = tip + (a / (a - c))[:, None] * (right - tip)
        tips = np.stack([tip, on_left, on_right], axis=1)
        rest = np.concatenate([
            np.stack([on_left, left, right], axis=1), np.stack([on_left, right, on_right], axis=1)
        ])  # fmt: skip
        up = a > 0.0
        tops += [tips[up], rest[np.tile(~up, 2)]]
        bottoms += [tips[~up], rest[np.tile(up, 2)]]
    return np.concatenate(tops), np.concatenate(bottoms)


def _uncovered(chunks: Sequence[Chunk]) -> list[Chunk]:
    """Chunks whose hull does not lie within another's; of equal ones the first."""
    meshes = [chunk.hull.to_mesh64() for chunk in chunks]
    points = [np.asarray(mesh.vert_properties, np.float64)[:, :3] for mesh in meshes]
    boxes = np.array(
        [[p.min(axis=0), p.max(axis=0)] if len(p) else np.zeros((2, 3)) for p in points]
    )
    kept: list[int] = []
    order = np.argsort([-chunk.hull.volume() for chunk in chunks], kind="stable")
    for index in order.tolist():
        near = [
            k
            for k in kept
            if (boxes[k, 0] <= boxes[index, 0] + 1e-9).all()
            and (boxes[k, 1] >= boxes[index, 1] - 1e-9).all()
        ]
        if not any((chunks[index].hull - chunks[k].hull).is_empty() for k in near):
            kept.append(index)
    return [chunks[k] for k in sorted(kept)]


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
