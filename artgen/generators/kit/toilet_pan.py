"""Pans of toilets: a bowl with its sump and trap in a foot, a skirt or a hung shell; water in it.

The pin of seat and lid lies at y = 0; the front is at -y, the wall at +y."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.sliced_contact import sliced_wall
from artgen.geometry.solid import Solid, cylinder, loft, slab, union

Shape = Literal["pedestal", "skirted", "hung"]
BACK = 0.085
"""m; from the pin to the rear of the bowl's mouth."""
SKINS: dict[Shape, tuple[tuple[float, float, float], ...]] = {
    "pedestal": (
        (-1.0, 0.80, 0.56), (-0.93, 0.79, 0.55), (-0.86, 0.70, 0.50), (-0.72, 0.63, 0.52),
        (-0.60, 0.66, 0.70), (-0.45, 0.77, 0.81), (-0.28, 0.90, 0.925), (-0.14, 0.97, 0.98),
        (-0.06, 1.0, 1.0),
    ),
    "skirted": (
        (-1.0, 0.80, 0.84), (-0.97, 0.815, 0.85), (-0.5, 0.86, 0.89), (-0.25, 0.94, 0.955),
        (-0.10, 0.99, 0.99), (-0.04, 1.0, 1.0),
    ),
    "hung": (
        (-1.0, 0.50, 0.30), (-0.93, 0.60, 0.42), (-0.72, 0.76, 0.73), (-0.45, 0.90, 0.89),
        (-0.20, 0.98, 0.97), (-0.06, 1.0, 1.0),
    ),
}  # fmt: skip
"""Depth below the rim (share of the pan's height), width and length towards the front there."""
BOWL = (
    (0.0, 1.0),
    (0.10, 0.985),
    (0.30, 0.93),
    (0.52, 0.82),
    (0.70, 0.67),
    (0.86, 0.50),
    (1.0, 0.36),
)
"""Share of the bowl's depth, and its width there."""


def outline(half: float, front: float, rear: float, rear_half: float, power: float) -> Floats:
    """(N, 2) counter-clockwise: a super-ellipse before its widest place, straight sides behind."""
    length = rear - front
    reach = min(0.62 * length, 1.45 * half)
    t = np.linspace(np.pi, 2.0 * np.pi, 25)
    x, y = np.cos(t), np.sin(t)
    x = half * np.sign(x) * np.abs(x) ** (2.0 / power)
    y = front + reach - reach * np.abs(y) ** (2.0 / power)
    corner = min(0.03, 0.3 * rear_half)
    back = [(rear_half, rear - corner), (rear_half - 0.3 * corner, rear - 0.3 * corner)]
    back.append((rear_half - corner, rear))
    mirrored = [(-a, b) for a, b in reversed(back)]
    return np.concatenate([np.c_[x, y], back, mirrored])


def egg(half: float, front: float, rear: float, power: float) -> Floats:
    """(N, 2) counter-clockwise: a whole super-ellipse, its widest place behind its middle."""
    wide = front + 0.54 * (rear - front)
    t = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    x, y = np.cos(t), np.sin(t)
    reach = np.where(y < 0.0, wide - front, rear - wide)
    return np.c_[
        half * np.sign(x) * np.abs(x) ** (2.0 / power),
        wide + reach * np.sign(y) * np.abs(y) ** (2.0 / power),
    ]


