"""What a door slides on: a flat rail with wheels and straps before a wall, or a pocket in it."""

import math
from dataclasses import dataclass, replace

import numpy as np

from artgen.articulation.types import Body, DraftPart, Joint, Latch, Limit, Mimic
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.solid import Solid, cylinder, revolve, slab, union

BAR, TALL = 0.007, 0.040
"""Thickness and height of the flat rail, m."""
TREAD, FLANGE = 0.040, 0.046
"""Radii of a wheel: in its groove, and at its flanges, m."""
LIFT = 0.0006
"""m; between groove and rail."""


@dataclass(frozen=True, kw_only=True)
class BarnGear:
    """A leaf that hangs from two wheels on a rail and slides to the left.

    Attributes:
        leaf: the leaf, closed, m.
        faces: y of its front and rear.
        travel: how far it slides.
        header: y of the front and rear of the board that carries the rail.
        strap: how far the straps reach down the leaf.
    """

    leaf: Rect
    faces: tuple[float, float]
    travel: float
    header: tuple[float, float]
    strap: float

    @property
    def rail_z(self) -> float:
        """z of the rail's upper edge."""
        return self.leaf.z1 + 0.014 + TALL

    @property
    def top(self) -> float:
        """z of the highest point."""
        return self.rail_z + TREAD + FLANGE

    @property
    def _middle(self) -> float:
        return sum(self.faces) / 2.0

    @property
    def wheels(self) -> tuple[float, float]:
        """x of the axles when closed."""
        inset = 0.16 * self.leaf.width
        return self.leaf.x0 + inset, self.leaf.x1 - inset

    @property
    def span(self) -> tuple[float, float]:
        """x of the rail's ends."""
        left, right = self.wheels
        return left - self.travel - 0.10, right + 0.10

    def fixed(self, wood: Stock, metal: Stock, rubber: Stock) -> list[Body]:
        """Header, rail on its spacers, stops, and the guide on the floor."""
        (x0, x1), y, z = self.span, self._middle, self.rail_z
        middle, (near, far) = z - TALL / 2.0, self.header
        board = wood.board((x0, near, middle - 0.045), (x1, far, middle + 0.045))
        rail = metal.board((x0, y - BAR / 2.0, z - TALL), (x1, y + BAR / 2.0, z), grain="x")
        count = max(3, round((x1 - x0) / 0.45))
        places = np.linspace(x0 + 0.06, x1 - 0.06, count).tolist()
        rear = y + BAR / 2.0
        pins = [
            cylinder(0.011, near - rear, axis="y", segments=14).at(x, rear, middle) for x in places
        ] + [
            cylinder(0.0085, 0.005, axis="y", segments=6).at(x, y - BAR / 2.0 - 0.005, middle)
            for x in places
        ]
        stops = [
            slab((x - 0.014, y - 0.012, z - 0.012), (x + 0.014, y + 0.012, z + 0.05))
            for x in (x0 + 0.020, x1 - 0.020)
        ]
        buffers = [
            cylinder(0.010, 0.012, axis="x", segments=12).at(x, y, z + 0.036)
            for x in (x0 + 0.034, x1 - 0.046)
        ]
        return [
            board,
            rail,
            metal.piece(union(pins)),
            metal.piece(union(stops), contact=tuple(stops)),
            rubber.piece(union(buffers)),
            self._guide(metal),
        ]

    def _guide(self, metal: Stock) -> Body:
        """Two ears on a plate that keep the leaf's foot in its plane wherever it is."""
        (front, rear), x = self.faces, self.leaf.x0 + 0.022
        plate = slab((x - 0.015, front - 0.008, 0.0), (x + 0.015, rear + 0.008, 0.004))
        ears = [
            slab((x - 0.015, y, 0.004), (x + 0.015, y + 0.005, 0.035))
            for y in (front - 0.008, rear + 0.003)
        ]
        return metal.piece(union([plate, *ears]), contact=(plate, *ears))

    def straps(self, metal: Stock) -> list[Body]:
        """Straps on the leaf's face with their axles and bolts."""
        front, y, z = self.faces[0], self._middle, self.rail_z + TREAD + LIFT
        bodies = []
        for x in self.wheels:
            low, bar = self.leaf.z1 - self.strap, 0.020
            strap = slab((x - bar, front - 0.006, low), (x + bar, front, z))
            crown = cylinder(bar, 0.006, axis="y", segments=20).at(x, front - 0.006, z)
            axle = cylinder(0.0062, y + 0.018 - front, axis="y", segments=14).at(x, front, z)
            nuts = [
                cylinder(0.011, 0.006, axis="y", segments=6).at(x, v, z)
                for v in (front - 0.012, y + 0.012)
            ]
            bolts = [
                cylinder(0.008, 0.005, axis="y", segments=6).at(x, front - 0.011, low + r)
                for r in (0.03, self.strap - 0.03)
            ]
            whole = union([strap, crown, axle, *nuts, *bolts])
            bodies.append(metal.piece(whole, contact=(strap,)))
        return bodies

    def parts(self, metal: Stock) -> tuple[DraftPart, ...]:
        """The wheels, left and right."""
        return tuple(
            DraftPart(name=name, label="wheel", bodies=(self._wheel(x, metal),))
            for name, x in zip(("wheel_left", "wheel_right"), self.wheels, strict=True)
        )

    def _wheel(self, x: float, metal: Stock) -> Body:
        w, groove = 0.010, BAR / 2.0 + 0.0012
        section = [
            (0.0072, -w), (FLANGE - 0.001, -w), (FLANGE, -w + 0.001), (FLANGE, -groove - 0.001),
            (TREAD, -groove), (TREAD, groove), (FLANGE, groove + 0.001), (FLANGE, w - 0.001),
            (FLANGE - 0.001, w), (0.0072, w),
        ]  # fmt: skip
        solid = revolve(section, axis="y", segments=28)
        hole = cylinder(0.0065, 0.04, axis="y", segments=8).at(0.025, -0.02, 0.0)
        holes = union([hole.turned("y", 2.0 * math.pi * k / 5.0) for k in range(5)])
        tread = cylinder(TREAD, 2.0 * w, axis="y", segments=24).at(0.0, -w, 0.0)
        place = (x, self._middle, self.rail_z + TREAD + LIFT)
        return replace(metal, edge=0.0).piece(
            (solid - holes).at(*place), contact=(tread.at(*place),)
        )

    def joints(self, friction: float) -> tuple[Joint, ...]:
        """The slide, and the wheels that roll along with it."""
        z = self.rail_z + TREAD + LIFT
        rolling = tuple(
            Joint(
                name=f"{name}_roll",
                type="continuous",
                parent="leaf",
                child=name,
                axis=(0.0, -1.0, 0.0),
                origin=(x, self._middle, z),
                limit=None,
                friction=0.0,
                damping=0.001,
                effort=5.0,
                velocity=20.0,
                mimic=Mimic(joint="leaf_slide", multiplier=1.0 / TREAD),
            )
            for name, x in zip(("wheel_left", "wheel_right"), self.wheels, strict=True)
        )
        return (slide(self.travel, friction), *rolling)


