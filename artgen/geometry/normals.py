"""Face and corner normals."""

import numpy as np

from artgen.core.mesh import Floats, TriMesh

CREASE_DEG = 62.0
"""Corners round off below this angle: a bevel (45 or 30 degrees a step) and a six-sided wire look
smooth, a bare box edge stays sharp."""


def face_vectors(mesh: TriMesh) -> Floats:
    """(F, 3) outward normals, as long as the triangle's doubled area, m2."""
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    return np.asarray(np.cross(b - a, c - a))


def unit(vectors: Floats) -> Floats:
    """Each row divided by its length; zero rows stay zero."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(length > 0.0, length, 1.0))


def corner_normals(mesh: TriMesh, *, crease_deg: float = CREASE_DEG) -> Floats:
    """(F, 3, 3) unit normals a corner: area-weighted over the faces that meet there within the
    crease.

    Weighting by area keeps large flat faces flat and lets narrow bevels carry the bend ("weighted
    normals")."""
    vectors = face_vectors(mesh)
    normals = unit(vectors)
    corner_face = np.repeat(np.arange(len(mesh.faces)), 3)
    corner_vertex = mesh.faces.ravel()
    order = np.argsort(corner_vertex, kind="stable")
    valence = np.bincount(corner_vertex, minlength=len(mesh.vertices))
    first = np.concatenate([[0], np.cumsum(valence)[:-1]])
    reach = valence[corner_vertex]
    left = np.repeat(np.arange(len(corner_vertex)), reach)
    step = np.arange(len(left)) - np.repeat(np.cumsum(reach) - reach, reach)
    right = order[np.repeat(first[corner_vertex], reach) + step]
    mine, theirs = corner_face[left], corner_face[right]
    alike = np.einsum("ij,ij->i", normals[mine], normals[theirs]) >= np.cos(np.radians(crease_deg))
    total = np.stack(
        [
            np.bincount(
                left[alike], weights=vectors[theirs[alike], k], minlength=len(corner_vertex)
            )
            for k in range(3)
        ],
        axis=1,
    )
    smooth = unit(np.asarray(total, np.float64)).reshape(-1, 3, 3)
    flat = np.repeat(normals[:, None, :], 3, axis=1)
    lost = np.linalg.norm(smooth, axis=-1, keepdims=True) < 0.5
    return np.asarray(np.where(lost, flat, smooth))