@dataclass(frozen=True, kw_only=True)
class Pan:
    """A pan's measures, m.

    Attributes:
        half: half of its width.
        length: from the pin to its front.
        back: from the pin to its rear.
        rear_half: half of its width there.
        rim: z of its rim.
        tall: from its lowest point to the rim.
        power: of the super-ellipse: 2 is round, 3 squarish.
        border: width of the rim.
        deep: depth of the bowl.
        rimless: the bowl's wall starts at the mouth, without an overhang.
        water: depth of the water in the sump.
    """

    shape: Shape
    half: float
    length: float
    back: float
    rear_half: float
    rim: float
    tall: float
    power: float
    border: float
    deep: float
    rimless: bool
    water: float

    def plan(self, width: float = 1.0, reach: float = 1.0, inset: float = 0.0) -> Floats:
        """The outline, narrower, shorter towards the front, or moved in."""
        return outline(
            width * self.half - inset,
            -reach * self.length + inset,
            self.back,
            min(self.rear_half, 0.98 * width * self.half) - inset,
            self.power,
        )

    def mouth(self, inset: float = 0.0) -> Floats:
        """The edge of the bowl, seen from above."""
        half, front = self.half - self.border - inset, -self.length + self.border + inset
        return egg(half, front, -BACK - inset, min(self.power, 2.5))

    def body(self, china: Stock, water: Stock) -> tuple[Body, ...]:
        """The pan, and the water in its sump."""
        hollow = self._bowl() | self._trap()
        level = self.rim - self.deep + self.water
        pool = hollow & slab((-1.0, -1.0, 0.0), (1.0, 1.0, level))
        return (
            china.piece(self._shell() - hollow, contact=self._contact()),
            water.piece(pool),
        )

    def _skins(self) -> list[tuple[float, Floats]]:
        rows = faired(np.array(SKINS[self.shape]), 3)
        rings = [(self.rim + s * self.tall, self.plan(w, r)) for s, w, r in rows.tolist()]
        lip = 0.010
        rings.append((self.rim - lip, self.plan()))
        rings.append((self.rim - 0.3 * lip, self.plan(inset=0.3 * lip)))
        return [*rings, (self.rim, self.plan(inset=lip))]

    def _shell(self) -> Solid:
        return loft([np.c_[ring, np.full(len(ring), z)] for z, ring in self._skins()])

    def _rings(self) -> list[tuple[float, Floats]]:
        """Of the bowl, from the rim down; it narrows towards the sump, which lies behind."""
        wide = self.mouth(0.0 if self.rimless else -0.012)
        sump = np.array([0.0, -BACK - 0.40 * (self.length - BACK - self.border)])
        rows = faired(np.array(BOWL), 2).tolist()
        return [(self.rim - s * self.deep, sump + w * (wide - sump)) for s, w in rows]

    def _bowl(self) -> Solid:
        rings = [np.c_[ring, np.full(len(ring), z)] for z, ring in reversed(self._rings())]
        if self.rimless:
            top = np.c_[self._rings()[0][1], np.full(40, self.rim + 0.01)]
            return loft([*rings, top])
        below = loft(rings) & slab((-1.0, -1.0, 0.0), (1.0, 1.0, self.rim - 0.030))
        mouth = self.mouth()
        hole = [np.c_[mouth, np.full(len(mouth), z)] for z in (self.rim - 0.032, self.rim + 0.01)]
        return below | loft(hole)

    def _trap(self) -> Solid:
        """The way out of the sump, to the rear."""
        z, ring = self._rings()[-1]
        start = float(ring[:, 1].mean())
        return cylinder(0.036, 0.13, axis="y", segments=20).at(0.0, start, z + 0.037)

    def _contact(self) -> tuple[Solid, ...]:
        """Slices of the wall in two layers around the bowl, and of what is below it."""
        skins, rings = self._skins(), self._rings()
        low, floor = skins[0][0], self.rim - self.deep - 0.006
        middle = self.rim - 0.42 * self.deep
        boxes: list[Solid] = []
        layers = (
            (low, floor, 7, None),
            (floor, middle, 9, middle),
            (middle, self.rim - 0.003, 13, 0.0),
        )
        for z0, z1, count, at in layers:
            outer = [r for z, r in skins if z0 - 1e-9 <= z <= z1] + [
                _between(skins, z0), _between(skins, z1),
            ]  # fmt: skip
            inner = [] if at is None else [_between(rings[::-1], z1 if at else self.rim)]
            front = max(float(ring[:, 1].min()) for ring in outer)
            share = np.linspace(0.0, 1.0, count + 1) ** 1.25
            cuts = (front + (self.back - front) * share).tolist()
            boxes += sliced_wall(outer, inner, z=(z0, z1), cuts=cuts)
        return tuple(boxes)


def faired(rows: Floats, steps: int) -> Floats:
    """Rows (N, M) with `steps` intervals for each one, on a cubic through them whose slopes are
    those of the chords beside each row."""
    slopes = np.gradient(rows, rows[:, 0], axis=0)
    made = [rows[:1]]
    for k in range(len(rows) - 1):
        t, h = np.linspace(0.0, 1.0, steps + 1)[1:, None], rows[k + 1, 0] - rows[k, 0]
        made.append(
            (1.0 + 2.0 * t) * (1.0 - t) ** 2 * rows[k]
            + t * (1.0 - t) ** 2 * h * slopes[k]
            + t**2 * (3.0 - 2.0 * t) * rows[k + 1]
            + t**2 * (t - 1.0) * h * slopes[k + 1]
        )
    return np.concatenate(made)


def _between(rings: list[tuple[float, Floats]], z: float) -> Floats:
    """The outline at height z of rings that rise."""
    for (z0, low), (z1, high) in pairwise(rings):
        if z0 <= z <= z1 and z1 > z0:
            return np.asarray(low + (high - low) * (z - z0) / (z1 - z0))
    return rings[0][1] if z < rings[0][0] else rings[-1][1]


def bolt_caps(x: float, y: float, z: float, *, stock: Stock) -> Body:
    """Round caps on both flanks over the screws that hold a pan to the floor."""
    cap = cylinder(0.013, 0.02, axis="x", segments=18)
    return stock.piece(union([cap.at(x - 0.016, y, z), cap.at(-x - 0.004, y, z)]))