def slide(travel: float, friction: float) -> Joint:
    """A leaf slides to the left by +q; a soft catch keeps it closed."""
    return Joint(
        name="leaf_slide",
        type="prismatic",
        parent="base",
        child="leaf",
        axis=(-1.0, 0.0, 0.0),
        limit=Limit(lower=0.0, upper=travel),
        friction=friction,
        damping=8.0,
        effort=120.0,
        velocity=1.0,
        latch=Latch(force=6.0, reach=0.02),
    )


@dataclass(frozen=True, kw_only=True)
class Pocket:
    """A wall with a slot at the left of its opening that takes a sliding leaf.

    Attributes:
        opening: clear opening, m.
        depth: of the wall.
        slot: y of the slot's faces.
        reach: how far the slot goes in, from the opening.
        beyond: width of the wall left of the slot and right of the opening.
        above: height of the wall over the track.
        track: height of the track's box over the opening.
    """

    opening: Rect
    depth: float
    slot: tuple[float, float]
    reach: float
    beyond: tuple[float, float]
    above: float
    track: float

    def wall(self, stock: Stock) -> Body:
        """The wall, its slot open towards the opening and below the track's box."""
        o, top = self.opening, self.opening.z1 + self.track + self.above
        x0, x1 = o.x0 - self.reach - self.beyond[0], o.x1 + self.beyond[1]
        (y0, y1), z = self.slot, o.z1 + self.track
        pieces = (
            slab((x0, 0.0, 0.0), (o.x0, y0, z)),
            slab((x0, y1, 0.0), (o.x0, self.depth, z)),
            slab((x0, y0, 0.0), (o.x0 - self.reach, y1, z)),
            slab((o.x1, 0.0, 0.0), (x1, self.depth, z)),
            slab((o.x0, 0.0, o.z1), (o.x1, y0, z)),
            slab((o.x0, y1, o.z1), (o.x1, self.depth, z)),
            slab((x0, 0.0, z), (x1, self.depth, top)),
        )
        return stock.piece(union(pieces), contact=pieces, grain="x")

    def rail(self, metal: Stock) -> Body:
        """A channel over opening and slot, its lips below."""
        o, (y0, y1), z = self.opening, self.slot, self.opening.z1 + self.track
        a, b = (y0 + y1) / 2.0 - 0.016, (y0 + y1) / 2.0 + 0.016
        x0, x1, low = o.x0 - self.reach, o.x1, z - 0.032
        sides = [
            slab((x0, a, low), (x1, a + 0.002, z)),
            slab((x0, b - 0.002, low), (x1, b, z)),
            slab((x0, a, low), (x1, a + 0.010, low + 0.002)),
            slab((x0, b - 0.010, low), (x1, b, low + 0.002)),
            slab((x0, a, z - 0.002), (x1, b, z)),
        ]
        return metal.piece(union(sides), contact=tuple(sides))


def hanger(x: float, *, middle: float, low: float, high: float) -> Solid:
    """A bolt out of a leaf's top that carries a trolley in a channel."""
    bolt = cylinder(0.004, high - low - 0.004, segments=10).at(x, middle, low)
    plate = slab((x - 0.03, middle - 0.014, low), (x + 0.03, middle + 0.014, low + 0.003))
    truck = slab(
        (x - 0.035, middle - 0.011, high - 0.016), (x + 0.035, middle + 0.011, high - 0.004)
    )
    return union([bolt, plate, truck])
