"""Interpenetration of rigid shapes over poses: boxes first, exact booleans where boxes meet."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import manifold3d as m3
import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.solid import Solid

NEGLIGIBLE = 1e-12
"""m3; two boxes that share less cannot hide an overlap worth reporting (0.1 mm cubed)."""
WORTH_A_CUT = 3
"""Poses from which cutting both bodies to where they can meet is faster than whole booleans."""
STRAIGHT = 1e-12
"""m; places on one line are off it by roundings of 1e-16 of a few meters."""
SHADOW = 1e-12
"""m2; over a meter of way it makes `NEGLIGIBLE`. manifold3d rounds outlines to 1e-8 m, so bodies
that touch flush share more than this and are looked at pose by pose."""
MARGIN = 1e-3
"""m; keeps the faces of the cut away from those of the other body."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """The closed bodies of one rigid part, at rest.

    Attributes:
        bodies: closed and outward, in any number.
        points: (V, 3) vertices of all bodies, m, body after body.
        starts: (B,) row of each body's first vertex.
        rest: (B, 2, 3) bounds of each body, m.
    """

    bodies: Sequence[m3.Manifold]
    points: Floats
    starts: NDArray[np.intp]
    rest: Floats

    def boxes(self, object_from_rest: Floats) -> Floats:
        """(K, B, 2, 3) bounds of each body under each of (K, 4, 4) poses."""
        shift = object_from_rest[:, None, None, :3, 3]
        turns = object_from_rest[:, :3, :3]
        if not len(self.bodies) or (turns == np.eye(3)).all():
            return np.asarray(self.rest + shift)
        turned = turns @ self.points.T
        lower = np.minimum.reduceat(turned, self.starts, axis=2)
        upper = np.maximum.reduceat(turned, self.starts, axis=2)
        return np.asarray(np.stack([lower, upper], axis=2).transpose(0, 3, 2, 1) + shift)


@dataclass(frozen=True, kw_only=True)
class Overlap:
    """Two shapes share `volume` m3 at one pose."""

    pose: int
    first: str
    second: str
    volume: float


def shape_of_solids(solids: Iterable[Solid]) -> Shape:
    """One body a solid."""
    listed = list(solids)
    points = [solid.trimesh().vertices for solid in listed]
    return _shape([solid.manifold for solid in listed], points)


def shape_of_nothing() -> Shape:
    """No body: what a part without a mesh puts in others' way."""
    return Shape(
        bodies=(), points=np.zeros((0, 3)), starts=np.zeros(0, np.intp), rest=np.zeros((0, 2, 3))
    )


def shape_of_mesh(mesh: TriMesh) -> Shape:
    """One body for each number in `mesh.body`; bodies share no vertices and come in order.

    A body that is not closed keeps its place with a status other than `NoError`; it never overlaps.
    """
    cuts = np.concatenate([[0], np.flatnonzero(np.diff(np.asarray(mesh.body))) + 1])
    starts = np.minimum.reduceat(mesh.faces.min(axis=1), cuts).astype(np.intp)
    lower = np.minimum.reduceat(mesh.vertices, starts, axis=0)
    upper = np.maximum.reduceat(mesh.vertices, starts, axis=0)
    return Shape(
        bodies=MeshBodies(mesh, cuts, starts),
        points=mesh.vertices,
        starts=starts,
        rest=np.stack([lower, upper], axis=1),
    )


class MeshBodies(Sequence[m3.Manifold]):
    """The bodies of a mesh as exact solids, each made when first asked for: most meet no other."""

    def __init__(self, mesh: TriMesh, cuts: NDArray[np.intp], starts: NDArray[np.intp]) -> None:
        self._mesh = mesh
        self._faces = [*cuts.tolist(), len(mesh.faces)]
        self._vertices = [*starts.tolist(), len(mesh.vertices)]
        self._made: dict[int, m3.Manifold] = {}

    def __len__(self) -> int:
        return len(self._faces) - 1

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        index = range(len(self))[index]
        if index not in self._made:
            first, last = self._vertices[index : index + 2]
            begin, end = self._faces[index : index + 2]
            own = self._mesh.vertices[first:last].copy()  # manifold3d refuses read-only arrays.
            faces = (self._mesh.faces[begin:end] - first).astype(np.uint64)
            self._made[index] = m3.Manifold(m3.Mesh64(own, faces))
        return self._made[index]


