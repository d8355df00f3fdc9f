"""Open thin-walled vessels: round, oval or with rounded corners in plan; buckets, bins, pots.

A vessel is a stack of rings. Each ring is a superellipse |x / a|^n + |y / b|^n = 1, which n = 2
makes an ellipse and n = 5 a rectangle with round corners.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, hull, loft, slab, wire

ROUND_WEDGES, SQUARE_WEDGES = 10, 12
"""Convex pieces of a wall; each costs a file."""
CORNERS_OUT = {ROUND_WEDGES: 0.0185, SQUARE_WEDGES: 0.011}
"""Share of the half width by which the chords' corners leave the inside."""


@dataclass(frozen=True, kw_only=True)
class Ring:
    """A level of a vessel's outside.

    Attributes:
        z: m.
        half: (a, b), half of its width along x and depth along y, m.
        power: n of the superellipse.
        lip: how far a pouring lip bulges out towards -y, m.
    """

    z: float
    half: tuple[float, float]
    power: float = 2.0
    lip: float = 0.0

    def points(self, count: int, *, inset: float = 0.0, turn: float = 0.0) -> Floats:
        """(count, 3) counter-clockwise from +x on, moved `inset` m inwards along x and y.

        Args:
            turn: added to each angle, rad.
        """
        angle = 2.0 * math.pi * np.arange(count) / count + turn
        cos, sin = np.cos(angle), np.sin(angle)
        a, b = self.half[0] - inset, self.half[1] - inset
        reach = (np.abs(cos / a) ** self.power + np.abs(sin / b) ** self.power) ** (
            -1.0 / self.power
        )
        away = np.angle(np.exp(1j * (angle + math.pi / 2.0)))
        reach = reach + self.lip * np.exp(-((away / 0.22) ** 2))
        return np.stack([reach * cos, reach * sin, np.full(count, self.z)], axis=1)


@dataclass(frozen=True, kw_only=True)
class Vessel:
    """A wall of even thickness over a floor.

    Attributes:
        rings: from the lowest, which carries the floor, to the mouth.
        wall: thickness of wall, m.
        floor: thickness of the floor, m.
        segments: corners of every ring.
    """

    rings: tuple[Ring, ...]
    wall: float
    floor: float
    segments: int = 40

    def at_height(self, z: float) -> Ring:
        """The outside at `z`, between the rings around it."""
        levels = [ring.z for ring in self.rings]
        k = min(max(int(np.searchsorted(levels, z)) - 1, 0), len(levels) - 2)
        low, high = self.rings[k], self.rings[k + 1]
        share = (z - low.z) / (high.z - low.z)

        def between(one: float, other: float) -> float:
            return one + share * (other - one)

        return Ring(
            z=z,
            half=(between(low.half[0], high.half[0]), between(low.half[1], high.half[1])),
            power=between(low.power, high.power),
            lip=between(low.lip, high.lip),
        )

    @property
    def mouth(self) -> Ring:
        """The uppermost ring."""
        return self.rings[-1]

    @property
    def ground(self) -> float:
        """z of the inner floor, m."""
        return self.rings[0].z + self.floor

    def outside(self) -> Solid:
        """The full body."""
        return loft(np.stack([ring.points(self.segments) for ring in self.rings]))

    def inside(self, *, more: float = 0.0) -> Solid:
        """The room within, up to beyond the mouth; `more` shrinks it by so many m."""
        levels = [self.at_height(self.ground), *(r for r in self.rings if r.z > self.ground)]
        top = replace(self.mouth, z=self.mouth.z + 0.01)
        inset = self.wall + more
        return loft(np.stack([r.points(self.segments, inset=inset) for r in [*levels, top]]))

    def shell(self) -> Solid:
        """Wall and floor."""
        return self.outside() - self.inside()

    def band(self, z: float, radius: float, *, out: float = 0.0, sides: int = 8) -> Solid:
        """A bead around the outside at `z`, its middle `out` m outside the wall."""
        ring = self.at_height(z) if z < self.mouth.z else replace(self.mouth, z=z)
        return wire(ring.points(self.segments, inset=-out), radius, sides=sides, closed=True)

    def foot_ring(self, height: float, *, thickness: float) -> Solid:
        """An upright ring under the floor, as wide as it, that reaches 1 mm into it."""
        base = self.rings[0]
        bottom = base.z - height
        levels = [replace(base, z=z) for z in (bottom, base.z + 0.001)]
        outer = loft(np.stack([ring.points(self.segments) for ring in levels]))
        levels = [replace(base, z=z) for z in (bottom - 0.01, base.z + 0.01)]
        return outer - loft(
            np.stack([ring.points(self.segments, inset=thickness) for ring in levels])
        )

    def wall_collision(self, *, top: float | None = None) -> tuple[Solid, ...]:
        """Wedges around an open inside, from the inner floor to `top` (the mouth if None).

        Their inner faces are chords; corners stand out so far that the room keeps 97 % of its area,
        which puts the wedges' outside up to 3 mm before the wall.
        """
        high = self.mouth if top is None else replace(self.mouth, z=top)
        levels = [self.at_height(self.ground), high]
        count = ROUND_WEDGES if high.power < 3.0 else SQUARE_WEDGES
        out = CORNERS_OUT[count] * min(high.half)
        turn = math.pi / count  # Joints lie beside the axes, where ears sit, and in corners.
        outer = [ring.points(count, inset=self.wall - out - 0.0015, turn=turn) for ring in levels]
        inner = [ring.points(count, inset=self.wall - out, turn=turn) for ring in levels]
        wedges = []
        for k in range(count):
            j = (k + 1) % count
            wedges.append(hull([r[i] for r in (*outer, *inner) for i in (k, j)]))
        return tuple(wedges)

    def floor_collision(self) -> tuple[Solid, ...]:
        """The floor as two crossed boxes."""
        a, b = self.rings[0].half
        low, high = self.rings[0].z, self.ground
        return tuple(
            slab((-u * a, -v * b, low), (u * a, v * b, high)) for u, v in ((0.9, 0.42), (0.42, 0.9))
        )


def spread(low: float, high: float, count: int) -> Sequence[float]:
    """`count` even steps strictly between two heights."""
    return [low + (high - low) * (k + 1) / (count + 1) for k in range(count)]
