"""Bars and tubes of a chair's side, drawn in the plane (y, z) beside it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from artgen.core.mesh import Floats
from artgen.generators.kit.bent_strip import bent_strip
from artgen.generators.kit.fold_linkage import Point
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Solid, hull, slab, wire

FLOOR = slab((-5.0, -5.0, 0.0), (5.0, 5.0, 5.0))
"""All that lies above the floor."""


@dataclass(frozen=True, kw_only=True)
class Member:
    """The section of a leg.

    Attributes:
        thick: across the chair (x), m.
        deep: in the plane of its side, m.
        round: a tube, as thick as deep; else a bar.
    """

    thick: float
    deep: float
    round: bool

    def solid(self, path: Sequence[Point], x: float, *, bend: float) -> Solid:
        """Along a path with its middle at x, cut off at the floor."""
        if not self.round:
            bar = bent_strip(path, bend=bend, thickness=self.deep, width=self.thick, across="x")
            return bar.at(x=x) & FLOOR
        points = bent([(x, y, z) for y, z in path], bend)
        return wire(points, self.deep / 2.0, sides=12) & FLOOR

    def contact(self, path: Sequence[Point], x: float) -> tuple[Solid, ...]:
        """A convex piece for each leg of the path."""
        return tuple(self._leg(np.array(a), np.array(b), x) & FLOOR for a, b in pairwise(path))

    def _leg(self, a: Floats, b: Floats, x: float) -> Solid:
        along = (b - a) / np.linalg.norm(b - a)
        share = 0.82 if self.round else 1.0
        side = share * self.deep / 2.0 * np.array((-along[1], along[0]))
        half = share * self.thick / 2.0
        corners = [
            (x + t * half, *(p + s * side)) for p in (a, b) for s in (-1, 1) for t in (-1, 1)
        ]
        return hull(corners)

    def foot(self, top: Point, along: Floats, x: float, *, wall: float) -> tuple[Solid, Solid]:
        """A cap over the end of a leg that runs up from `top - along`, and its contact cuboid.

        `top` is where the cap ends above the floor; `along` points up the leg, length 1.
        """
        start = np.array(top) - along * (top[1] / along[1] + 0.05)
        path = [(float(start[0]), float(start[1])), top]
        grown = Member(thick=self.thick + 2 * wall, deep=self.deep + 2 * wall, round=self.round)
        cap = grown.solid(path, x, bend=0.001)
        lower, upper = cap.bounds
        touch = slab((lower[0], lower[1] + 0.003, 0.0), (upper[0], upper[1] - 0.003, 0.6 * top[1]))
        return cap, touch
