"""Racks and trays of ovens, and the wire ladders at both walls that carry them."""

from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.density import STEEL
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.wire_rack import LAYER, SIDES, bent
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, hull, prism, slab, union, wire

RAIL = 0.0025
"""m; radius of a ladder's wires."""
EDGE = 0.0030
"""m; radius of a rack's frame."""
PLAY = 0.0010
"""m; between rail and rack, and between rack and ladder."""
POST = 0.0045
"""m; from the wall to the middle of a ladder's posts."""


@dataclass(frozen=True, kw_only=True)
class RackLadders:
    """Ladders at the side walls of a cavity.

    Attributes:
        cavity: theirs.
        levels: z of the middle of each pair of rails.
        front: y of the front posts.
        back: y of the rear posts.
    """

    cavity: LinedCavity
    levels: tuple[float, ...]
    front: float
    back: float

    @property
    def rail(self) -> float:
        """From the wall to the middle of a rail."""
        return POST + 1.02 * LAYER * RAIL

    @property
    def half(self) -> float:
        """Half the distance of the outer frame wires of a rack."""
        return (self.cavity.high[0] - self.cavity.low[0]) / 2.0 - (POST + RAIL + PLAY + 1.2 * EDGE)

    def rest(self, level: int) -> float:
        """z of the middle of a rack's frame on that level."""
        return self.levels[level] + 1.15 * (RAIL + EDGE) + PLAY

    def solid(self) -> Solid:
        """Posts, rails, and the studs that hold them."""
        x0, x1 = self.cavity.low[0], self.cavity.high[0]
        low, high = min(self.levels) - 0.022, max(self.levels) + 0.022
        right = []
        for y in (self.front, self.back):
            post = wire([(x1 - POST, y, low), (x1 - POST, y, high)], RAIL, sides=SIDES)
            right.append(post)
            right += [
                slab((x1 - POST, y - 0.003, z - 0.003), (x1 + 0.001, y + 0.003, z + 0.003))
                for z in (low + 0.006, high - 0.006)
            ]
        for z in self.levels:
            ends = [(x1 - self.rail, y, z) for y in (self.front - 0.012, self.back + 0.012)]
            right.append(wire(ends, RAIL, sides=SIDES))
            right += [
                slab((x1 - self.rail, y - 0.002, z - 0.002), (x1 - POST, y + 0.002, z + 0.002))
                for y in (self.front, self.back)
            ]
        one = union(right)
        middle = x0 + x1
        return union([one, one.mirrored("x").at(middle)])


