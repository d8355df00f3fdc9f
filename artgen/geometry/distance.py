"""How far points lie from a mesh, and whether inside of it."""

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats, TriMesh


def nearest_distance(triangles: Floats, point: Floats) -> float:
    """From a point to the nearest of (T, 3, 3) triangles, m (Ericson 2005, section 5.1.5)."""
    a, b, c = triangles.transpose(1, 0, 2)
    best = min(_edge_distance(p, q, point).min() for p, q in ((a, b), (b, c), (c, a)))
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1).clip(min=1e-300)
    height = np.einsum("ij,ij->i", point - a, normal) / area
    foot = point - height[:, None] * normal / area[:, None]
    over = np.ones(len(a), bool)
    for p, q in ((a, b), (b, c), (c, a)):
        over &= np.einsum("ij,ij->i", np.cross(q - p, foot - p), normal) >= 0.0
    return float(min(best, np.abs(height[over]).min(initial=np.inf)))


def _edge_distance(start: Floats, end: Floats, point: Floats) -> Floats:
    """(N,) from a point to segments."""
    way = end - start
    length = np.einsum("ij,ij->i", way, way).clip(min=1e-300)
    share = (np.einsum("ij,ij->i", point - start, way) / length).clip(0.0, 1.0)
    return np.asarray(np.linalg.norm(start + share[:, None] * way - point, axis=1))


def inside_bodies(mesh: TriMesh, points: Floats) -> NDArray[np.bool_]:
    """(N,) whether points lie inside any closed body of a mesh, by its solid angle."""
    inside = np.zeros(len(points), bool)
    lower, upper = mesh.bounds
    for index, point in enumerate(points):
        if ((point < lower) | (point > upper)).any():
            continue
        turns = np.bincount(np.asarray(mesh.body), weights=turns_of(mesh.triangles, point))
        inside[index] = bool((turns > 0.5).any())
    return inside


def turns_about(points: Floats, triangles: Floats) -> Floats:
    """(N,) how often closed surfaces of (T, 3, 3) triangles go around points."""
    return np.array([turns_of(triangles, point).sum() for point in points])


def turns_of(triangles: Floats, point: Floats) -> Floats:
    """(T,) share of a full turn about a point that each of (T, 3, 3) triangles fills: its solid
    angle over 4 pi (van Oosterom and Strackee 1983)."""
    a, b, c = (triangles - point).transpose(1, 0, 2)
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    over = np.einsum("ij,ij->i", a, np.cross(b, c))
    under = la * lb * lc + (
        np.einsum("ij,ij->i", a, b) * lc
        + np.einsum("ij,ij->i", b, c) * la
        + np.einsum("ij,ij->i", c, a) * lb
    )
    return np.asarray(np.arctan2(over, under) / (2.0 * np.pi))
