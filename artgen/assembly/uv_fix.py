"""Texture coordinates corrected after unequal scaling: as dense as before, grain as it ran.

A chart is a connected piece of surface of one material on which texture runs on without a seam and
which turns by less than 30 degrees from triangle to triangle. Where a chart was laid out by one
linear map of space (flat charts, box projections with their rounded edges) the correction is exact:
the same map lays out the new chart. Elsewhere u and v are each rescaled about the chart's middle by
the ratio of their mean gradients.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.conventions import UV_DECIMALS
from artgen.core.mesh import Floats, Ints, TriMesh

SPLIT = np.cos(np.radians(30.0))
"""Neighbors whose normals turn further belong to two charts."""
SEAM = 1e-5
"""m; coordinates of one corner that differ by more are a seam."""
THIN = 1e-5
"""A chart thinner than this share of its size is flat: what vertices stand out is rounding."""
LINEAR = 2e-5
"""m; UV are rounded to 1e-6 m and vertices to 1e-7 m, and a plane is fitted through them."""
Labels = NDArray[np.int64]


def fixed_uv(mesh: TriMesh, vertices: Floats, *, mirrored: bool) -> Floats:
    """(F, 3, 2) UV for a mesh whose vertices were moved to `vertices`; `mesh` keeps the old ones.

    Args:
        mesh: with UV before the move; winding as after it.
        vertices: (V, 3) after the move, m.
        mirrored: the move swaps left and right; u is negated, so that images are not reversed.
    """
    uv = np.asarray(mesh.uv)
    label = charts(mesh)
    before, moved = mesh.triangles, vertices[mesh.faces]
    if mirrored:
        before = before * (-1.0, 1.0, 1.0)
    fixed = _rescaled(before, moved, uv, label)
    order = np.argsort(label, kind="stable")
    ends = np.searchsorted(label[order], np.arange(int(label.max()) + 2))
    for first, last in pairwise(ends.tolist()):
        own = order[first:last]
        laid = _laid_out(before[own], moved[own], uv[own])
        if laid is not None:
            fixed[own] = laid
    if mirrored:
        fixed = fixed * (-1.0, 1.0)
    return np.round(fixed, UV_DECIMALS) + 0.0


def charts(mesh: TriMesh) -> Labels:
    """(F,) number of the chart that each triangle belongs to."""
    faces, uv = mesh.faces, np.asarray(mesh.uv)
    normals = unit_normals(mesh.triangles)
    start, end = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    owner, corner = np.repeat(np.arange(len(faces)), 3), np.tile(np.arange(3), len(faces))
    key = np.minimum(start, end).astype(np.int64) * (int(faces.max()) + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    same = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    one, other = order[same], order[same + 1]
    a, b = owner[one], owner[other]
    smooth = np.einsum("ij,ij->i", normals[a], normals[b]) > SPLIT
    smooth &= np.asarray(mesh.slot)[a] == np.asarray(mesh.slot)[b]
    ends = [
        (uv[a, corner[one]], uv[a, (corner[one] + 1) % 3]),
        (uv[b, corner[other]], uv[b, (corner[other] + 1) % 3]),
    ]
    swapped = (start[one] != start[other])[:, None]
    first = np.where(swapped, ends[1][1], ends[1][0])
    second = np.where(swapped, ends[1][0], ends[1][1])
    gap = np.maximum(np.abs(ends[0][0] - first), np.abs(ends[0][1] - second)).max(axis=1)
    joined = smooth & (gap < SEAM)
    graph = coo_array(
        (np.ones(int(joined.sum()), bool), (a[joined], b[joined])), shape=(len(faces), len(faces))
    )
    return np.asarray(connected_components(graph, directed=False)[1], np.int64)


def unit_normals(triangles: Floats) -> Floats:
    """(F, 3) of (F, 3, 3) triangles; zero where one has no area."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(cross, axis=1, keepdims=True)
    return np.asarray(cross / np.where(length > 0.0, length, 1.0))


def areas(triangles: Floats) -> Floats:
    """(F,) m2."""
    a, b, c = triangles.transpose(1, 0, 2)
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0)


