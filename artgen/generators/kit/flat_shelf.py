"""Shelves of refrigerators: a pane in its trims, bent wire, slats; the ledges that carry them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, Grip, Joint, Limit
from artgen.generators.kit.density import ABS, GLASS, OAK, STEEL
from artgen.generators.kit.wire_rack import LAYER, bent
from artgen.geometry.solid import Solid, slab, union, wire

ShelfStyle = Literal["glass", "wire", "slats"]
LEDGE = (0.008, 0.006)
"""m; width and height of the ledges on the walls."""
SIDE_PLAY = 0.0025
"""m; between a shelf and the walls."""


@dataclass(frozen=True, kw_only=True)
class FlatShelf:
    """A shelf whose upper side lies at `top`; things stand there.

    Attributes:
        left: x of its left edge, m; right likewise.
        front: y of its front edge; back likewise.
        top: z.
        style: of what it is made.
        wires: along y.
        radius: of the wires.
    """

    left: float
    right: float
    front: float
    back: float
    top: float
    style: ShelfStyle
    wires: int = 16
    radius: float = 0.0022

    @property
    def depth(self) -> float:
        """From its upper side to its underside."""
        return DEPTH[self.style](self)

    def bodies(self, plate: str, trim: str) -> tuple[Body, ...]:
        """The shelf; `plate` is glass, wire or wood, `trim` what edges it."""
        return FORMS[self.style](self, plate, trim)

    def contact(self, deep: float) -> Solid:
        """One box, `deep` m below its upper side."""
        return slab((self.left, self.front, self.top - deep), (self.right, self.back, self.top))

    def ledges(self, walls: tuple[float, float], surface: str) -> tuple[Body, ...]:
        """Ribs on both walls (x) under the shelf."""
        high, (wide, tall) = self.top - self.depth - 0.0006, LEDGE
        pieces = [
            slab((walls[0] - 0.001, self.front + 0.02, high - tall),
                 (walls[0] + wide, self.back, high)),
            slab((walls[1] - wide, self.front + 0.02, high - tall),
                 (walls[1] + 0.001, self.back, high)),
        ]  # fmt: skip
        return tuple(Body(solid=piece, surface=surface, density=ABS) for piece in pieces)

    def grip(self, name: str) -> Grip:
        """Its front edge."""
        outward = (0.0, -1.0, 0.0)
        middle = ((self.left + self.right) / 2.0, self.front, self.top - 0.4 * self.depth)
        return Grip(name=f"{name}_edge", kind="edge", position=middle, outward=outward,
                    pull=outward)  # fmt: skip

    def joint(self, name: str, *, travel: float, friction: float) -> Joint:
        """Out to the front."""
        return Joint(
            name=f"{name}_slide",
            type="prismatic",
            parent="base",
            child=name,
            axis=(0.0, -1.0, 0.0),
            limit=Limit(lower=0.0, upper=travel),
            friction=friction,
            damping=5.0,
            effort=120.0,
            velocity=1.0,
        )


def _glass(s: FlatShelf, plate: str, trim: str) -> tuple[Body, ...]:
    """A pane of 4 mm between a front and a rear trim."""
    pane = slab(
        (s.left, s.front + 0.002, s.top - 0.0045), (s.right, s.back - 0.002, s.top - 0.0005)
    )
    bars = union([
        slab((s.left, s.front, s.top - s.depth), (s.right, s.front + 0.014, s.top + 0.0010)),
        slab((s.left, s.back - 0.012, s.top - s.depth), (s.right, s.back, s.top + 0.010)),
    ])  # fmt: skip
    sheet = Body(solid=pane, surface=plate, density=GLASS, collision=(s.contact(0.0045),))
    return sheet, Body(solid=bars - pane, surface=trim, density=ABS)


def _wire(s: FlatShelf, plate: str, trim: str) -> tuple[Body, ...]:
    """Wires along y on a frame and two stays, with a rail along the front."""
    r = s.radius
    z, low = s.top - 1.2 * r, s.top - (1.2 + LAYER) * r
    x0, x1, y0, y1 = s.left + 1.3 * r, s.right - 1.3 * r, s.front + 1.3 * r, s.back - 1.3 * r
    ring = [(x0, y0, low), (x1, y0, low), (x1, y1, low), (x0, y1, low)]
    made = [wire(bent(ring, 0.014, closed=True), 1.2 * r, sides=6, closed=True)]
    lanes = np.linspace(x0 + 0.016, x1 - 0.016, s.wires)
    made += [wire([(x, y0 - 0.5 * r, z), (x, y1 + 0.5 * r, z)], r, sides=5) for x in lanes]
    stays = np.linspace(y0, y1, 4)[1:-1]
    made += [wire([(x0, y, low), (x1, y, low)], r, sides=5) for y in stays]
    body = Body(solid=union(made), surface=plate, density=STEEL, collision=(s.contact(2.6 * r),))
    return (body,)


def _slats(s: FlatShelf, plate: str, trim: str) -> tuple[Body, ...]:
    """A wooden front over wires: wine shelves."""
    front = slab((s.left, s.front, s.top - s.depth), (s.right, s.front + 0.018, s.top + 0.006))
    r = s.radius
    z, y0 = s.top - 1.2 * r, s.front + 0.010
    y1, x0, x1 = s.back - 1.3 * r, s.left + 1.3 * r, s.right - 1.3 * r
    low = s.top - (1.2 + LAYER) * r
    ring = [(x0, y0, low), (x0, y1, low), (x1, y1, low), (x1, y0, low)]
    made = [wire(bent(ring, 0.014), 1.2 * r, sides=6)]
    made += [wire([(x, y0, z), (x, y1 + 0.5 * r, z)], r, sides=5)
             for x in np.linspace(x0 + 0.016, x1 - 0.016, s.wires)]  # fmt: skip
    made += [wire([(x0, y, low), (x1, y, low)], r, sides=5)
             for y in np.linspace(y0, y1, 4)[1:-1]]  # fmt: skip
    grid = Body(solid=union(made), surface=trim, density=STEEL, collision=(s.contact(2.6 * r),))
    return grid, Body(solid=front, surface=plate, density=OAK, edge=0.0015, collision=(front,))


FORMS: Mapping[ShelfStyle, Callable[[FlatShelf, str, str], tuple[Body, ...]]] = {
    "glass": _glass,
    "wire": _wire,
    "slats": _slats,
}
DEPTH: Mapping[ShelfStyle, Callable[[FlatShelf], float]] = {
    "glass": lambda s: 0.018,
    "wire": lambda s: (1.2 + LAYER + 1.2 * 1.2) * s.radius,
    "slats": lambda s: 0.030,
}
