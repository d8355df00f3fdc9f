"""Pieces: convex collision for closed bodies and shells, by cuts along the axes.

A body whose hull it nearly fills is its own piece. Others are cut where that saves the most room,
the emptiest piece first, until all are full enough or there are as many as allowed. A shell is
full if its hull is no thicker than a wall and shows no more surface than it has; so hollows of open
surfaces stay open, and so do frames.
"""

import heapq
from collections.abc import Mapping, Sequence

import numpy as np

from artgen.core.mesh import TriMesh
from artgen.ingest.meshes.apart import set_apart
from artgen.ingest.meshes.chunks import Chunk, chunk_of_body, halves, settled
from artgen.ingest.meshes.clean import Body
from artgen.ingest.meshes.crossing import Surfaces
from artgen.ingest.meshes.meeting import Pose

WALL = 0.02
"""Of the part's diagonal: a shell whose hull is thinner than this in the mean is full."""
CRUMB = 2e-5
"""Of the cube of the part's diagonal: a hollow of less room is not worth a cut."""


def convex_pieces(
    parts: Mapping[str, Sequence[Body]], *, most: int, poses: Sequence[Pose] = ()
) -> dict[str, tuple[TriMesh, ...]]:
    """Part name to convex meshes that together cover its bodies: one a body, and up to `most` cuts
    more; those that lie within others are left out.

    Pieces of different parts that meet at rest or at one of the poses, (4, 4) a part, though their
    bodies do not, are then cut on: a hull's slack must not stand in another part's way.
    """
    walls = {name: _wall(own) for name, own in parts.items()}
    found = {name: _cut(own, walls[name], most) for name, own in parts.items()}
    rest = dict.fromkeys(parts, np.eye(4))
    corners = {
        name: np.concatenate([body.soup.vertices[body.soup.faces] for body in own])
        for name, own in parts.items()
    }
    found = set_apart(found, walls, Surfaces(corners), [rest, *poses], most=most)
    return {n: tuple(chunk.mesh for chunk in _uncovered(own)) for n, own in found.items()}


def _wall(bodies: Sequence[Body]) -> float:
    """m; as thick as walls of the part may be."""
    corners = np.concatenate([body.soup.vertices for body in bodies])
    return WALL * float(np.linalg.norm(np.ptp(corners, axis=0)))


def _cut(bodies: Sequence[Body], wall: float, most: int) -> list[Chunk]:
    """Chunks of one part, the emptiest cut first."""
    crumb = CRUMB * (wall / WALL) ** 3
    waiting: list[tuple[float, int, Chunk]] = []
    for number, body in enumerate(bodies):
        chunk = chunk_of_body(body, wall)
        heapq.heappush(waiting, (-chunk.excess, number, chunk))
    serial, cuts = len(bodies), 0
    while cuts < most and waiting[0][0] < -crumb:
        _, _, chunk = heapq.heappop(waiting)
        parts = list(halves(chunk, wall))
        for half in parts if len(parts) > 1 else [settled(chunk)]:
            heapq.heappush(waiting, (-half.excess, serial, half))
            serial += 1
        cuts += 1
    return [chunk for _, _, chunk in sorted(waiting, key=lambda entry: entry[1])]


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
