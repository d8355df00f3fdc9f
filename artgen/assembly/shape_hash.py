"""Hashes that tell objects apart: of the tree, of shapes, of looks; and of a shape whatever its
size."""

import hashlib
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from artgen.articulation.types import Joint
from artgen.core.jsonio import content_hash
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec

STEPS = 2000
"""Steps along the longest side of a box to which shapes are rounded before hashing: finer
differences are those of rounding or of a mirror image's float noise."""
DIGITS = 16


def shape_hash(mesh: TriMesh) -> str:
    """Of a shape in its own box: position and size do not matter, proportions do; left and right
    may be exchanged."""
    lower, upper = mesh.bounds
    scale = STEPS / float((upper - lower).max())
    points = (mesh.vertices - (lower + upper) / 2.0) * scale
    return min(_hashed(points), _hashed(points * (-1.0, 1.0, 1.0)))


def _hashed(points: Floats) -> str:
    grid = np.unique(np.round(points).astype(np.int32), axis=0)
    return hashlib.sha256(np.ascontiguousarray(grid).tobytes()).hexdigest()[:DIGITS]


def tree_hash(labels: Mapping[str, str], joints: Sequence[Joint], base: str) -> str:
    """Of a kinematic tree: labels of parts and kinds of joints, whatever the names and the order
    (Weisfeiler and Lehman's labels of a rooted tree, from its leaves up)."""

    def node(name: str, kind: str) -> str:
        below = sorted(node(j.child, j.type) for j in joints if j.parent == name)
        return content_hash([labels[name], kind, below])

    return node(base, "fixed")[:DIGITS]


def looks_hash(surfaces: Iterable[SurfaceSpec]) -> str:
    """Of what surfaces look like, in any order and by whatever name."""
    listed = sorted(
        content_hash([s.recipe, s.color, s.tile, dict(s.detail), s.roughness]) for s in surfaces
    )
    return content_hash(listed)[:DIGITS]


def object_hash(tree: str, shapes: Sequence[str], boxes: Sequence[Floats], looks: str) -> str:
    """Of tree, shapes with their boxes to half a millimeter, and looks together."""
    rounded = [np.round(box * STEPS).astype(int).tolist() for box in boxes]
    return content_hash([tree, sorted(zip(shapes, rounded, strict=True)), looks])[:DIGITS]
