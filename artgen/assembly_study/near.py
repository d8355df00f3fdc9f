"""Near-duplicates: how far apart the visible sides of two objects of one template lie.

Surface samples are where rays of one grid meet a front, and of a smaller one its handle: a grid
tells fronts apart that differ by less than the spacing of random samples would hide, and equal
fronts are at distance 0 however their faces are cut.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.assembly.assemble import Assembled
from artgen.assembly.handles import face_depth
from artgen.assembly.piece import Piece
from artgen.core.mesh import Floats, TriMesh

FRONT_RAYS, HANDLE_RAYS = 12, 6
"""A side of the grids."""
UNIT = 1e-4
"""m; what samples are kept in."""
NOWHERE = -(2**15)
"""Stands for a ray that meets nothing."""
TAU = 0.002
"""Share of a front's diagonal below which two are near-duplicates: 1.4 mm on one of 0.4 x 0.6 m,
which other handles and other panels exceed and rounder edges do not."""
Samples = NDArray[np.int16]


@dataclass(frozen=True, kw_only=True, eq=False)
class Face:
    """The visible sides of one object.

    Attributes:
        index: the attempt.
        template: its id.
        points: (P, N, 3) for each filled part, relative to the middle of its front's box.
        sizes: (P,) diagonals of the fronts' boxes, m.
    """

    index: int
    template: str
    points: Samples
    sizes: Floats


def face_of(index: int, new: Assembled) -> Face:
    """What is seen of the filled parts of an object, in the order of their names."""
    points, sizes = [], []
    for name in sorted(new.seams):
        front, handle = new.layer(name, "body"), new.layer(name, "handle")
        if front is None:
            continue
        middle = front.bounds.mean(axis=0)
        rays = [_met(front, FRONT_RAYS, middle)]
        none = np.full((HANDLE_RAYS**2, 3), NOWHERE, np.int16)
        rays.append(none if handle is None else _met(handle, HANDLE_RAYS, middle))
        points.append(np.concatenate(rays))
        sizes.append(float(np.linalg.norm(np.diff(front.bounds, axis=0))))
    return Face(index=index, template=new.template, points=np.stack(points), sizes=np.array(sizes))


def _met(piece: Piece, count: int, middle: Floats) -> Samples:
    """(count^2, 3) where rays along +y meet a piece."""
    box = piece.bounds
    steps = (np.arange(count) + 0.5) / count
    x, z = (box[0, k] + steps * (box[1, k] - box[0, k]) for k in (0, 2))
    flat = np.stack(np.meshgrid(x, z, indexing="ij"), axis=-1).reshape(-1, 2)
    under = _under_nodes(piece.mesh, x, z)
    if under is None:
        return np.full((count**2, 3), NOWHERE, np.int16)
    depth = face_depth(under, flat)
    points = (np.stack([flat[:, 0], depth, flat[:, 1]], axis=1) - middle) / UNIT
    met = np.isfinite(depth)[:, None]
    return np.where(met, np.round(np.where(met, points, 0.0)), NOWHERE).astype(np.int16)


def _under_nodes(mesh: TriMesh, x: Floats, z: Floats) -> TriMesh | None:
    """The triangles whose box in x and z holds a node of a grid; None where there is none."""
    corners, hit = mesh.triangles, np.ones(len(mesh.faces), bool)
    for axis, nodes in ((0, x), (2, z)):
        low, high = corners[:, :, axis].min(axis=1), corners[:, :, axis].max(axis=1)
        hit &= np.searchsorted(nodes, low) < np.searchsorted(nodes, high, side="right")
    return TriMesh(vertices=mesh.vertices, faces=mesh.faces[hit]) if hit.any() else None


@dataclass(frozen=True, kw_only=True)
class Twins:
    """Over all objects of a study.

    Attributes:
        nearest: the attempt to how far the nearest other object of its template lies, and which
            that is.
        distinct: objects left if each that lies nearer than `TAU` to one kept before is dropped.
    """

    nearest: Mapping[int, tuple[float, int]]
    distinct: int


def twins(faces: Sequence[Face]) -> Twins:
    """Two objects of a template are as far apart as those of their parts that differ most: by the
    Chamfer distance of their samples, the mean of both ways, as a share of the front's diagonal."""
    nearest: dict[int, tuple[float, int]] = {}
    distinct = 0
    for own in _by_template(faces).values():
        apart = pairwise(own)
        distinct += _kept(apart)
        np.fill_diagonal(apart, np.inf)
        for k, face in enumerate(own):
            twin = int(np.argmin(apart[k]))
            nearest[face.index] = float(apart[k, twin]), own[twin].index
    return Twins(nearest=nearest, distinct=distinct)


def _kept(apart: Floats) -> int:
    kept: list[int] = []
    for k in range(len(apart)):
        if not kept or apart[k, kept].min() >= TAU:
            kept.append(k)
    return len(kept)


def _by_template(faces: Sequence[Face]) -> Mapping[str, list[Face]]:
    groups: dict[str, list[Face]] = defaultdict(list)
    for face in faces:
        groups[face.template].append(face)
    return groups


def pairwise(faces: Sequence[Face]) -> Floats:
    """(K, K) distances of objects of one template; infinite where one has a handle that the other
    lacks."""
    apart = np.zeros((len(faces), len(faces)))
    for part in range(len(faces[0].points)):
        met = np.stack([face.points[part] for face in faces])
        for own in np.split(met, [FRONT_RAYS**2], axis=1):
            unique, which = np.unique(own, axis=0, return_inverse=True)
            between = chamfers(unique * UNIT) / faces[0].sizes[part]
            place = which.reshape(-1)
            apart = np.maximum(apart, between[place[:, None], place])
    return apart


def chamfers(sets: Floats) -> Floats:
    """(U, U) symmetric Chamfer distances between (U, N, 3) sets of points, m; points at `NOWHERE`
    do not count, and a set without points is infinitely far from others."""
    there = (sets > 0.5 * NOWHERE * UNIT).all(axis=2)
    far = np.where(there, 0.0, np.inf)
    squares = (sets**2).sum(axis=2)
    one_way = np.full((len(sets), len(sets)), np.inf)
    for k in np.flatnonzero(there.any(axis=1)):
        products = sets[k, there[k]] @ sets.transpose(0, 2, 1)
        across = squares[k, there[k]][:, None] + squares[:, None, :] - 2.0 * products
        nearest = (across + far[:, None, :]).min(axis=2)
        one_way[k] = np.sqrt(np.clip(nearest, 0.0, None)).mean(axis=1)
    np.fill_diagonal(one_way, 0.0)
    return np.asarray((one_way + one_way.T) / 2.0)
