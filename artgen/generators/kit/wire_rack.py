"""Open baskets of bent wire: dish racks, freezer baskets, oven shelves."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, slab, wire

LAYER = 2.35
"""Distance of the center lines of wires that cross, in wire radii: a pentagon of the area of the
circle reaches 1.149 radii, so wires rest on each other without sharing volume."""
SIDES = 5


STEP = math.radians(46.0)
"""Bends turn by this much a chord at most; corners that turn less than half of it
stay sharp."""


def bent(corners: ArrayLike, radius: float, *, closed: bool = False) -> Floats:
    """(N, 3) path through straight legs whose corners are rounded by `radius` m.

    Raises:
        GeometryError: two bends do not fit on the leg between them.
    """
    points = np.asarray(corners, float)
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    path: list[Floats] = []
    for k, point in enumerate(points):
        if not closed and k in (0, len(points) - 1):
            path.append(point[None])
        else:
            path.append(_fillet(before[k], point, after[k], radius))
    joined = np.concatenate(path)
    legs = np.diff(joined, axis=0)
    if (np.einsum("ij,ij->i", legs[1:], legs[:-1]) <= 0.0).any():
        raise GeometryError(
            f"bends of {radius} m do not fit between {len(points)} corners; shorten the radius"
        )
    return joined


def _fillet(a: Floats, corner: Floats, b: Floats, radius: float) -> Floats:
    into, out = corner - a, b - corner
    into, out = into / np.linalg.norm(into), out / np.linalg.norm(out)
    turn = math.acos(float(np.clip(into @ out, -1.0, 1.0)))
    if turn < STEP / 2.0:
        return corner[None]
    side = out - into * (into @ out)
    side /= np.linalg.norm(side)
    start = corner - into * radius * math.tan(turn / 2.0)
    angles = np.linspace(0.0, turn, math.ceil(turn / STEP) + 1)[:, None]
    return np.asarray(start + radius * (np.sin(angles) * into + (1.0 - np.cos(angles)) * side))


@dataclass(frozen=True, kw_only=True)
class WireBasket:
    """A basket open at the top, centered on x = 0; all numbers are center lines of wires, m.

    Attributes:
        half_width: of the side walls.
        front: y of the front wall.
        back: y of the back wall.
        floor: z of the lower layer of the floor.
        crown: how much higher the floor is in its middle (x = 0) than at the sides.
        rim_front: z of the rim in front.
        rim_back: z of the rim at the back.
        radius: of the wires; the rim's is a third larger.
        lengthwise: wires of the floor along y.
        crosswise: wires of the floor along x, resting on those.
        belts: rings inside the walls between floor and rim.
    """

    half_width: float
    front: float
    back: float
    floor: float
    crown: float = 0.0
    rim_front: float
    rim_back: float
    radius: float
    lengthwise: int
    crosswise: int
    belts: int = 1

    @property
    def bend(self) -> float:
        """Radius of the bends between floor and walls."""
        return 0.014

    @property
    def inset(self) -> float:
        """From a wall to the floor's outermost wires that run along it."""
        return self.bend + 4.0 * self.radius

    @property
    def lanes(self) -> Floats:
        """x of the wires along y."""
        reach = self.half_width - self.inset - 0.006
        return np.linspace(-reach, reach, self.lengthwise)

    @property
    def rungs(self) -> Floats:
        """y of the wires along x."""
        return np.linspace(self.front + self.inset, self.back - self.inset, self.crosswise)

    def rim(self, y: float) -> float:
        """z of the rim at `y`."""
        share = (y - self.front) / (self.back - self.front)
        return self.rim_front + share * (self.rim_back - self.rim_front)

    def ground(self, x: float) -> float:
        """z of the lower floor layer at `x`."""
        return self.floor + self.crown * max(0.0, 1.0 - abs(x) / (self.half_width - self.inset))

    def top_of_floor(self, x: float) -> float:
        """z above the floor's upper layer at `x`, where things may stand."""
        return self.ground(x) + (LAYER + 1.2) * self.radius


def basket_wires(basket: WireBasket) -> list[Solid]:
    """Rim, belts and floor wires; they lie on each other and share no volume."""
    b, rim = basket, 1.33 * basket.radius
    reach = 1.2 * (rim + b.radius)  # from the rim's center line down to an upright's end
    rings = [_ring(b, 0.0, lift=1.0, radius=rim)]
    for k in range(b.belts):
        rings.append(_ring(b, LAYER * b.radius, lift=(k + 1.0) / (b.belts + 1.0), radius=b.radius))
    along = [
        wire(bent(_lengthwise(b, float(x), reach), b.bend), b.radius, sides=SIDES) for x in b.lanes
    ]
    across = [
        wire(bent(_crosswise(b, float(y), reach), b.bend), b.radius, sides=SIDES) for y in b.rungs
    ]
    return rings + along + across


def _ring(b: WireBasket, inset: float, *, lift: float, radius: float) -> Solid:
    """A ring `lift` of the way from floor to rim, `inset` inside the walls."""
    x, front, back = b.half_width - inset, b.front + inset, b.back - inset

    def z(y: float) -> float:
        return b.floor + lift * (b.rim(y) - b.floor)

    corners = [(-x, front), (x, front), (x, back), (-x, back)]
    path = bent([(u, v, z(v)) for u, v in corners], 0.022, closed=True)
    return wire(path, radius, sides=6, closed=True)


def _lengthwise(b: WireBasket, x: float, reach: float) -> list[tuple[float, float, float]]:
    z = b.ground(x)
    return [
        (x, b.front, b.rim(b.front) - reach),
        (x, b.front, z),
        (x, b.back, z),
        (x, b.back, b.rim(b.back) - reach),
    ]


def _crosswise(b: WireBasket, y: float, reach: float) -> list[tuple[float, float, float]]:
    step, top = LAYER * b.radius, b.rim(y) - reach
    ridge = b.half_width - b.inset
    level = [(-ridge, 0.0), (0.0, b.crown), (ridge, 0.0)] if b.crown > 0.0 else []
    floor = [(x, y, b.floor + step + rise) for x, rise in level]
    left, right = (-b.half_width, y), (b.half_width, y)
    return [
        (*left, top),
        (*left, b.floor + step),
        *floor,
        (*right, b.floor + step),
        (*right, top),
    ]


def tines(
    basket: WireBasket, xs: Sequence[float], ys: Sequence[float], *, height: float, lean: float
) -> list[Solid]:
    """Square pins on the lower floor layer at every (x, y), tips leaning `lean` m to the back."""
    pin = wire([(0.0, 0.0, 0.0), (0.0, lean, height)], 0.9 * basket.radius, sides=4)
    foot = (1.15 + lean / height) * basket.radius  # its foot is square to the lean
    return [pin.at(x, y, basket.ground(x) + foot) for x in xs for y in ys]


def basket_collision(basket: WireBasket) -> tuple[Solid, ...]:
    """Floor and four walls as thin boxes; the room between them stays open."""
    b, t = basket, 1.15 * basket.radius
    x, low, high = b.half_width, b.floor - t, b.floor + b.crown + (LAYER + 1.15) * b.radius
    front, back, side = b.rim_front + t, b.rim_back + t, min(b.rim_front, b.rim_back) + t
    return (
        slab((-x - t, b.front - t, low), (x + t, b.back + t, high)),
        slab((-x - t, b.front - t, high), (x + t, b.front + t, front)),
        slab((-x - t, b.back - t, high), (x + t, b.back + t, back)),
        slab((-x - t, b.front + t, high), (-x + t, b.back - t, side)),
        slab((x - t, b.front + t, high), (x + t, b.back - t, side)),
    )