def _shape(manifolds: Sequence[m3.Manifold], points: Sequence[Floats]) -> Shape:
    return Shape(
        bodies=tuple(manifolds),
        points=np.concatenate(points),
        starts=np.cumsum([0, *(len(p) for p in points[:-1])]),
        rest=np.array([(p.min(axis=0), p.max(axis=0)) for p in points]),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Mover:
    """A shape on its way; `poses` is (K, 4, 4) `object_from_rest`, a path without jumps."""

    name: str
    shape: Shape
    poses: Floats


def overlaps(
    movers: Sequence[Mover], pairs: Iterable[tuple[int, int]] | None = None
) -> Iterator[Overlap]:
    """Pairs of movers (all if None) that interpenetrate, pose by pose, with the shared volume.

    Exact at the given poses: pairs of bodies are dropped only where their boxes, along the object's
    axes or along those of either body at rest, share less than `NEGLIGIBLE`.
    """
    owner = np.repeat(np.arange(len(movers)), [len(m.shape.bodies) for m in movers])
    boxes = np.concatenate([m.shape.boxes(m.poses) for m in movers], axis=1)
    wanted = np.zeros((len(movers), len(movers)), bool)
    for i, j in _all_pairs(len(movers)) if pairs is None else pairs:
        wanted[i, j] = True
    first, second = _meeting(boxes, wanted[owner][:, owner])
    meeting = _shared(boxes[:, first], boxes[:, second]) > NEGLIGIBLE
    alive = meeting.any(axis=0)
    first, second, meeting = first[alive], second[alive], meeting[:, alive]
    starts = np.searchsorted(owner, np.arange(len(movers)))
    parts = np.stack([owner[first], owner[second]], axis=1)
    for i, j in np.unique(parts, axis=0).tolist():
        own = (parts == (i, j)).all(axis=1)
        bodies = np.stack([first[own] - starts[i], second[own] - starts[j]], axis=1)
        yield from _pair_overlaps(movers[i], movers[j], bodies, meeting[:, own])


def _all_pairs(count: int) -> Iterator[tuple[int, int]]:
    return ((i, j) for i in range(count) for j in range(i + 1, count))


def _meeting(boxes: Floats, wanted: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Wanted index pairs whose boxes, taken over all poses, share a volume."""
    lower, upper = boxes[:, :, 0].min(axis=0), boxes[:, :, 1].max(axis=0)
    for axis in range(3):
        wanted = wanted & (lower[:, None, axis] < upper[None, :, axis])
        wanted &= lower[None, :, axis] < upper[:, None, axis]
    first, second = np.nonzero(wanted)
    return first, second


def _shared(first: Floats, second: Floats) -> Floats:
    """(..., ) m3 that boxes (..., 2, 3) share."""
    upper = np.minimum(first[..., 1, :], second[..., 1, :])
    lower = np.maximum(first[..., 0, :], second[..., 0, :])
    return np.asarray((upper - lower).clip(min=0.0).prod(axis=-1))


def _pair_overlaps(
    a: Mover, b: Mover, bodies: NDArray[np.intp], meeting: NDArray[np.bool_]
) -> Iterator[Overlap]:
    """Overlaps of two movers; `bodies` is (P, 2), `meeting` the (K, P) poses where boxes meet."""
    b_from_a = inverted_poses(b.poses) @ a.poses
    box_a, box_b = a.shape.rest[bodies[:, 0]], b.shape.rest[bodies[:, 1]]
    meeting = meeting & (_shared(carried(b_from_a, box_a), box_b[None]) > NEGLIGIBLE)
    meeting &= _shared(carried(inverted_poses(b_from_a), box_b), box_a[None]) > NEGLIGIBLE
    volumes = np.zeros(len(b_from_a))
    for pair, (i, j) in enumerate(bodies.tolist()):
        open_ = meeting[:, pair]
        volumes[open_] += _common(a.shape.bodies[i], b.shape.bodies[j], b_from_a[open_])
    for pose in np.flatnonzero(volumes > 0.0).tolist():
        yield Overlap(pose=pose, first=a.name, second=b.name, volume=float(volumes[pose]))


def _common(one: m3.Manifold, other: m3.Manifold, other_from_one: Floats) -> Floats:
    """(K,) m3 that two bodies share at each of (K, 4, 4) poses.

    What cut bodies share is confirmed on the whole ones: manifold3d 3.5.4 answers for a cut wall
    that passes a seal within 0.1 mm with a wedge of 2e-9 m3 that lies outside of the wall.
    """
    volumes = np.zeros(len(other_from_one))
    if one.is_empty() or other.is_empty():  # What is not closed is no solid, and has no box.
        return volumes
    whole = one, other
    meeting = np.ones(len(other_from_one), bool)
    if len(other_from_one) >= WORTH_A_CUT:
        one_from_other = inverted_poses(other_from_one)
        one = _cut_to(one, carried(one_from_other, _box(other)))
        other = other if one.is_empty() else _cut_to(other, carried(other_from_one, _box(one)))
        if one.is_empty() or other.is_empty():
            return volumes
        if _slides_past(one, other, other_from_one):
            return volumes
        meeting = _shared(carried(other_from_one, _box(one)), _box(other))[:, 0] > NEGLIGIBLE
        meeting &= _shared(carried(one_from_other, _box(other)), _box(one))[:, 0] > NEGLIGIBLE
    for pose in np.flatnonzero(meeting):
        volumes[pose] = _shared_volume(one, other, other_from_one[pose])
        if volumes[pose] > NEGLIGIBLE and one is not whole[0]:
            volumes[pose] = min(volumes[pose], _shared_volume(*whole, other_from_one[pose]))
    return volumes


def _shared_volume(one: m3.Manifold, other: m3.Manifold, other_from_one: Floats) -> float:
    """m3 that two bodies share at one (4, 4) pose."""
    return float((one.transform(other_from_one[:3]) ^ other).volume())


def _slides_past(one: m3.Manifold, other: m3.Manifold, other_from_one: Floats) -> bool:
    """Whether a body that only slides straight has a shadow along its way that shares no area with
    the other's: then they meet nowhere on it, told by one boolean in the plane."""
    turns, places = other_from_one[:, :3, :3], other_from_one[:, :3, 3]
    way = places[-1] - places[0]
    length = float(np.linalg.norm(way))
    if length == 0.0 or (turns != turns[0]).any():
        return False
    way = way / length
    if np.abs(np.cross(places - places[0], way)).max() > STRAIGHT:
        return False
    side = np.cross(np.eye(3)[np.argmin(np.abs(way))], way)
    side /= np.linalg.norm(side)
    down_the_way = np.stack([side, np.cross(way, side), way])
    start = np.column_stack([down_the_way @ turns[0], down_the_way @ places[0]])
    still = np.column_stack([down_the_way, np.zeros(3)])
    shared = one.transform(start).project() ^ other.transform(still).project()
    return bool(shared.is_empty() or shared.area() <= SHADOW)


def _box(body: m3.Manifold) -> Floats:
    """(1, 2, 3) bounds of a body, m."""
    return np.array(body.bounding_box()).reshape(1, 2, 3)


def _cut_to(body: m3.Manifold, path: Floats) -> m3.Manifold:
    """The part of a body inside the bounds of (K, 1, 2, 3) boxes; what is outside meets none."""
    lower, upper = path[:, 0, 0].min(axis=0) - MARGIN, path[:, 0, 1].max(axis=0) + MARGIN
    return body ^ m3.Manifold.cube(upper - lower).translate(lower)


def inverted_poses(poses: Floats) -> Floats:
    """(K, 4, 4) inverses of rigid poses."""
    inverse = np.zeros_like(poses)
    inverse[:, 3, 3] = 1.0
    inverse[:, :3, :3] = poses[:, :3, :3].transpose(0, 2, 1)
    inverse[:, :3, 3:] = -inverse[:, :3, :3] @ poses[:, :3, 3:]
    return inverse


def carried(poses: Floats, boxes: Floats) -> Floats:
    """(K, N, 2, 3) bounds of (N, 2, 3) boxes after each of (K, 4, 4) poses."""
    middle, half = boxes.mean(axis=1), np.diff(boxes, axis=1)[:, 0] / 2.0
    moved = middle @ poses[:, :3, :3].transpose(0, 2, 1) + poses[:, None, :3, 3]
    reach = half @ np.abs(poses[:, :3, :3]).transpose(0, 2, 1)
    return np.stack([moved - reach, moved + reach], axis=2)
