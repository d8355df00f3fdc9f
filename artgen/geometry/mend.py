"""Repair of what rounding vertices to the grid can leave behind."""

import manifold3d as m3
import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints

FLAT = 2e-14
"""m2, twice the area of half a square of the grid's step, 1e-7 m."""


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
