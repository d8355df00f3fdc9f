"""How alike the shapes of a category are: the nearest neighbor of every object."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.coverage_study.drawn import Drawn
from artgen.coverage_study.views import MISS

STEP = 0.005
"""Share of a map's side by which depths must differ to count: a quarter of a pixel."""
TWIN = 0.01
"""Share of differing pixels up to which two objects are called twins: a handle is more."""


@dataclass(frozen=True, kw_only=True)
class Neighbour:
    """The nearest other object of one object.

    Attributes:
        index: of the object.
        other: of its nearest neighbor.
        differing: share of the pixels of both objects, over all maps, in which they differ.
    """

    category: str
    index: int
    other: int
    differing: float

    @property
    def twin(self) -> bool:
        """Whether hardly a difference in shape is seen."""
        return self.differing <= TWIN


def neighbours(objects: Sequence[Drawn]) -> list[Neighbour]:
    """The nearest neighbor of every object among all others of the sequence."""
    views = np.stack([drawn.views.ravel() for drawn in objects])
    found = []
    for k, drawn in enumerate(objects):
        shares = differing(views[k], views)
        shares[k] = np.inf
        best = int(np.argmin(shares))
        found.append(
            Neighbour(
                category=drawn.category,
                index=drawn.index,
                other=objects[best].index,
                differing=float(shares[best]),
            )
        )
    return found


def differing(one: NDArray[np.float32], others: NDArray[np.float32]) -> NDArray[np.float64]:
    """(N,) share of pixels that show (P,) or (N, P) or both, in which their depths differ."""
    seen = (others != MISS) | (one != MISS)
    apart = np.abs(others - one) > STEP
    return np.asarray((apart & seen).sum(axis=1) / np.maximum(seen.sum(axis=1), 1), np.float64)
