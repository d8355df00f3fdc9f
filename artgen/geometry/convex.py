"""Convex collision pieces: recognize boxes, prove convexity."""

import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.normals import face_vectors, unit

FLATNESS = 1e-9
"""m; float64 hulls of meter-sized parts carry about 1e-15, rounding to 1e-7 m is done after the
test."""


def as_box(mesh: TriMesh) -> tuple[Floats, Floats] | None:
    """(center, size) if the mesh is an axis-aligned cuboid, else None."""
    lower, upper = mesh.bounds
    if len(mesh.vertices) != 8:
        return None
    at_corner = (np.abs(mesh.vertices - lower) < FLATNESS) | (
        np.abs(mesh.vertices - upper) < FLATNESS
    )
    distinct = len(np.unique(mesh.vertices > (lower + upper) / 2.0, axis=0)) == 8
    if not (at_corner.all() and distinct):
        return None
    return (lower + upper) / 2.0, upper - lower


def convexity_gap(mesh: TriMesh) -> float:
    """The largest distance by which a vertex lies outside a face's plane, m; 0 for a convex
    mesh."""
    vectors = face_vectors(mesh)
    normals = unit(vectors)[np.linalg.norm(vectors, axis=1) > 1e-14]
    anchors = mesh.triangles[np.linalg.norm(vectors, axis=1) > 1e-14, 0]
    heights = mesh.vertices @ normals.T - np.einsum("ij,ij->i", anchors, normals)
    return float(max(0.0, heights.max()))
