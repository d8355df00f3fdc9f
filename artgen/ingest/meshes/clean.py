"""Clean: doubled and flat triangles out, closed bodies told from open shells, all facing outward.

Fragments of strangers are soups: many faces stand there twice, once turned around; most surfaces
are open. No vertex is moved but by rounding, and no hole is filled.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import manifold3d as m3
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.mesh import Floats
from artgen.geometry.measure import closed
from artgen.ingest.meshes.soup import Faces, Look, Soup
from artgen.repair.meshes import disagreeing

MIN_AREA = 1e-12
"""m2 of doubled area; below, a triangle has no direction to speak of."""
CERTAIN = 0.1
"""By which share of the longer way rays from one side of a surface have to go further than from
the other for that side to be the outer one."""
PROBES = 12
"""Triangles of a shell from which rays start."""
DIRECTIONS = 16


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """Connected triangles of one fragment.

    Attributes:
        soup: welded: vertices (V, 3) m, rounded, all used.
        leaf: what the source calls the fragment.
        closed: whether it encloses a volume; else it is a shell.
        certain: whether it is known which side of a shell is the outer one.
    """

    soup: Soup
    leaf: str
    closed: bool
    certain: bool = True


@dataclass(frozen=True, kw_only=True)
class Washed:
    """How many triangles were left out or turned.

    Attributes:
        doubled: stood there a second time.
        flat: had no area.
        turned: faced inward, or against their neighbors.
        unsure: shells whose outer side is not certain; renderers should show both sides.
    """

    doubled: int = 0
    flat: int = 0
    turned: int = 0
    unsure: int = 0

    def __add__(self, other: "Washed") -> "Washed":
        return Washed(
            doubled=self.doubled + other.doubled,
            flat=self.flat + other.flat,
            turned=self.turned + other.turned,
            unsure=self.unsure + other.unsure,
        )


def welded_soup(soup: Soup) -> tuple[Soup, Washed]:
    """Vertices rounded and merged by place; flat and repeated triangles left out, the first of
    each kept."""
    points, index = np.unique(
        np.round(soup.vertices, VERTEX_DECIMALS) + 0.0, axis=0, return_inverse=True
    )
    faces = index.reshape(-1)[soup.faces]
    a, b, c = points[faces].transpose(1, 0, 2)
    solid = np.linalg.norm(np.cross(b - a, c - a), axis=1) > MIN_AREA
    live = np.flatnonzero(solid)
    first = np.unique(np.sort(faces[live], axis=1), axis=0, return_index=True)[1]
    kept = live[np.sort(first)]
    washed = Washed(doubled=len(live) - len(kept), flat=len(faces) - len(live))
    own = Soup(vertices=points, faces=faces, uv=soup.uv, look=soup.look, looks=soup.looks)
    return own.of(kept), washed


def bodies_of(soup: Soup, leaf: str) -> tuple[list[Body], Washed]:
    """Closed bodies of a welded fragment facing outward, then one shell of all that is open, whose
    triangles agree with their neighbors."""
    if not len(soup.faces):
        return [], Washed()
    turn = disagreeing(soup.faces)
    piece = pieces_by_edge(soup.faces)
    soup = _turned(soup, turn)
    closed_bodies, open_faces, turned = [], [], turn.copy()
    for number in range(int(piece.max()) + 1):
        own = np.flatnonzero(piece == number)
        part = compacted(soup.of(own))
        volume = signed_volume(part)
        if encloses(part) and abs(volume) > 0.0:
            if volume < 0.0:
                part = _turned(part, np.ones(len(own), bool))
                turned[own] = ~turned[own]
            closed_bodies.append(Body(soup=part, leaf=leaf, closed=True))
        else:
            open_faces.append(own)
    if open_faces:
        shell = compacted(soup.of(np.sort(np.concatenate(open_faces))))
        closed_bodies.append(Body(soup=shell, leaf=leaf, closed=False))
    return closed_bodies, Washed(turned=int(turned.sum()))


def encloses(soup: Soup) -> bool:
    """Whether manifold3d takes it for the surface of a solid."""
    if not closed(soup.faces):  # type: ignore[arg-type]
        return False
    mesh = m3.Mesh64(np.array(soup.vertices), soup.faces.astype(np.uint64))
    return bool(m3.Manifold(mesh).status() == m3.Error.NoError)


def signed_volume(soup: Soup) -> float:
    """m3, about one of its vertices."""
    a, b, c = (soup.vertices[soup.faces] - soup.vertices[0]).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def compacted(soup: Soup) -> Soup:
    """The same triangles with the vertices and looks that they use alone."""
    used, faces = np.unique(soup.faces, return_inverse=True)
    looks, look = np.unique(soup.look, return_inverse=True)
    kept: tuple[Look, ...] = tuple(soup.looks[k] for k in looks)
    return Soup(
        vertices=soup.vertices[used],
        faces=faces.reshape(-1, 3),
        uv=soup.uv,
        look=look.reshape(-1),
        looks=kept,
    )


def pieces_by_edge(faces: Faces) -> NDArray[np.int64]:
    """(F,) number of the piece of each triangle; triangles of one piece share edges."""
    count = len(faces)
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    _, edge = np.unique(edges, axis=0, return_inverse=True)
    edge = edge.reshape(-1)
    owner = np.tile(np.arange(count), 3)
    size = count + int(edge.max()) + 1
    graph = coo_array((np.ones(len(edge), bool), (owner, count + edge)), shape=(size, size))
    label = connected_components(graph, directed=False)[1][:count]
    return np.unique(label, return_inverse=True)[1].reshape(-1)


def _turned(soup: Soup, turned: NDArray[np.bool_]) -> Soup:
    """Some triangles turned around."""
    at = turned[:, None]
    return Soup(
        vertices=soup.vertices,
        faces=np.where(at, soup.faces[:, ::-1], soup.faces),
        uv=np.where(at[..., None], soup.uv[:, ::-1], soup.uv),
        look=soup.look,
        looks=soup.looks,
    )


class Outside:
    """All triangles of an object, to ask which side of a surface is the outer one."""

    def __init__(self, bodies: Sequence[Body]) -> None:
        starts = np.cumsum([0, *(len(body.soup.vertices) for body in bodies)])
        vertices = np.concatenate([body.soup.vertices for body in bodies])
        faces = [b.soup.faces + start for b, start in zip(bodies, starts, strict=False)]
        self.reach = float(np.linalg.norm(np.ptp(vertices, axis=0)))
        self._scene = EmbreeScene(robust=True)
        TriangleMesh(
            self._scene, vertices.astype(np.float32), np.concatenate(faces).astype(np.int32)
        )
        self._fan = _fan()

    def facing_out(self, body: Body) -> tuple[Body, int]:
        """A shell whose pieces face where rays go further, and how many triangles were turned."""
        piece = pieces_by_edge(body.soup.faces)
        turned = np.zeros(len(piece), bool)
        certain = True
        for number in range(int(piece.max()) + 1):
            own = np.flatnonzero(piece == number)
            ahead, behind = self._ways(body.soup, own)
            certain &= abs(ahead - behind) > CERTAIN * max(ahead, behind)
            turned[own] = behind > ahead * (1.0 + CERTAIN)
        soup = _turned(body.soup, turned)
        facing = Body(soup=soup, leaf=body.leaf, closed=False, certain=certain)
        return facing, int(turned.sum())

    def _ways(self, soup: Soup, own: NDArray[np.intp]) -> tuple[float, float]:
        """Mean way of rays from the front and from the back of some triangles, m."""
        a, b, c = soup.vertices[soup.faces[own]].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        area = np.linalg.norm(normal, axis=1)
        chosen = np.argsort(-area, kind="stable")[:PROBES]
        middle = ((a + b + c) / 3.0)[chosen]
        normal = normal[chosen] / area[chosen, None]
        ways = []
        for sign in (1.0, -1.0):
            rays = _about(sign * normal, self._fan)
            start = np.repeat(middle + sign * 1e-4 * self.reach * normal, len(self._fan), axis=0)
            found = self._scene.run(
                start.astype(np.float32), rays.astype(np.float32), query="DISTANCE"
            )
            way = np.minimum(np.asarray(found, np.float64), self.reach)
            weights = np.repeat(area[chosen], len(self._fan))
            ways.append(float(np.average(way, weights=weights)))
        return ways[0], ways[1]


def _fan() -> Floats:
    """(D, 3) directions evenly over a hemisphere about z (Fibonacci), none grazing."""
    number = np.arange(DIRECTIONS) + 0.5
    height = 1.0 - 0.85 * number / DIRECTIONS
    turn = np.pi * (3.0 - np.sqrt(5.0)) * number
    flat = np.sqrt(1.0 - height * height)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), height], axis=1)


def _about(normals: Floats, fan: Floats) -> Floats:
    """(N * D, 3): the fan about each of (N, 3) unit normals."""
    helper = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    side = np.cross(normals, helper)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    frame = np.stack([side, np.cross(normals, side), normals], axis=1)
    return np.asarray((fan @ frame).reshape(-1, 3))
