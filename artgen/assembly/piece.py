"""Pieces: bodies that belong together, finished, with all that travels with them."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.types import Grip, Mass, Part
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.measure import Moments, combined, moments, sheet_moments

NEAR = 0.004
"""m; how far a collision piece may stick out of the bodies that it stands for."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Piece:
    """Finished bodies of one rigid part, or some of them; object frame of their source at rest.

    Attributes:
        mesh: with UV; bodies numbered from 0 in order, each with vertices of its own.
        densities: kg/m3 a body.
        collision: convex pieces.
        grips: those that lie on these bodies.
        shells: number of each body that is an open surface to the m that it weighs as; all others
            are closed.
    """

    mesh: TriMesh
    densities: tuple[float, ...]
    collision: tuple[TriMesh, ...] = ()
    grips: tuple[Grip, ...] = ()
    shells: Mapping[int, float] = field(default_factory=dict)

    @property
    def bounds(self) -> Floats:
        """(2, 3) m."""
        return self.mesh.bounds

    @property
    def slots(self) -> tuple[int, ...]:
        """Which surfaces it shows."""
        return tuple(int(slot) for slot in np.unique(np.asarray(self.mesh.slot)))


def body_boxes(mesh: TriMesh) -> Floats:
    """(B, 2, 3) bounds of each body, m."""
    bodies = np.asarray(mesh.body)
    corners = mesh.triangles
    count = int(bodies.max()) + 1
    lower, upper = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(lower, bodies, corners.min(axis=1))
    np.maximum.at(upper, bodies, corners.max(axis=1))
    return np.stack([lower, upper], axis=1)


def body_volumes(mesh: TriMesh) -> Floats:
    """(B,) m3."""
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    six = np.einsum("ij,ij->i", a, np.cross(b, c))
    return np.bincount(np.asarray(mesh.body), weights=six) / 6.0


def picked(piece: Piece, bodies: Sequence[int]) -> Piece | None:
    """Some bodies of a piece with the collision that lies on them, without grips; None for none."""
    if not len(bodies):
        return None
    mesh = picked_mesh(piece.mesh, bodies)
    boxes = body_boxes(mesh)
    others = np.delete(body_boxes(piece.mesh), list(bodies), axis=0)
    return Piece(
        mesh=mesh,
        densities=tuple(piece.densities[k] for k in bodies),
        collision=tuple(c for c in piece.collision if _belongs(c.bounds, boxes, others)),
        shells={n: piece.shells[k] for n, k in enumerate(bodies) if k in piece.shells},
    )


def picked_mesh(mesh: TriMesh, bodies: Sequence[int]) -> TriMesh:
    """Some bodies of a mesh, numbered anew in the order given."""
    place: NDArray[np.int64] = np.full(int(np.asarray(mesh.body).max()) + 1, -1)
    place[list(bodies)] = np.arange(len(bodies))
    number = place[np.asarray(mesh.body)]
    order = np.argsort(number, kind="stable")
    order = order[number[order] >= 0]
    used, index = np.unique(mesh.faces[order], return_inverse=True)
    return TriMesh(
        vertices=mesh.vertices[used],
        faces=index.reshape(-1, 3),
        uv=None if mesh.uv is None else mesh.uv[order],
        atlas=None if mesh.atlas is None else mesh.atlas[order],
        slot=np.asarray(mesh.slot)[order],
        body=number[order],
    )


def _belongs(piece: Floats, own: Floats, others: Floats) -> bool:
    """Whether a collision piece's box shares more with the own bodies' boxes than with others'."""
    here, there = _shared(piece, own), _shared(piece, others)
    return here > 0.0 and here >= there


def _shared(box: Floats, boxes: Floats) -> float:
    """The most that a box shares with one of (B, 2, 3) boxes grown by `NEAR`, m3."""
    low = np.maximum(boxes[:, 0] - NEAR, box[0])
    high = np.minimum(boxes[:, 1] + NEAR, box[1])
    return float((high - low).clip(min=0.0).prod(axis=1).max(initial=0.0))


def joined(pieces: Sequence[Piece]) -> Piece:
    """One piece of several: bodies keep their order and are numbered on.

    Raises:
        GeometryError: there is no piece, or one has no UV.
    """
    if not pieces or any(piece.mesh.uv is None for piece in pieces):
        raise GeometryError("pieces without texture coordinates cannot be joined; finish them")
    meshes = [piece.mesh for piece in pieces]
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    counts = np.cumsum([0, *(len(piece.densities) for piece in pieces)])
    return Piece(
        mesh=TriMesh(
            vertices=np.concatenate([mesh.vertices for mesh in meshes]),
            faces=np.concatenate([m.faces + s for m, s in zip(meshes, starts, strict=False)]),
            uv=np.concatenate([mesh.uv for mesh in meshes if mesh.uv is not None]),
            slot=np.concatenate([np.asarray(mesh.slot) for mesh in meshes]),
            body=np.concatenate(
                [np.asarray(m.body) + c for m, c in zip(meshes, counts, strict=False)]
            ),
        ),
        densities=tuple(d for piece in pieces for d in piece.densities),
        collision=tuple(c for piece in pieces for c in piece.collision),
        grips=tuple(g for piece in pieces for g in piece.grips),
        shells={
            k + c: t for p, c in zip(pieces, counts, strict=False) for k, t in p.shells.items()
        },
    )


def weighed(piece: Piece) -> Mass:
    """Exact mass properties of closed bodies, and of open ones as sheets, at their densities."""
    mass, center, tensor = combined(zip(piece.densities, _integrals(piece), strict=True))
    return Mass(mass=mass, center=center, inertia=tensor)


def _integrals(piece: Piece) -> Iterator[Moments]:
    """Of each body: over what it encloses, or along an open surface."""
    bodies, corners = np.asarray(piece.mesh.body), piece.mesh.triangles
    for k in range(len(piece.densities)):
        own = corners[bodies == k]
        thickness = piece.shells.get(k)
        yield moments(own) if thickness is None else sheet_moments(own, thickness)


def piece_of_part(part: Part, shells: Mapping[int, float] | None = None) -> Piece:
    """A finished part as a piece; one density for every body where none is stated, so that it
    weighs what the part does.

    Args:
        shells: which of its bodies are open surfaces, and the m that each weighs as.
    """
    count = int(np.asarray(part.mesh.body).max()) + 1
    piece = Piece(
        mesh=dataclasses.replace(part.mesh, atlas=None),
        densities=part.densities or (1.0,) * count,
        collision=part.collision,
        grips=part.grips,
        shells=shells or {},
    )
    if part.densities is not None:
        return piece
    volume = sum(integral.volume for integral in _integrals(piece))
    return dataclasses.replace(piece, densities=(part.mass.mass / volume,) * count)
