"""Interpenetration of rigid shapes over poses: boxes first, exact booleans where boxes meet."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import manifold3d as m3
import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.solid import Solid

NEGLIGIBLE = 1e-12
"""m3; two boxes that share less cannot hide an overlap worth reporting (0.1 mm cubed)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """The closed bodies of one rigid part, at rest.

    Attributes:
        bodies: closed and outward, in any number.
        points: (V, 3) their vertices, m, body after body.
        starts: (B,) row of each body's first vertex.
        rest: (B, 2, 3) bounds of each body, m.
    """

    bodies: tuple[m3.Manifold, ...]
    points: Floats
    starts: NDArray[np.intp]
    rest: Floats

    def boxes(self, object_from_rest: Floats) -> Floats:
        """(K, B, 2, 3) bounds of each body under each of (K, 4, 4) poses."""
        shift = object_from_rest[:, None, None, :3, 3]
        turns = object_from_rest[:, :3, :3]
        if (turns == np.eye(3)).all():
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
    points = [np.asarray(solid.manifold.to_mesh64().vert_properties)[:, :3] for solid in listed]
    return _shape([solid.manifold for solid in listed], points)


def shape_of_mesh(mesh: TriMesh) -> Shape:
    """One body for each number in `mesh.body`; bodies share no vertices and come in order.

    A body that is not closed stays in the list with a status other than `NoError`, and never
    overlaps.
    """
    manifolds, points = [], []
    cuts = np.flatnonzero(np.diff(np.asarray(mesh.body))) + 1
    for faces in np.split(mesh.faces, cuts):
        first, last = int(faces.min()), int(faces.max()) + 1
        own = mesh.vertices[first:last].copy()  # manifold3d refuses read-only arrays.
        manifolds.append(m3.Manifold(m3.Mesh64(own, (faces - first).astype(np.uint64))))
        points.append(own)
    return _shape(manifolds, points)


def _shape(manifolds: Sequence[m3.Manifold], points: Sequence[Floats]) -> Shape:
    starts = np.cumsum([0, *(len(p) for p in points[:-1])])
    rest = np.array([(p.min(axis=0), p.max(axis=0)) for p in points])
    return Shape(bodies=tuple(manifolds), points=np.concatenate(points), starts=starts, rest=rest)


@dataclass(frozen=True, kw_only=True, eq=False)
class Mover:
    """A shape on its way.

    Attributes:
        poses: (K, 4, 4) `object_from_rest`.
        group: shapes of one group keep their relative pose, so their pairs are left out.
    """

    name: str
    shape: Shape
    poses: Floats
    group: int


def overlaps(movers: Sequence[Mover]) -> Iterator[Overlap]:
    """Every pair of different groups that interpenetrates, pose by pose, with the shared volume.

    Exact at the given poses: pairs of bodies are dropped only where their boxes, along the object's
    axes or along those of either body at rest, share less than `NEGLIGIBLE`.
    """
    owner = np.repeat(np.arange(len(movers)), [len(m.shape.bodies) for m in movers])
    boxes = np.concatenate([m.shape.boxes(m.poses) for m in movers], axis=1)
    first, second = _meeting(boxes, np.array([m.group for m in movers])[owner])
    meeting = _shared(boxes[:, first], boxes[:, second]) > NEGLIGIBLE
    alive = meeting.any(axis=0)
    first, second, meeting = first[alive], second[alive], meeting[:, alive]
    starts = np.searchsorted(owner, np.arange(len(movers)))
    parts = np.stack([owner[first], owner[second]], axis=1)
    for i, j in np.unique(parts, axis=0).tolist():
        own = (parts == (i, j)).all(axis=1)
        bodies = np.stack([first[own] - starts[i], second[own] - starts[j]], axis=1)
        yield from _pair_overlaps(movers[i], movers[j], bodies, meeting[:, own])


def _pair_overlaps(
    a: Mover, b: Mover, bodies: NDArray[np.intp], meeting: NDArray[np.bool_]
) -> Iterator[Overlap]:
    """Overlaps of two movers; `bodies` is (P, 2), `meeting` the (K, P) poses where boxes meet."""
    b_from_a = _inverted(b.poses) @ a.poses
    box_a, box_b = a.shape.rest[bodies[:, 0]], b.shape.rest[bodies[:, 1]]
    meeting = meeting & (_shared(_carried(b_from_a, box_a), box_b[None]) > NEGLIGIBLE)
    meeting &= _shared(_carried(_inverted(b_from_a), box_b), box_a[None]) > NEGLIGIBLE
    for pose in np.flatnonzero(meeting.any(axis=1)):
        volume = sum(
            float((a.shape.bodies[i].transform(b_from_a[pose, :3]) ^ b.shape.bodies[j]).volume())
            for i, j in bodies[meeting[pose]].tolist()
        )
        if volume > 0.0:
            yield Overlap(pose=int(pose), first=a.name, second=b.name, volume=volume)


def _inverted(poses: Floats) -> Floats:
    """(K, 4, 4) inverses of rigid poses."""
    inverse = np.tile(np.eye(4), (len(poses), 1, 1))
    inverse[:, :3, :3] = poses[:, :3, :3].transpose(0, 2, 1)
    inverse[:, :3, 3] = -np.einsum("kij,kj->ki", inverse[:, :3, :3], poses[:, :3, 3])
    return inverse


def _carried(poses: Floats, boxes: Floats) -> Floats:
    """(K, P, 2, 3) bounds of (P, 2, 3) boxes after each of (K, 4, 4) poses."""
    middle, half = boxes.mean(axis=1), np.diff(boxes, axis=1)[:, 0] / 2.0
    moved = np.einsum("kij,pj->kpi", poses[:, :3, :3], middle) + poses[:, None, :3, 3]
    reach = np.einsum("kij,pj->kpi", np.abs(poses[:, :3, :3]), half)
    return np.stack([moved - reach, moved + reach], axis=2)


def _meeting(boxes: Floats, group: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Index pairs i < j of different groups whose boxes, taken over all poses, share a volume."""
    lower, upper = boxes[:, :, 0].min(axis=0), boxes[:, :, 1].max(axis=0)
    meet = group[:, None] < group[None, :]
    for axis in range(3):
        meet &= lower[:, None, axis] < upper[None, :, axis]
        meet &= lower[None, :, axis] < upper[:, None, axis]
    first, second = np.nonzero(meet)
    return first, second


def _shared(first: Floats, second: Floats) -> Floats:
    """(..., ) m3 that boxes (..., 2, 3) share."""
    depth = np.minimum(first[..., 1, :], second[..., 1, :]) - np.maximum(
        first[..., 0, :], second[..., 0, :]
    )
    return np.asarray(depth.clip(min=0.0).prod(axis=-1))