def gradients(triangles: Floats, uv: Floats) -> Floats:
    """(F, 2, 3) gradients of u and of v along the surface, per m; zero for triangles of no area."""
    first, second = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    along, across = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    e, f, g = _forms(first, second)
    det = e * g - f * f
    det = np.where(det > 0.0, det, np.inf)
    p = (along * g[:, None] - across * f[:, None]) / det[:, None]
    q = (across * e[:, None] - along * f[:, None]) / det[:, None]
    return np.asarray(p[:, :, None] * first[:, None] + q[:, :, None] * second[:, None])


def _forms(one: Floats, other: Floats) -> tuple[Floats, Floats, Floats]:
    """Inner products of rows: one with itself, one with the other, the other with itself."""
    pairs = ((one, one), (one, other), (other, other))
    e, f, g = (np.einsum("ij,ij->i", p, q) for p, q in pairs)
    return e, f, g


def singular_values(triangles: Floats, uv: Floats) -> Floats:
    """(F, 2) of the map from the surface to UV, larger first: 1 and 1 where lengths are kept."""
    u, v = gradients(triangles, uv).transpose(1, 0, 2)
    e, f, g = _forms(u, v)
    middle, half = (e + g) / 2.0, np.hypot((e - g) / 2.0, f)
    return np.sqrt(np.stack([middle + half, (middle - half).clip(min=0.0)], axis=1))


def _rescaled(before: Floats, after: Floats, uv: Floats, label: Labels) -> Floats:
    """u and v of each chart times the ratio of their mean gradients, about the chart's middle."""
    weight = areas(after)
    count = int(label.max()) + 1
    total = np.bincount(label, weights=weight, minlength=count).clip(min=1e-300)
    old, new = (np.linalg.norm(gradients(t, uv), axis=2) for t in (before, after))
    fixed = uv.copy()
    for k in range(2):
        was = np.bincount(label, weights=weight * old[:, k], minlength=count)
        now = np.bincount(label, weights=weight * new[:, k], minlength=count)
        ratio = np.where(now > 0.0, was / np.where(now > 0.0, now, 1.0), 1.0)
        sums = np.bincount(label, weights=weight * uv[:, :, k].mean(axis=1), minlength=count)
        middle = sums / total
        fixed[:, :, k] = middle[label][:, None] + (
            (uv[:, :, k] - middle[label][:, None]) * ratio[label][:, None]
        )
    return fixed


def _laid_out(before: Floats, after: Floats, uv: Floats) -> Floats | None:
    """(F, 3, 2) UV of a chart that was laid out by a linear map of space, as flat charts are and
    those seen along an axis; None where it was not. The gradients of that map are kept; they turn
    as the chart as a whole turns."""
    points, values = before.reshape(-1, 3), uv.reshape(-1, 2)
    origin, value = points.mean(axis=0), values.mean(axis=0)
    slope = np.linalg.lstsq(points - origin, values - value, rcond=THIN)[0]
    if np.abs((points - origin) @ slope + value - values).max() > LINEAR:
        return None
    turn = _least_turn(_facing(before), _facing(after))
    start = after.reshape(-1, 3).mean(axis=0)
    return np.asarray((after - start) @ (turn @ slope) + value)


def _facing(triangles: Floats) -> Floats:
    """(3,) unit mean normal by area."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    total = cross.sum(axis=0)
    return np.asarray(total / max(float(np.linalg.norm(total)), 1e-300))


def _least_turn(start: Floats, end: Floats) -> Floats:
    """(3, 3) least rotation that takes one unit vector to another, not opposite, one."""
    cross, cos = np.cross(start, end), float(start @ end)
    skew = np.array([[0, -cross[2], cross[1]], [cross[2], 0, -cross[0]], [-cross[1], cross[0], 0]])
    return np.asarray(np.eye(3) + skew + skew @ skew / (1.0 + cos))


def quarter_turned(mesh: TriMesh, faces: Ints) -> Floats:
    """(F, 3, 2) UV with the grain of some faces turned by 90 degrees."""
    uv = np.array(mesh.uv)
    uv[faces] = np.stack([uv[faces, :, 1], -uv[faces, :, 0]], axis=-1)
    return uv