@dataclass(frozen=True, kw_only=True)
class OvenRack:
    """What slides on one level.

    Attributes:
        name: of the part.
        ladders: that carry it.
        level: index of its rails.
        front: y of its front wire.
        back: y of its rear wire.
        bars: wires of its floor; 0 for a tray.
        bar: their radius.
    """

    name: str
    ladders: RackLadders
    level: int
    front: float
    back: float
    bars: int
    bar: float

    @property
    def middle(self) -> float:
        """x of its middle."""
        return self.ladders.cavity.middle[0]

    def rack_part(self, surface: str) -> DraftPart:
        """A wire shelf: a bent frame, bars from front to back, a stop that rises at the rear."""
        z, x, r = self.ladders.rest(self.level), self.ladders.half, self.bar
        corners = [(-x, self.front, z), (x, self.front, z), (x, self.back, z), (-x, self.back, z)]
        frame = wire(bent(corners, 0.012, closed=True), EDGE, sides=SIDES, closed=True)
        over = 0.5 * LAYER * (r + EDGE)
        bars = [
            wire(
                [(u, self.front - EDGE, z + over), (u, self.back + EDGE, z + over)], r, sides=SIDES
            )
            for u in np.linspace(-x + 0.020, x - 0.020, self.bars)
        ]
        ties = [
            wire([(-x - 0.5 * EDGE, y, z), (x + 0.5 * EDGE, y, z)], r, sides=SIDES)
            for y in np.linspace(self.front, self.back, 4)[1:-1]
        ]
        lift = z + over + 0.020
        stop = wire(
            bent([(-x + 0.03, self.back, z), (-x + 0.03, self.back, lift),
                  (x - 0.03, self.back, lift), (x - 0.03, self.back, z)], 0.010),
            r, sides=SIDES,
        )  # fmt: skip
        solid = union([frame, *bars, *ties, stop]).at(self.middle)
        flat = slab((-x - EDGE, self.front - EDGE, z - EDGE),
                    (x + EDGE, self.back + EDGE, z + over + r)).at(self.middle)  # fmt: skip
        body = Body(solid=solid, surface=surface, density=STEEL, collision=(flat,))
        return DraftPart(name=self.name, label="rack", bodies=(body,), grips=(self._grip(z),))

    def tray_part(self, surface: str, *, depth: float) -> DraftPart:
        """A pressed baking tray whose rim rests on the rails."""
        z, x = self.ladders.rest(self.level) - EDGE, self.ladders.half + EDGE
        reach = (x, (self.back - self.front) / 2.0)
        y = (self.front + self.back) / 2.0
        rim = prism(rounded_rectangle(2 * reach[0], 2 * reach[1], 0.016, segments=4), 0.0022)
        inner = _pan(reach[0] - 0.016, reach[1] - 0.010, depth)
        outer = _pan(reach[0] - 0.0145, reach[1] - 0.0085, depth + 0.0016)
        solid = ((rim | outer.at(z=0.0008)) - inner.at(z=0.0023)).at(self.middle, y, z)
        a, b, t = reach[0], reach[1], 0.0035
        low = z - depth
        sides = [
            slab((-a + 0.016, -b + 0.008, low), (-a + 0.020, b - 0.008, z)),
            slab((a - 0.020, -b + 0.008, low), (a - 0.016, b - 0.008, z)),
            slab((-a + 0.020, -b + 0.008, low), (a - 0.020, -b + 0.012, z)),
            slab((-a + 0.020, b - 0.012, low), (a - 0.020, b - 0.008, z)),
            slab((-a + 0.020, -b + 0.012, low), (a - 0.020, b - 0.012, low + t)),
        ]
        brims = [slab((s * a - 0.017 * (s > 0), -b, z), (s * a + 0.017 * (s < 0), b, z + 0.002))
                 for s in (-1.0, 1.0)]  # fmt: skip
        touch = tuple(piece.at(self.middle, y) for piece in (*sides, *brims))
        body = Body(solid=solid, surface=surface, density=STEEL * 0.55, collision=touch)
        return DraftPart(name=self.name, label="tray", bodies=(body,), grips=(self._grip(z),))

    def joint(self, *, travel: float, friction: float) -> Joint:
        """Out towards the user."""
        return Joint(
            name=f"{self.name}_slide", type="prismatic", parent="base", child=self.name,
            axis=(0.0, -1.0, 0.0), limit=Limit(lower=0.0, upper=travel), friction=friction,
            damping=5.0, effort=80.0, velocity=1.0,
        )  # fmt: skip

    def _grip(self, z: float) -> Grip:
        out, place = (0.0, -1.0, 0.0), (self.middle, self.front - EDGE, z)
        return Grip(name=f"{self.name}_edge", kind="edge", position=place, outward=out, pull=out)


def _pan(half: float, length: float, depth: float) -> Solid:
    """A room with sloping sides, its mouth at z = 0, `depth` deep."""
    mouth = rounded_rectangle(2 * half, 2 * length, 0.014, segments=4)
    ground = rounded_rectangle(2 * half - 0.012, 2 * length - 0.012, 0.010, segments=4)
    return hull([(x, y, 0.001) for x, y in mouth] + [(x, y, -depth) for x, y in ground])
