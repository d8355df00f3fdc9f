"""Mesh files: triangles twice, without extent, or facing inward."""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.errors import ArtgenError, GeometryError
from artgen.core.jsonio import write_bytes
from artgen.core.mesh import Floats, TriMesh
from artgen.export.obj import hull_text
from artgen.geometry.measure import closed
from artgen.repair.change import Change, Left, Outcome
from artgen.repair.draft import Draft
from artgen.validate.meshfile import MAX_FACES, MESH_READERS
from artgen.validate.places import inside, read_capped

Faces = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class Surgery:
    """What to do to the triangles of a file.

    Attributes:
        dropped: (F,) triangles to leave out, with `twice` and `flat` of them for their reasons.
        turned: (F,) triangles to turn around.
        open: whether what is left is not closed.
        cavity: whether a piece faces inward within another, which may be meant.
    """

    dropped: Mask
    turned: Mask
    twice: int
    flat: int
    open: bool
    cavity: bool


def mended_meshes(draft: Draft) -> Iterator[Outcome]:
    """Every mesh that a visual names, mended in its file where it is not sound."""
    robot, source = draft.subject().robot, draft.source
    named: dict[Path, list[ET.Element]] = {}
    for mesh in robot.iterfind("link/visual/geometry/mesh"):
        path = inside(source.root, source.file.parent, mesh.get("filename", ""))
        named.setdefault(path, []).append(mesh)
    for path, elements in sorted(named.items()):
        yield from mended_mesh(path, elements)
    draft.save_if_changed(robot)


def mended_mesh(path: Path, elements: Sequence[ET.Element]) -> Iterator[Outcome]:
    """One mesh file and the elements that name it; an OBJ of triangles keeps all but its faces."""
    try:
        vertices, faces = _read(path)
    except (ArtgenError, ValueError, LookupError, TypeError) as error:
        yield Left(subject=path.name, why=f"cannot be read: {error}; export it anew")
        return
    found = planned(vertices, faces)
    if found.open:
        yield Left(subject=path.name, why="it has holes; closing them would be a guess")
    if found.cavity:
        yield Left(subject=path.name, why="a piece inside another faces inward; it may be a hole")
    if not (found.dropped.any() or found.turned.any()):
        return
    if not _written(path, found):
        yield _rewritten(path, elements, vertices, faces, found)
    yield from _told(path.name, found)


def _read(path: Path) -> tuple[Floats, Faces]:
    """Vertices and triangles as the file states them; an error where it states no surface."""
    vertices, faces = MESH_READERS[path.suffix.lower()](read_capped(path))
    if not 0 < len(faces) <= MAX_FACES:
        raise GeometryError(f"it has {len(faces)} triangles")
    if not (faces.min() >= 0 and faces.max() < len(vertices)):
        raise GeometryError("its triangles name vertices that are not there")
    if not np.isfinite(vertices).all():
        raise GeometryError("a vertex is not finite")
    return vertices, faces.astype(np.int64)


def _told(name: str, found: Surgery) -> Iterator[Change]:
    count = len(found.dropped)
    before, after = f"{count} triangles", f"{int((~found.dropped).sum())} triangles"
    for number, what in ((found.twice, "stood there twice"), (found.flat, "had no extent")):
        if number:
            why = f"{number} {what}"
            yield Change(subject=name, what="faces", before=before, after=after, why=why)
    if number := int(found.turned.sum()):
        before, why = f"{number} triangles facing inward", "a surface encloses a positive volume"
        yield Change(subject=name, what="winding", before=before, after="outward", why=why)


def planned(vertices: Floats, faces: Faces) -> Surgery:
    """What makes a surface sound without moving a vertex or adding a triangle; (V, 3), (F, 3).

    Vertices are compared by place, unless the surface is closed by their numbers already. Nothing
    is left out of a closed surface that would thereby be opened.
    """
    index = np.unique(vertices + 0.0, axis=0, return_inverse=True)[1].reshape(-1)
    welded = index[faces]
    a, b, c = welded.T
    flat = (a == b) | (b == c) | (c == a)
    solid = np.flatnonzero(~flat)
    key = np.sort(_told_apart(faces[solid], welded[solid]), axis=1)
    first = np.zeros(len(faces), bool)
    first[solid[np.unique(key, axis=0, return_index=True)[1]]] = True
    live = np.flatnonzero(first)
    own = _told_apart(faces[live], welded[live])
    turned = np.zeros(len(faces), bool)
    if not _closed(own):
        turned[live] = disagreeing(own)
    upright = np.where(turned[live, None], own[:, ::-1], own)
    if not _closed(upright):
        broken = _closed(welded[solid])
        kept = np.zeros(len(faces), bool)
        return _surgery(flat=flat, twice=kept if broken else ~flat & ~first, turned=kept, open=True)
    turned[live], cavity = _outward(vertices[faces[live]], turned[live], _pieces(upright))
    return _surgery(flat=flat, twice=~flat & ~first, turned=turned, cavity=cavity)


