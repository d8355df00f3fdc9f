"""Star-shaped feet of swivel chairs: arms that fall from a hub to sockets for casters."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.caster import STEM
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cone, cylinder, loft, slab, union

SQUARES = 4
"""Contact cuboids an arm that runs askew."""
BULGE = 0.003
"""m; how far the corners of those may stand out of the arm."""
SOCKET = 0.0007
"""m; play of a caster's stem in its socket."""
REST = 0.0012
"""m; between a caster's shoulder and its socket."""


@dataclass(frozen=True, kw_only=True)
class StarBase:
    """Arms on a hub around the z axis.

    Attributes:
        arms: how many.
        heading: direction of the first arm, rad from +x.
        reach: from the axis to the casters' stems, m.
        low: height of the sockets' lower faces, m.
        socket: depth of the sockets, m.
        rise: how much higher than the tips' lower faces the hub begins, m.
        hub: radius and height of the hub, m.
        root: width and height of an arm at the hub, m.
        tip: width and height of an arm at its end, m.
        arch: how much an arm bows upwards between, m.
    """

    arms: int
    heading: float
    reach: float
    low: float
    socket: float
    rise: float
    hub: tuple[float, float]
    root: tuple[float, float]
    tip: tuple[float, float]
    arch: float

    @property
    def hub_low(self) -> float:
        """Lower end of the hub, m."""
        return self.low + self.rise

    @property
    def hub_high(self) -> float:
        """Upper end of the hub, m."""
        return self.hub_low + self.hub[1]

    def feet(self) -> list[tuple[float, float]]:
        """(x, y) of each caster's stem, m."""
        turns = [self.heading + 2.0 * math.pi * k / self.arms for k in range(self.arms)]
        return [(self.reach * math.cos(t), self.reach * math.sin(t)) for t in turns]

    def body(self, stock: Stock, bore: float) -> Body:
        """Hub and arms in one piece, bored for the column."""
        sockets = [cylinder(STEM + SOCKET, self.socket, segments=12).at(x, y, self.low - 1e-4)
                   for x, y in self.feet()]  # fmt: skip
        pieces = [self._hub(), *(self._arm(x, y) for x, y in self.feet())]
        hole = cylinder(bore, 1.0, segments=24).at(z=self.low - 0.5)
        contact = [*self._hub_contact(bore), *(c for f in self.feet() for c in self._contact(*f))]
        return stock.piece(union(pieces) - union([hole, *sockets]), contact=tuple(contact))

    def _hub(self) -> Solid:
        radius, height = self.hub
        lower = cone(0.86 * radius, radius, 0.25 * height, segments=24)
        upper = cone(radius, 0.90 * radius, 0.75 * height, segments=24).at(z=0.25 * height)
        return union([lower, upper]).at(z=self.hub_low)

    def _section(self, share: float) -> tuple[float, float, float, float]:
        """Distance from the axis, middle height, width and height of an arm at a share of it."""
        near = 0.55 * self.hub[0]
        width = self.root[0] + share * (self.tip[0] - self.root[0])
        height = self.root[1] + share**0.8 * (self.tip[1] - self.root[1])
        start = self.hub_low + 0.5 * self.hub[1]
        end = self.low + 0.5 * self.tip[1]
        lift = 4.0 * self.arch * share * (1.0 - share)
        return (
            near + share * (self.reach - near),
            start + share * (end - start) + lift,
            width,
            height,
        )

    def _arm(self, x: float, y: float) -> Solid:
        along = np.array((x, y)) / self.reach
        rings = [self._ring(along, *self._section(k / 4.0)) for k in range(5)]
        boss = cylinder(0.5 * self.tip[0] + 0.001, self.tip[1], segments=14).at(x, y, self.low)
        return union([loft(rings), boss])

    def _ring(self, along: Floats, r: float, z: float, width: float, height: float) -> Floats:
        """A cross-section: flat below, rounded above."""
        soft = 0.42 * min(width, height)
        outline = rounded_rectangle(width, height, (0.004, 0.004, soft, soft), segments=2)
        across = np.array((-along[1], along[0]))
        plane = along * r + outline[:, :1] * across
        return np.c_[plane, z + outline[:, 1]]

    def _hub_contact(self, bore: float) -> list[Solid]:
        """Four walls around the bore."""
        inner, outer = 0.75 * bore, 0.80 * self.hub[0]
        low, high = self.hub_low, self.hub_high
        wall = slab((inner, -inner, low), (outer, inner, high))
        side = slab((-inner, inner, low), (inner, outer, high))
        return [wall, wall.mirrored("x"), side, side.mirrored("y")]

    def _contact(self, x: float, y: float) -> list[Solid]:
        """Cuboids along an arm: one where it runs along an axis, else a row of squares."""
        cos, sin = x / self.reach, y / self.reach
        pieces = []
        for k in range(SQUARES):
            share = (k + 0.75) / SQUARES
            r, z, width, height = self._section(min(share, 1.0))
            half = (width / 2.0 + BULGE) / (abs(cos) + abs(sin))
            top = 0.5 * height - 0.002
            low = max(z - top, self.low + 0.001)
            pieces.append(
                slab(
                    (r * cos - half, r * sin - half, low), (r * cos + half, r * sin + half, z + top)
                )
            )
        return pieces
