"""Plans of bins: round or rectangular with rounded corners; their walls and contact."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from artgen.generators.kit.round_wall import wall_ring
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, loft, prism, slab

REACH = 0.0034
"""How far contact boxes may stand out of a rounded corner, m."""
LOBE = 0.0095
"""Side of the box in a rounded corner, m; a smaller bin of the same center clears it."""
ROUND_SIDES, CORNER_SEGMENTS = 40, 5


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Seen from above, centered on zero, m.

    Attributes:
        half: half width and half depth.
        corner: radius of the corners; None makes an ellipse of it.
    """

    half: tuple[float, float]
    corner: float | None

    def outline(self, inset: float = 0.0) -> Floats:
        """(N, 2) points, moved inwards; N does not depend on the inset."""
        a, b = self.half[0] - inset, self.half[1] - inset
        if self.corner is None:
            return np.asarray(circle(1.0, segments=ROUND_SIDES) * (a, b))
        radius = min(max(self.corner - inset, 0.002), 0.999 * min(a, b))
        return rounded_rectangle(2.0 * a, 2.0 * b, radius, segments=CORNER_SEGMENTS)

    def plate(self, inset: float, low: float, high: float) -> Solid:
        """All of it between two heights."""
        return prism(self.outline(inset), high - low).at(0.0, 0.0, low)

    def ring(self, outer: float, inner: float, low: float, high: float) -> Solid:
        """What lies between two insets."""
        flat = prism(self.outline(outer), high - low, holes=[self.outline(inner)])
        return flat.at(0.0, 0.0, low)

    def stack(self, levels: list[tuple[float, float]]) -> Solid:
        """A body through (inset, z) levels from low to high."""
        rings = [np.c_[self.outline(i), np.full(len(self.outline()), z)] for i, z in levels]
        return loft(rings)

    def inner_box(self, inset: float, low: float, high: float) -> Solid:
        """The largest box that stays within REACH of the plan."""
        a, b = self.half[0] - inset, self.half[1] - inset
        if self.corner is None:
            return slab((-0.72 * a, -0.72 * b, low), (0.72 * a, 0.72 * b, high))
        cut = clipped(max(self.corner - inset, 0.0))
        return slab((-a + cut, -b + cut, low), (a - cut, b - cut, high))

    def wall_contact(
        self, inset: float, wall: float, low: float, high: float, *, pieces: int
    ) -> tuple[Solid, ...]:
        """Around an open inside: a ring of wedges, or walls with a box in each corner."""
        a, b = self.half[0] - inset, self.half[1] - inset
        if self.corner is None:
            levels = [(z, a - wall, a) for z in (low, high)]
            return wall_ring(levels, count=pieces, bulge=0.002)
        return boxed_walls((a, b), self.corner - inset, wall, (low, high))


def clipped(radius: float) -> float:
    """How far a square corner is pulled in so that it stands out of an arc by REACH at most."""
    return max(0.0, radius - (radius + REACH) / math.sqrt(2.0))


def boxed_walls(
    half: tuple[float, float], corner: float, wall: float, span: tuple[float, float]
) -> tuple[Solid, ...]:
    """Eight upright boxes that stand for a wall with rounded corners."""
    (a, b), (low, high) = half, span
    r = max(corner, 0.0)
    side = max(0.0, r - math.sqrt((r + REACH) ** 2 - r * r)) if r > 0.008 else 0.0
    walls = [
        slab((-a, -b + side, low), (-a + wall, b - side, high)),
        slab((a - wall, -b + side, low), (a, b - side, high)),
        slab((-a + side, -b, low), (a - side, -b + wall, high)),
        slab((-a + side, b - wall, low), (a - side, b, high)),
    ]
    cut = clipped(r)
    inner = min(side + wall, cut + LOBE)
    if side <= cut + wall:
        return tuple(walls)
    for sx in (-1.0, 1.0):
        for sy in (-1.0, 1.0):
            x0, x1 = sorted((sx * (a - cut), sx * (a - inner)))
            y0, y1 = sorted((sy * (b - cut), sy * (b - inner)))
            walls.append(slab((x0, y0, low), (x1, y1, high)))
    return tuple(walls)