def _surgery(
    *, flat: Mask, twice: Mask, turned: Mask, open: bool = False, cavity: bool = False
) -> Surgery:
    return Surgery(
        dropped=flat | twice,
        turned=turned,
        twice=int(twice.sum()),
        flat=int(flat.sum()),
        open=open,
        cavity=cavity,
    )


def _told_apart(faces: Faces, welded: Faces) -> Faces:
    """The triangles by the numbers of the file if that closes them, so that bodies that touch stay
    apart; else by welded vertices."""
    return faces if _closed(faces) else welded


def _pieces(faces: Faces) -> NDArray[np.intp]:
    """(F,) number of the connected piece of each triangle."""
    ends = np.concatenate([faces[:, :2], faces[:, 1:]]).T
    shape = (int(faces.max()) + 1,) * 2
    graph = coo_array((np.ones(ends.shape[1], bool), tuple(ends)), shape=shape)
    label = np.asarray(connected_components(graph, directed=False)[1], np.intp)
    return np.asarray(label[faces[:, 0]])


def _closed(faces: Faces) -> bool:
    return bool(len(faces)) and closed(faces)  # type: ignore[arg-type]


def disagreeing(faces: Faces) -> Mask:
    """(F,) whether to turn each triangle so that neighbors agree.

    Each triangle stands in a graph twice, as it is and turned; an edge of two triangles joins the
    copies that agree. A triangle is turned where that copy lies in the piece's lower component.
    """
    count = len(faces)
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    owner = np.tile(np.arange(count), 3)
    undirected = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)[1].reshape(-1)
    order = np.argsort(undirected, kind="stable")
    starts = np.flatnonzero(np.diff(undirected[order], prepend=-1))
    paired = starts[np.diff(np.append(starts, len(order))) == 2]
    one, two = order[paired], order[paired + 1]
    alike = ends[one, 0] != ends[two, 0]
    shift = np.where(alike, 0, count)
    rows = np.concatenate([owner[one], owner[one] + count])
    columns = np.concatenate([owner[two] + shift, owner[two] + count - shift])
    graph = coo_array((np.ones(len(rows), bool), (rows, columns)), shape=(2 * count,) * 2)
    label = connected_components(graph, directed=False)[1]
    return np.asarray(label[:count] > label[count:])


def _outward(triangles: Floats, turned: Mask, piece: NDArray[np.intp]) -> tuple[Mask, bool]:
    """Which triangles to turn so that each piece encloses a positive volume; whether one that faces
    inward lies in the box of one that faces outward as it stands, and so is left."""
    result, boxes, inward = turned.copy(), [], []
    for number in np.unique(piece).tolist():
        own = piece == number
        corners = triangles[own] - triangles[own][0, 0]
        a, b, c = corners.transpose(1, 0, 2)
        sign = np.where(turned[own], -1.0, 1.0)
        volume = float(sign @ np.einsum("ij,ij->i", a, np.cross(b, c)))
        box = np.stack([triangles[own].min(axis=(0, 1)), triangles[own].max(axis=(0, 1))])
        if volume < 0.0:
            result[own] = ~turned[own]
        if volume < 0.0 and not turned[own].any():
            inward.append((own, box))
        elif not result[own].any():
            boxes.append(box)
    cavities = [own for own, box in inward if _within_any(box, boxes)]
    for own in cavities:
        result[own] = False
    return result, bool(cavities)


def _within_any(box: Floats, boxes: Sequence[Floats]) -> bool:
    return any((box[0] > other[0]).all() and (box[1] < other[1]).all() for other in boxes)


def _rewritten(
    path: Path, elements: Sequence[ET.Element], vertices: Floats, faces: Faces, surgery: Surgery
) -> Outcome:
    """A mesh of another format as an OBJ beside it, which the elements name from now on."""
    turned = np.where(surgery.turned[:, None], faces[:, ::-1], faces)[~surgery.dropped]
    points, index = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    mesh = TriMesh(vertices=points, faces=index.reshape(-1)[turned])
    place = path.with_name(f"{path.stem}_mended.obj")
    write_bytes(place, hull_text(mesh).encode())
    for element in elements:
        element.set("filename", element.get("filename", "").removesuffix(path.name) + place.name)
    why = "its faces are mended; materials and texture coordinates are not carried over"
    return Change(subject=path.name, what="mesh", before=path.name, after=place.name, why=why)


def _written(path: Path, surgery: Surgery) -> bool:
    """Edit the `f` lines of an OBJ of triangles; False, and nothing done, for anything else."""
    if path.suffix.lower() != ".obj":
        return False
    lines = read_capped(path).decode("utf-8").splitlines()
    faces = [number for number, line in enumerate(lines) if line.split()[:1] == ["f"]]
    if len(faces) != len(surgery.dropped) or any(len(lines[n].split()) != 4 for n in faces):
        return False
    for number, turned in zip(faces, surgery.turned.tolist(), strict=True):
        if turned:
            word, *corners = lines[number].split()
            lines[number] = " ".join([word, *reversed(corners)])
    gone = {n for n, dropped in zip(faces, surgery.dropped.tolist(), strict=True) if dropped}
    text = "\n".join(line for number, line in enumerate(lines) if number not in gone)
    write_bytes(path, f"{text}\n".encode())
    return True
