"""Soups of bundles: ingested and assembled objects, whatever made them; colors from the atlas."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import manifold3d as m3
import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats, Ints, TriMesh
from artgen.core.surface import linear_from_srgb
from artgen.dataset.split import families_of
from artgen.export.bundle import Bundle, read_bundle
from artgen.export.layout import atlas_path
from artgen.textures.png import read_png
from model.data.soup import TOLERANCE, Soup, simplified

READ_AT = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4], [2, 2, 2]]) / 6.0
"""Where in a triangle its color is read: near each corner, and in the middle."""
ALIKE = 0.06
"""Deviation of sRGB, [0, 1], below which a body counts as being of one color."""
STEPS = 15
"""To which the colors of other bodies are rounded, a channel."""
MOST = 255
"""Colors an object; further ones become the nearest of these."""
ROUGHNESS = 0.5
"""The atlas holds colors alone."""


STATIC = "static"
"""The data set of what `artgen ingest static` makes."""


@dataclass(frozen=True, kw_only=True, eq=False)
class _Part:
    """What fills a slot: some bodies of a mesh, and the box of these, m."""

    name: str
    mesh: TriMesh
    bodies: range
    bounds: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class _Piece:
    """Triangles of one body that have one color, sRGB (3,) in [0, 1]."""

    part: int
    vertices: Floats
    faces: Ints
    color: Floats


def bundle_soup(folder: Path, *, tolerance: float = TOLERANCE) -> Soup:
    """The soup of a bundle; bodies of one color are simplified as those of seeds are.

    Raises:
        ExportError: the folder is no bundle.
    """
    bundle = read_bundle(folder)
    atlas = read_png(folder / atlas_path(bundle.asset_id)) / 255.0
    parts = list(_parts(bundle))
    pieces = [
        piece
        for k, part in enumerate(parts)
        for piece in _pieces(k, part, atlas, tolerance * bundle.radius)
    ]
    return _joined(bundle, parts, pieces)


def _parts(bundle: Bundle) -> Iterator[_Part]:
    """The parts of a bundle; those of a static mesh that was ingested are runs of bodies of its one
    rigid part, in their order, and hang on nothing."""
    source = bundle.manifest.get("source")
    static = isinstance(source, Mapping) and source.get("dataset") == STATIC
    for part in bundle.parts:
        mesh = bundle.load_mesh(part.name)
        runs = bundle.manifest["fragments"][part.name] if static else []
        if len(runs) < 2:
            yield _Part(name=part.name, mesh=mesh, bodies=range(part.bodies), bounds=part.bounds)
            continue
        for k, run in enumerate(runs):
            first, count = run["bodies"]
            bodies = range(first, first + count)
            corners = mesh.triangles[np.isin(np.asarray(mesh.body), bodies)].reshape(-1, 3)
            yield _Part(
                name=part.name if k == 0 else str(run["leaf"]),
                mesh=mesh,
                bodies=bodies,
                bounds=np.stack([corners.min(axis=0), corners.max(axis=0)]),
            )


def _pieces(number: int, part: _Part, atlas: Floats, tolerance: float) -> Iterator[_Piece]:
    mesh = part.mesh
    colors, bodies = _face_colors(mesh, atlas), np.asarray(mesh.body)
    for body in part.bodies:
        faces, own = mesh.faces[bodies == body], colors[bodies == body]
        if own.std(axis=0).max() < ALIKE:
            vertices, simple = _simplified(mesh.vertices, faces, tolerance)
            yield _Piece(part=number, vertices=vertices, faces=simple, color=own.mean(axis=0))
            continue
        rounded = np.rint(own * STEPS) / STEPS
        shades, index = np.unique(rounded, axis=0, return_inverse=True)
        for k, shade in enumerate(shades):
            some = faces[index.reshape(-1) == k]
            yield _Piece(part=number, vertices=mesh.vertices, faces=some, color=shade)


def _face_colors(mesh: TriMesh, atlas: Floats) -> Floats:
    """(F, 3) sRGB mean of what the atlas shows on a triangle; a mesh without atlas is gray."""
    if mesh.atlas is None:
        return np.full((len(mesh.faces), 3), 0.5)
    height, width = atlas.shape[:2]
    places = np.einsum("sk,fkc->sfc", READ_AT, mesh.atlas)
    column = np.clip((places[..., 0] * width).astype(int), 0, width - 1)
    row = np.clip(((1.0 - places[..., 1]) * height).astype(int), 0, height - 1)
    found: Floats = atlas[row, column].mean(axis=0)
    return found


def _simplified(vertices: Floats, faces: Ints, tolerance: float) -> tuple[Floats, Ints]:
    """Fewer triangles of a closed body; what manifold3d does not take stays as it is."""
    own = np.array(vertices), faces.astype(np.uint64, order="C")  # Frozen ones are refused.
    solid = m3.Manifold(m3.Mesh64(*own))
    if solid.status() != m3.Error.NoError or solid.is_empty():
        return vertices, faces
    mesh = simplified(solid, tolerance).to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, np.int32)


def _joined(bundle: Bundle, parts: Sequence[_Part], pieces: list[_Piece]) -> Soup:
    looks, surface = _palette(np.stack([piece.color for piece in pieces]))
    compact = [_used(piece) for piece in pieces]
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in compact])
    counts = [len(faces) for _, faces in compact]
    return Soup(
        asset_id=bundle.asset_id,
        category=bundle.category,
        parts=tuple(part.name for part in parts),
        joints=bundle.joints,
        preconditions=bundle.preconditions,
        donors=families_of(bundle.manifest),
        bounds=np.stack([part.bounds for part in parts]),
        center=bundle.center,
        radius=bundle.radius,
        vertices=np.concatenate([vertices for vertices, _ in compact]).astype(np.float32),
        faces=np.concatenate([f + start for (_, f), start in zip(compact, starts, strict=False)]),
        part=np.repeat([piece.part for piece in pieces], counts),
        body=np.repeat(np.arange(len(pieces)), counts),
        surface=np.repeat(surface, counts),
        looks=looks,
    )


def _used(piece: _Piece) -> tuple[Floats, Ints]:
    """The vertices that the faces name, and faces that name them anew."""
    kept, index = np.unique(piece.faces, return_inverse=True)
    return piece.vertices[kept], index.reshape(-1, 3).astype(np.int32)


def _palette(colors: Floats) -> tuple[NDArray[np.float32], NDArray[np.intp]]:
    """Rows of `Soup.looks`, and the row of each color."""
    rounded = np.rint(colors * 255.0) / 255.0
    shades, index, uses = np.unique(rounded, axis=0, return_inverse=True, return_counts=True)
    kept = np.sort(np.argsort(-uses, kind="stable")[:MOST])
    nearest = np.linalg.norm(shades[:, None] - shades[kept], axis=2).argmin(axis=1)
    looks = np.zeros((len(kept), 6), np.float32)
    looks[:, :3] = np.vectorize(linear_from_srgb)(shades[kept])
    looks[:, 3] = ROUGHNESS
    return looks, nearest[index.reshape(-1)]
