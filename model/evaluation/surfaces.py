"""Distances between surfaces: Chamfer, F-score and normals, from points spread evenly over them.

Lengths are those of the true object's longest side at rest, unless stated otherwise: F at 1 % of
the side of the volume is what Tatarchenko et al. (CVPR 2019) ask for.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from model.evaluation.layout import Layout

THRESHOLDS = (0.01, 0.02, 0.05)


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points (N, 3) on a surface and its unit normals (N, 3) there."""

    points: Floats
    normals: Floats


@dataclass(frozen=True, kw_only=True)
class SurfaceScores:
    """How near two surfaces are.

    Attributes:
        chamfer_l1: mean distance from the predicted to the true surface plus back.
        chamfer_squared: the same of squared distances, as PyTorch3D's `chamfer_distance`.
        accuracy: mean distance from the predicted to the true surface.
        completeness: mean distance from the true to the predicted surface.
        f_scores: harmonic mean of the shares nearer than each of `THRESHOLDS`, both ways.
        normals: mean |cosine| of normals at nearest points, both ways (Mescheder et al. 2019).
    """

    chamfer_l1: float
    chamfer_squared: float
    accuracy: float
    completeness: float
    f_scores: tuple[float, ...]
    normals: float


def sampled(triangles: Floats, count: int, rng: np.random.Generator) -> Cloud:
    """`count` points spread evenly over (F, 3, 3) triangles, with the triangles' normals."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    doubled = np.linalg.norm(cross, axis=1)
    heap = np.cumsum(doubled)
    chosen = np.searchsorted(heap, rng.random(count) * heap[-1], side="right")
    chosen = chosen.clip(max=len(triangles) - 1)
    u, v = rng.random((2, count, 1))
    over = u + v > 1.0  # The other half of the parallelogram, folded back.
    u, v = np.where(over, 1.0 - u, u), np.where(over, 1.0 - v, v)
    a, b, c = triangles[chosen].transpose(1, 0, 2)
    normals = cross[chosen] / doubled[chosen, None].clip(min=1e-300)
    return Cloud(a + u * (b - a) + v * (c - a), normals)


def posed_triangles(layout: Layout, poses: Floats, parts: Sequence[int] | None = None) -> Floats:
    """(F, 3, 3) triangles of some parts (all if None) at poses (P, 4, 4)."""
    wanted = range(len(layout)) if parts is None else parts
    own = [
        apply(poses[k], mesh.triangles)
        for k in wanted
        if layout.meshes and isinstance(mesh := layout.meshes[k], TriMesh)
    ]
    return np.concatenate(own) if own else np.zeros((0, 3, 3))


def has_surface(layout: Layout) -> bool:
    """Whether any part has one."""
    return any(mesh is not None for mesh in layout.meshes)


def compared(predicted: Cloud, true: Cloud) -> SurfaceScores:
    """Scores of two clouds."""
    forward, at_true = cKDTree(true.points).query(predicted.points)
    backward, at_predicted = cKDTree(predicted.points).query(true.points)
    cosines = (
        np.abs(np.einsum("ij,ij->i", predicted.normals, true.normals[at_true])).mean(),
        np.abs(np.einsum("ij,ij->i", true.normals, predicted.normals[at_predicted])).mean(),
    )
    return SurfaceScores(
        chamfer_l1=float(forward.mean() + backward.mean()),
        chamfer_squared=float((forward**2).mean() + (backward**2).mean()),
        accuracy=float(forward.mean()),
        completeness=float(backward.mean()),
        f_scores=tuple(_f_score(forward, backward, limit) for limit in THRESHOLDS),
        normals=float(np.mean(cosines)),
    )


def _f_score(forward: Floats, backward: Floats, limit: float) -> float:
    precision, recall = float((forward < limit).mean()), float((backward < limit).mean())
    return 2.0 * precision * recall / (precision + recall) if precision + recall > 0.0 else 0.0


def chamfer_squared(first: Floats, second: Floats) -> float:
    """Mean squared distance to the nearest point, both ways added, of (N, 3) and (M, 3) points."""
    forward, _ = cKDTree(second).query(first)
    backward, _ = cKDTree(first).query(second)
    return float((forward**2).mean() + (backward**2).mean())
