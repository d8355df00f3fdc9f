"""Meshes from strangers: OBJ, STL, and what trimesh reads from memory, as closed bodies."""

import io
import struct
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints, TriMesh
from artgen.geometry.measure import open_edges
from artgen.validate.places import read_capped

MAX_FACES = 1_000_000
Soup = tuple[Floats, Ints]
"""(V, 3) vertices and (F, 3) triangles."""


def read_mesh(path: Path, scale: Floats) -> TriMesh:
    """The triangles of a file, times `scale`, welded where vertices are equal.

    Each connected piece of surface is a body, bodies in the order of their first vertex.

    Raises:
        GeometryError: the format is not read here, or the file is cut short, ragged or empty.
        ExportError: it is too large.
        OSError: it cannot be opened.
    """
    reader = MESH_READERS.get(path.suffix.lower())
    if reader is None:
        known = ", ".join(sorted(MESH_READERS))
        raise GeometryError(f"{path.name}: {path.suffix or 'no suffix'} is not read; {known} are")
    try:
        vertices, faces = reader(read_capped(path))
    except GeometryError as error:
        raise GeometryError(f"{path.name}: {error}") from error
    except (ValueError, IndexError, KeyError, TypeError, AttributeError, struct.error) as error:
        raise GeometryError(f"{path.name}: cannot be read: {error!r}") from error
    if len(faces) > MAX_FACES:
        raise GeometryError(f"{path.name}: {len(faces)} triangles are more than {MAX_FACES}")
    return as_bodies(vertices * scale, faces if np.prod(scale) > 0.0 else faces[:, ::-1])


def as_bodies(vertices: Floats, faces: Ints) -> TriMesh:
    """Equal vertices merged if that closes it, collapsed triangles dropped, a body a connected
    piece.

    Raises:
        GeometryError: no triangle is left, or a vertex is missing or not finite.
    """
    if len(faces) and not (faces.min() >= 0 and faces.max() < len(vertices)):
        raise GeometryError(f"a face names vertex {int(faces.max())} of {len(vertices)}")
    merged = _distinct(faces.astype(np.int64))
    if open_edges(
        merged.astype(np.int32)
    ):  # Where it is closed as it stands, bodies that touch stay apart.
        rows = np.ascontiguousarray(vertices + 0.0).view([("", np.float64)] * 3)[:, 0]
        _, first, index = np.unique(rows, return_index=True, return_inverse=True)
        merged, vertices = _distinct(index.reshape(-1)[merged]), vertices[first]
    ends = np.concatenate([merged[:, :2], merged[:, 1:]]).T
    graph = coo_array((np.ones(ends.shape[1], bool), tuple(ends)), shape=(len(vertices),) * 2)
    _, piece = connected_components(graph, directed=False)
    used = np.unique(merged)
    used = used[np.argsort(piece[used], kind="stable")]
    place = np.full(len(vertices), -1)
    place[used] = np.arange(len(used))
    owner = piece[merged[:, 0]]
    order = np.argsort(owner, kind="stable")
    body = np.unique(owner[order], return_inverse=True)[1].reshape(-1)
    if body[-1] > np.iinfo(np.int16).max:
        raise GeometryError(f"its surface falls into {body[-1] + 1} pieces; weld it")
    return TriMesh(vertices=vertices[used], faces=place[merged[order]], body=body)


def _distinct(faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Triangles of three different vertices; GeometryError where there is none."""
    a, b, c = faces.T
    kept = faces[(a != b) & (b != c) & (c != a)]
    if not len(kept):
        raise GeometryError("it has no triangle")
    return kept


def _read_obj(data: bytes) -> Soup:
    """Vertices and faces of any OBJ; polygons become fans, lines and normals are passed over."""
    vertices: list[list[float]] = []
    faces: list[tuple[int, int, int]] = []
    for line in data.decode("utf-8", "replace").replace("\\\n", " ").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words[0] == "f":
            corners = [_corner(word, len(vertices)) for word in words[1:]]
            faces += [(corners[0], *pair) for pair in pairwise(corners[1:])]
    return np.array(vertices, float).reshape(-1, 3), np.array(faces, np.int32).reshape(-1, 3)


def _corner(word: str, count: int) -> int:
    """Zero-based vertex of `v`, `v/vt` or `v/vt/vn`; negative numbers count from the last."""
    number = int(word.partition("/")[0])
    if number == 0:
        raise GeometryError("a face names vertex 0; OBJ counts from 1")
    return number - 1 if number > 0 else count + number


STL_HEADER, STL_FACE = 84, 50


def _read_stl(data: bytes) -> Soup:
    """Binary or ASCII STL; which one is told by the length, as headers of both may say `solid`."""
    if len(data) >= STL_HEADER:
        (count,) = struct.unpack_from("<I", data, 80)
        if len(data) == STL_HEADER + STL_FACE * count:
            rows = np.frombuffer(data, np.uint8, offset=STL_HEADER).reshape(count, STL_FACE)
            corners = rows[:, 12:48].copy().view("<f4").astype(np.float64).reshape(-1, 3)
            return corners, np.arange(3 * count, dtype=np.int32).reshape(-1, 3)
    if not data.lstrip().startswith(b"solid"):
        raise GeometryError("neither a binary STL of its stated length nor an ASCII one")
    words = data.split()
    places = [i for i, word in enumerate(words) if word == b"vertex"]
    corners = np.array([words[i + 1 : i + 4] for i in places], np.float64).reshape(-1, 3)
    if len(corners) % 3:
        raise GeometryError(f"{len(corners)} corners make no whole triangles")
    return corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3)


def _by_trimesh(kind: str) -> Callable[[bytes], Soup]:
    """A reader that hands the bytes, and no way to other files, to trimesh."""

    def read(data: bytes) -> Soup:
        try:
            loaded = trimesh.load_mesh(io.BytesIO(data), file_type=kind, process=False)
        except Exception as error:  # trimesh passes on whatever its many parsers raise.
            raise GeometryError(f"trimesh cannot read it: {error!r}") from error
        vertices: NDArray[np.float64] = np.asarray(loaded.vertices, np.float64)
        return vertices, np.asarray(loaded.faces, np.int32)

    return read


MESH_READERS: Mapping[str, Callable[[bytes], Soup]] = {
    ".obj": _read_obj,
    ".stl": _read_stl,
    ".glb": _by_trimesh("glb"),
    ".ply": _by_trimesh("ply"),
    ".off": _by_trimesh("off"),
}
