"""Repair of what rounding vertices to the grid can leave behind."""

import manifold3d as m3
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints

FLAT = 2e-14
"""m2, twice the area of half a square of the grid's step, 1e-7 m."""


CRUMB = 1e-11
"""m3; a cube of 0.2 mm. Booleans of nearly equal surfaces leave slivers of 1e-20 to 1e-12."""

BUBBLE = 1e-10
"""m3; a hollow smaller than a cube of 0.5 mm is a sliver that came out inside out, or might be."""


def without_crumbs(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """A closed surface less its pieces of next to no volume, which no eye sees and which, once
    rounded, wind either way; a surface that is all crumbs, or has none, is returned as it is."""
    links = coo_array(
        (np.ones(2 * len(faces)), (np.repeat(faces[:, 0], 2), faces[:, 1:].ravel())),
        shape=(len(vertices), len(vertices)),
    )
    count, label = connected_components(links, directed=False)
    if count == 1:
        return vertices, faces
    piece = label[faces[:, 0]]
    a, b, c = (vertices[faces] - vertices[0]).transpose(1, 0, 2)
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
    size = np.bincount(piece, weights=volumes, minlength=count)
    kept = faces[((size > CRUMB) | (size < -BUBBLE))[piece]]
    if len(kept) in (0, len(faces)):
        return vertices, faces
    used, index = np.unique(kept, return_inverse=True)
    return vertices[used], index.reshape(-1, 3).astype(faces.dtype)


def without_flat_triangles(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """The same closed surface on the same vertices without triangles of no area.

    Rounding can put three neighbors on one line. Dropping their triangle would open the surface, so
    manifold3d flips its long edge. A surface without such triangles is returned as it is.

    Raises:
        GeometryError: the surface is not closed.
    """
    a, b, c = vertices[faces].transpose(1, 0, 2)
    if np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > FLAT:
        return vertices, faces
    mended = m3.Manifold(m3.Mesh64(np.array(vertices), faces.astype(np.uint64)))
    if mended.status() != m3.Error.NoError:
        raise GeometryError(
            f"a mesh with flat triangles cannot be mended, manifold3d says {mended.status().name}; "
            "check that its solid is closed"
        )
    mesh = mended.to_mesh64()
    return np.array(mesh.vert_properties)[:, :3], np.array(mesh.tri_verts).astype(np.int32)
