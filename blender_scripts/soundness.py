"""Whether a body that Blender returned is still a body, and mending of collapsed triangles."""

import numpy as np

from artgen.core.mesh import Floats, Ints
from artgen.geometry.measure import moments, welded

DECIMALS = 7
"""Finished vertices are rounded to 1e-7 m; a body must survive that."""
LEAST_VOLUME_KEPT = 0.6
"""A bevel that clamps itself to the body still keeps more than this: a cube rounded to a ball keeps
pi / 6 = 0.52, which no design asks for."""
LEAST_HEIGHT = 5e-7
"""m; a triangle flatter than this has no dependable normal once rounded to 1e-7 m."""
PASSES = 10
"""A row of corners on one side is undone one corner a pass."""
SLACK = 0.01
"""Share of the radius by which a bevel may leave the old bounds, at corners of slanted edges."""

Body = tuple[Floats, Ints]


def is_sound(body: Body, vertices: Floats, faces: Ints, radius: float) -> bool:
    """True when `body` is a closed, outward 2-manifold of proper triangles that still fills the
    sharp body it came from, and stays one after rounding to 1e-7 m."""
    if len(body[1]) < 4 or not np.isfinite(body[0]).all():
        return False
    points, triangles = welded(np.round(body[0], DECIMALS), body[1])
    if not (is_manifold(body[1]) and is_manifold(triangles)):
        return False
    outside = np.maximum(points.max(axis=0) - vertices.max(axis=0), 0.0)
    outside = np.maximum(outside, vertices.min(axis=0) - points.min(axis=0))
    if heights(points[triangles]).min() < LEAST_HEIGHT:
        return False
    old, new = moments(vertices[faces]).volume, moments(points[triangles]).volume
    return bool(
        outside.max() <= SLACK * radius and LEAST_VOLUME_KEPT * old < new <= old * (1.0 + 1e-5)
    )


def without_caps(points: Floats, faces: Ints) -> Ints:
    """Triangles with the collapsed ones, whose three corners lie on a line, turned into their
    neighbors by flipping their longest edge.

    They arise where a polygon has a corner on a straight side; the shape does not change.
    """
    triangles: list[list[int]] = faces.tolist()
    for _ in range(PASSES):
        flat = np.flatnonzero(heights(points[np.array(triangles)]) < 2.0 * LEAST_HEIGHT)
        if len(flat) == 0:
            break
        owner = {
            edge: k for k, (a, b, c) in enumerate(triangles) for edge in ((a, b), (b, c), (c, a))
        }
        done: set[int] = set()
        for k in flat.tolist():
            u, v, middle = _longest_first(points, triangles[k])
            other = owner.get((v, u), k)
            if other == k or done & {k, other}:
                continue
            (far,) = set(triangles[other]) - {u, v}
            if {(middle, far), (far, middle)} & owner.keys():
                continue
            triangles[k], triangles[other] = [u, far, middle], [far, v, middle]
            done |= {k, other}
    return np.array(triangles, np.int32)


def _longest_first(points: Floats, triangle: list[int]) -> tuple[int, int, int]:
    """The corners, turned so that the first two span the longest side."""
    a, b, c = triangle
    turns = ((a, b, c), (b, c, a), (c, a, b))
    return max(turns, key=lambda t: float(np.linalg.norm(points[t[0]] - points[t[1]])))


def heights(corners: Floats) -> Floats:
    """(F,) height over the longest side of (F, 3, 3) triangles, m; 0 for a point."""
    a, b, c = corners.transpose(1, 0, 2)
    doubled = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    longest = np.linalg.norm(np.stack([b - a, c - b, a - c]), axis=2).max(axis=0)
    return np.asarray(doubled / np.where(longest > 0.0, longest, 1.0))


def is_manifold(faces: Ints) -> bool:
    """True when every edge is used once in each direction."""
    if len(faces) == 0:
        return False
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    size = int(edges.max()) + 1
    forth, back = np.sort(edges @ (size, 1)), np.sort(edges @ (1, size))
    return bool((np.diff(forth) > 0).all() and np.array_equal(forth, back))
