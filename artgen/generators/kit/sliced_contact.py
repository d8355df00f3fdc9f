"""Boxes that stand for a wall between two smooth outlines, cut into slices along y."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, slab

THIN = 0.004
"""m; thinner boxes are left out."""


def half_width(outline: Floats, y: Floats) -> Floats:
    """Half the width (N,) at each y (N,) of a convex outline that is its own mirror image in x."""
    right = outline[outline[:, 0] >= -1e-12]
    order = np.argsort(right[:, 1], kind="stable")
    return np.interp(y, right[order, 1], right[order, 0], left=0.0, right=0.0)


def sliced_wall(
    outer: Sequence[Floats],
    inner: Sequence[Floats],
    *,
    z: tuple[float, float],
    cuts: Sequence[float],
) -> tuple[Solid, ...]:
    """Boxes between z[0] and z[1] that lie inside all `outer` outlines and outside all `inner`.

    Args:
        outer: outlines of the outside at the heights of this layer.
        inner: outlines of the hollow; none for a solid layer.
        cuts: y where one slice ends and the next begins, rising.
    """
    boxes = []
    for y0, y1 in pairwise(cuts):
        far = min(float(half_width(ring, _places(ring, y0, y1)).min()) for ring in outer)
        near = max(
            (float(half_width(ring, _places(ring, y0, y1)).max()) for ring in inner), default=0.0
        )
        if far - near < THIN:
            continue
        if near < THIN:
            boxes.append(slab((-far, y0, z[0]), (far, y1, z[1])))
            continue
        boxes.append(slab((-far, y0, z[0]), (-near, y1, z[1])))
        boxes.append(slab((near, y0, z[0]), (far, y1, z[1])))
    return tuple(boxes)


def _places(outline: Floats, y0: float, y1: float) -> Floats:
    """Where the width of an outline may be extreme between y0 and y1: its corners and both ends."""
    ys = outline[:, 1]
    return np.array([y0, *ys[(ys > y0) & (ys < y1)], y1])
