"""Where clothes hang: a hat shelf, a rail in its sockets, and hangers on it."""

import math

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.carcass import SHELF
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, cylinder, prism, slab, tube, wire

ROD = 0.0125
"""Outer radius of a wardrobe rail, m."""
HOOK = 0.0165
"""Radius of a hanger's hook, m: it rides on the rail."""


def clothes_rail(room: Rect, y: float, z: float, steel: Stock) -> tuple[Body, ...]:
    """A steel tube across the room with its axis at (y, z), a round socket at each end."""
    length = room.width - 0.002
    rod = tube(ROD, ROD - 0.0012, length, axis="x", segments=16).at(room.x0 + 0.001, y, z)
    contact = slab((room.x0, y - 0.01, z - 0.01), (room.x1, y + 0.01, z + 0.01))
    sockets = [
        tube(ROD + 0.006, ROD + 0.0002, 0.009, axis="x", segments=14).at(x, y, z)
        for x in (room.x0, room.x1 - 0.009)
    ]
    return (
        steel.piece(rod, contact=(contact,), grain="x"),
        *(steel.piece(socket) for socket in sockets),
    )


def hat_shelf(room: Rect, z: float, *, front: float, rear: float, stock: Stock) -> Body:
    """A fixed shelf above the rail; its underside lies at `z`."""
    return stock.board((room.x0, front, z), (room.x1, rear, z + SHELF), grain="x")


def hanger(x: float, y: float, z: float, *, lean: float, wood: Stock, steel: Stock) -> list[Body]:
    """A wooden hanger on a rail whose axis is at (y, z), turned about its hook by `lean` rad."""
    neck = z - 0.062
    shoulders, bar = _shoulders(), _trouser_bar()
    hook = _hook()
    bodies = [(wood, shoulders), (wood, bar), (steel, hook)]
    return [
        stock.piece(solid.turned("z", lean).at(x, y, neck if solid is not hook else z))
        for stock, solid in bodies
    ]


def _shoulders() -> Solid:
    """Two sloping arms in one bow, 13 mm thick, drawn in the y, z plane with the neck at zero."""
    half, thick = 0.205, 0.013
    top = [(s * half, 0.004 - 0.115 * abs(s) ** 1.35) for s in np.linspace(-1.0, 1.0, 7)]
    low = [(y, z - 0.026 + 0.008 * abs(y) / half) for y, z in top][::-1]
    outline = np.array([*low[::-1], *top[::-1]])
    return prism(outline, thick).transformed(_FROM_PLAN).at(-thick / 2.0)


def _trouser_bar() -> Solid:
    return cylinder(0.005, 0.372, axis="y", segments=8).at(0.0, -0.186, -0.119)


def _hook() -> Solid:
    """Up from the neck and over the rail, in the y, z plane; the rail's axis is zero."""
    bend = arc((0.0, 0.0), HOOK, -0.35 * math.pi, 1.05 * math.pi, 6)
    foot = [(0.0, -0.064), (0.0, -HOOK - 0.012)]
    plane = np.concatenate([np.asarray(foot), bend])
    path = np.stack([np.zeros(len(plane)), plane[:, 0], plane[:, 1]], axis=1)
    return wire(path, 0.0016, sides=4)


_FROM_PLAN = np.array(
    [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""x, y of a drawing become y, z; its height x."""
