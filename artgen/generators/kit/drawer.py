"""Drawer boxes and the runners they slide on; drawers leave along -y."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.solid import Solid, prism, slab, upright

Runner = Literal["metal", "wood"]
LENGTHS = np.arange(0.20, 0.61, 0.05)
"""m; runners are sold in steps of 50 mm."""
BOTTOM = 0.005
"""Thickness of drawer bottoms, m."""
PLAY = 0.0012
"""m; between the fixed and the moving half of a runner."""
SIDE_ROOM = {"metal": 0.0127, "wood": 0.0025}
"""m; from the carcass to the drawer's side: half an inch for ball-bearing slides."""


@dataclass(frozen=True, kw_only=True)
class DrawerBox:
    """A box behind a front, open at the top.

    Attributes:
        opening: clear room in the carcass.
        front: y of the box's front, where the decorative front ends.
        length: along y, one of `LENGTHS`.
        wall: thickness of sides, front and back, m.
        runner: what it slides on.
    """

    opening: Rect
    front: float
    length: float
    wall: float
    runner: Runner

    @property
    def outside(self) -> Rect:
        """The box without runners, in the x, z plane."""
        room, o = SIDE_ROOM[self.runner], self.opening
        above = max(0.016, 0.14 * o.height)
        return Rect(x0=o.x0 + room, x1=o.x1 - room, z0=o.z0 + 0.012, z1=o.z1 - above)

    @property
    def back(self) -> float:
        """y of its rear."""
        return self.front + self.length

    @property
    def rail(self) -> tuple[float, float]:
        """Lower and upper z of a runner."""
        box = self.outside
        height = min(0.045, 0.5 * box.height) if self.runner == "metal" else 0.016
        low = box.z0 + max(0.012, 0.42 * box.height - height / 2.0)
        return low, low + height


def longest(room: float) -> float:
    """The longest runner that fits into `room` m of depth."""
    return float(LENGTHS[room + 1e-9 >= LENGTHS].max(initial=LENGTHS[0]))


def drawer_box(box: DrawerBox, stock: Stock, bottom: Stock) -> tuple[Body, ...]:
    """Sides, front, back and a bottom held above their lower edges."""
    o, t = box.outside, box.wall
    front, back = box.front, box.back
    sides = [_side(box, stock, x) for x in (o.x0, o.x1 - t)]
    ends = [
        stock.board((o.x0 + t, y, o.z0), (o.x1 - t, y + t, o.z1), grain="x")
        for y in (front, back - t)
    ]
    floor = o.z0 + 0.009
    base = bottom.board((o.x0 + t, front + t, floor), (o.x1 - t, back - t, floor + BOTTOM))
    return (*sides, *ends, base)


def _side(box: DrawerBox, stock: Stock, x: float) -> Body:
    o, t = box.outside, box.wall
    plain = slab((x, box.front, o.z0), (x + t, box.back, o.z1))
    if box.runner == "metal":
        return stock.piece(plain, contact=(plain,), grain="y")
    (low, high), deep = box.rail, 0.008
    inner = x if x == o.x0 else x + t - deep
    groove = slab(
        (inner, box.front + 0.03, low - PLAY), (inner + deep, box.back + 0.01, high + PLAY)
    )
    return stock.piece(plain - groove, contact=(plain,), grain="y")


def fixed_runners(box: DrawerBox, metal: Stock, wood: Stock) -> tuple[Body, ...]:
    """The halves on the carcass: channels with a rear stop, or strips that fill grooves."""
    middle = box.opening.middle[0]
    left = _channel(box) if box.runner == "metal" else _strip(box)
    stock = metal if box.runner == "metal" else wood
    return tuple(stock.piece(solid) for solid in (left, _across(left, middle)))


def moving_runners(box: DrawerBox, metal: Stock) -> tuple[Body, ...]:
    """The halves on the drawer; wooden runners have none."""
    if box.runner == "wood":
        return ()
    (low, high), o = box.rail, box.outside
    play = 0.0012 + PLAY
    left = slab(
        (box.opening.x0 + play, box.front + 0.004, low + play), (o.x0, box.back, high - play)
    )
    middle = box.opening.middle[0]
    return tuple(metal.piece(solid) for solid in (left, _across(left, middle)))


def _across(solid: Solid, middle: float) -> Solid:
    """The mirror image on the other side of the plane x = `middle`."""
    return solid.mirrored("x").at(2.0 * middle, 0.0, 0.0)


def _channel(box: DrawerBox) -> Solid:
    """A C of 1.2 mm steel along y, closed at the rear by a bumper that stops the moving half."""
    (low, high), x = box.rail, box.opening.x0
    sheet, deep = 0.0012, 0.0085
    profile = np.array(
        [
            (low, x),
            (high, x),
            (high, x + deep),
            (high - sheet, x + deep),
            (high - sheet, x + sheet),
            (low + sheet, x + sheet),
            (low + sheet, x + deep),
            (low, x + deep),
        ]
    )
    length = box.length + 0.006
    steel = upright(prism(profile, length), "y").at(0.0, box.front + 0.004, 0.0)
    stop = slab(
        (x + 0.0006, box.back + PLAY, low + 0.0006), (x + deep, box.back + 0.006, high - 0.0006)
    )
    return steel | stop


def _strip(box: DrawerBox) -> Solid:
    """A hardwood strip; the closed end of the groove meets its front end."""
    (low, high), x = box.rail, box.opening.x0
    start = box.front + 0.03 + PLAY
    return slab((x, start, low), (x + SIDE_ROOM["wood"] + 0.0065, box.back, high))


def travel(box: DrawerBox, share: float) -> float:
    """How far the drawer comes out, m, to the millimeter."""
    return math.floor(1000.0 * share * box.length) / 1000.0
