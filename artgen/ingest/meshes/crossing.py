"""Crossing: whether the surfaces of two parts pass through each other at a pose.

Where they do, their pieces have to meet: a drawer that is pulled through its shut door. To cut them
free would let it pass.
"""

from collections.abc import Mapping

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted

DEEP = 6e-4
"""m; an edge that goes less far to either side of a triangle, or hits it nearer to its rim, only
touches it."""


class Surfaces:
    """The triangles of all parts at rest, (F, 3, 3) by name; what was asked once is remembered."""

    def __init__(self, corners: Mapping[str, Floats]) -> None:
        self._corners = corners
        self._scenes = {name: _scene(own) for name, own in corners.items()}
        self._known: dict[tuple[str, str, bytes], bool] = {}

    def cross(self, first: str, second: str, first_from_second: Floats) -> bool:
        """Whether an edge of either passes through a triangle of the other."""
        key = first, second, np.round(first_from_second, 7).tobytes()
        if key not in self._known:
            back = inverted(first_from_second)
            self._known[key] = self._pierces(second, first, first_from_second) or self._pierces(
                first, second, back
            )
        return self._known[key]

    def _pierces(self, edged: str, other: str, other_from_edged: Floats) -> bool:
        target = self._corners[other]
        lower, upper = target.min(axis=(0, 1)), target.max(axis=(0, 1))
        corners = apply(other_from_edged, self._corners[edged].reshape(-1, 3)).reshape(-1, 3, 3)
        near = ((corners.max(axis=1) > lower) & (corners.min(axis=1) < upper)).all(axis=1)
        starts = corners[near].reshape(-1, 3)
        ways = np.roll(corners[near], -1, axis=1).reshape(-1, 3) - starts
        length = np.linalg.norm(ways, axis=1)
        long = length > 2.0 * DEEP
        if not long.any():
            return False
        starts, ways, length = starts[long], ways[long] / length[long, None], length[long]
        found = self._scenes[other].run(
            starts.astype(np.float32), ways.astype(np.float32), output=True
        )
        hit = np.flatnonzero(np.asarray(found["primID"]) >= 0)
        struck = target[np.asarray(found["primID"])[hit]]
        share = np.stack([np.asarray(found[key], np.float64)[hit] for key in "uv"], axis=1)
        before = np.asarray(found["tfar"], np.float64)[hit]
        return bool(_deep(struck, share, ways[hit], before, length[hit] - before).any())


def _deep(
    struck: Floats, share: Floats, ways: Floats, before: Floats, after: Floats
) -> NDArray[np.bool_]:
    """Whether edges go deep enough to both sides of the triangles that they hit, and hit them away
    from their rims, along which touching faces lie.

    Args:
        struck: (N, 3, 3) triangles.
        share: (N, 2) weights of their second and third corner at the hit.
        ways: (N, 3) unit directions.
        before: (N,) m from the edge's start to the hit.
        after: (N,) m from the hit to the edge's end.
    """
    sides = np.roll(struck, -2, axis=1) - np.roll(struck, -1, axis=1)  # Each against its corner.
    normal = np.cross(sides[:, 0], sides[:, 1])
    area = np.linalg.norm(normal, axis=1).clip(min=1e-300)
    steep = np.abs(np.einsum("ij,ij->i", normal, ways)) / area
    weights = np.concatenate([1.0 - share.sum(axis=1, keepdims=True), share], axis=1)
    inside = weights * area[:, None] / np.linalg.norm(sides, axis=2).clip(min=1e-300)
    return np.asarray(
        (steep * np.minimum(before, after) > DEEP) & (inside.min(axis=1) > DEEP), bool
    )


def _scene(corners: Floats) -> EmbreeScene:
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, corners.astype(np.float32))
    return scene
