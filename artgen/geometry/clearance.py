"""Interpenetration of rigid shapes over poses: boxes first, exact booleans where boxes meet."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import manifold3d as m3
import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import inverted
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
    """

    bodies: tuple[m3.Manifold, ...]
    points: Floats
    starts: NDArray[np.intp]

    def boxes(self, object_from_rest: Floats) -> Floats:
        """(K, B, 2, 3) bounds of each body under each of (K, 4, 4) poses."""
        turned = self.points @ object_from_rest[:, :3, :3].transpose(0, 2, 1)
        lower = np.minimum.reduceat(turned, self.starts, axis=1)
        upper = np.maximum.reduceat(turned, self.starts, axis=1)
        boxes = np.stack([lower, upper], axis=2)
        return np.asarray(boxes + object_from_rest[:, None, None, :3, 3])


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
    cuts = np.flatnonzero(np.diff(mesh.body)) + 1
    for faces in np.split(mesh.faces, cuts):
        first, last = int(faces.min()), int(faces.max()) + 1
        own = np.ascontiguousarray(mesh.vertices[first:last])
        manifolds.append(m3.Manifold(m3.Mesh64(own, (faces - first).astype(np.uint64))))
        points.append(own)
    return _shape(manifolds, points)


def _shape(manifolds: Sequence[m3.Manifold], points: Sequence[Floats]) -> Shape:
    starts = np.cumsum([0, *(len(p) for p in points[:-1])])
    return Shape(bodies=tuple(manifolds), points=np.concatenate(points), starts=starts)


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
    axes or along those of either body's own rest frame, share less than `NEGLIGIBLE`.
    """
    owner = np.repeat(np.arange(len(movers)), [len(m.shape.bodies) for m in movers])
    boxes = np.concatenate([m.shape.boxes(m.poses) for m in movers], axis=1)
    own = np.arange(len(owner)) - np.searchsorted(owner, owner)
    first, second = _meeting(boxes, np.array([m.group for m in movers])[owner])
    meeting = _shared(boxes[:, first], boxes[:, second]) > NEGLIGIBLE
    shared: dict[tuple[int, int, int], float] = {}
    for pair in np.flatnonzero(meeting.any(axis=0)):
        i, j = int(first[pair]), int(second[pair])
        a, b = movers[owner[i]], movers[owner[j]]
        for pose in np.flatnonzero(meeting[:, pair]):
            b_from_a = inverted(b.poses[pose]) @ a.poses[pose]
            volume = _common(a.shape, int(own[i]), b.shape, int(own[j]), b_from_a)
            if volume > 0.0:
                key = (int(pose), int(owner[i]), int(owner[j]))
                shared[key] = shared.get(key, 0.0) + volume
    for (pose, i, j), volume in sorted(shared.items()):
        yield Overlap(pose=pose, first=movers[i].name, second=movers[j].name, volume=volume)


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


def _common(first: Shape, i: int, second: Shape, j: int, second_from_first: Floats) -> float:
    """m3 that two bodies share."""
    moved = first.bodies[i].transform(second_from_first[:3])
    return float((moved ^ second.bodies[j]).volume())
