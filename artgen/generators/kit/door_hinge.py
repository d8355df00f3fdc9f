"""Hinges of house doors and windows: butt hinges, drill-in hinges, concealed ones; left edge."""

import math
from dataclasses import dataclass
from typing import Literal

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, cylinder, revolve, slab, union

HingeKind = Literal["butt", "drill_in", "concealed"]
PLATE = 0.0025
"""m; thickness of a hinge's plates, let in flush."""
PLAY = 0.0010
"""m; between knuckles."""
BEFORE = 0.0012
"""m; from a knuckle to the face behind it."""


@dataclass(frozen=True, kw_only=True)
class DoorHinge:
    """A hinge at the left edge of a leaf that opens towards -y.

    Attributes:
        jamb: x of the jamb's face, m.
        gap: from there to the leaf's edge, m.
        face: y of the leaf's and the jamb's front, m.
        height: of the knuckle, m.
        radius: of the knuckle, m.
        finials: round ends above and below.
    """

    kind: HingeKind
    jamb: float
    gap: float
    face: float
    height: float
    radius: float
    finials: bool

    @property
    def axis(self) -> tuple[float, float]:
        """(x, y) of the pin."""
        ahead = 0.002 if self.kind == "concealed" else self.radius + BEFORE
        return self.jamb + self.gap / 2.0, self.face - ahead

    def leaf_side(self, z: float, metal: Stock) -> Body:
        """What turns with the leaf; `z` is the hinge's middle."""
        return self._side(z, metal, turning=True)

    def jamb_side(self, z: float, metal: Stock) -> Body:
        """What stays."""
        return self._side(z, metal, turning=False)

    def _side(self, z: float, metal: Stock, *, turning: bool) -> Body:
        edge, way = (self.jamb + self.gap, 1.0) if turning else (self.jamb, -1.0)
        if self.kind == "concealed":
            return metal.piece(self._cup(edge, way, z))
        spans = self._spans(turning)
        x, y = self.axis
        solids = [
            cylinder(self.radius, top - low, segments=12).at(x, y, z + low) for low, top in spans
        ]
        if self.kind == "butt":
            solids.append(
                _between(
                    edge,
                    edge + way * PLATE,
                    self.face - 0.001,
                    self.face + 0.030,
                    z,
                    self.height / 2.0,
                )
            )
        for low, top in spans:
            solids.append(self._tail(edge, way, z + low, z + top))
        if self.finials:
            solids += self._finials(z, turning)
        return metal.piece(union(solids))

    def _tail(self, edge: float, way: float, low: float, top: float) -> Solid:
        """From a knuckle back to the plate, or the threaded arm of a drill-in hinge."""
        if self.kind == "drill_in":
            return self._pin(edge, way, (low + top) / 2.0)
        near, far = edge + way * 0.0002, edge + way * 0.8 * PLATE
        y = self.axis[1]
        return slab((min(near, far), y, low), (max(near, far), self.face + 0.002, top))

    def _spans(self, turning: bool) -> list[tuple[float, float]]:
        """Heights of the knuckles of one side: three in turn, or one above the other."""
        count = 3 if self.kind == "butt" else 2
        step = self.height / count
        spans = [
            (
                -self.height / 2.0 + k * step + (PLAY if k else 0.0),
                -self.height / 2.0 + (k + 1) * step,
            )
            for k in range(count)
        ]
        return spans[1::2] if turning else spans[0::2]

    def _pin(self, edge: float, way: float, z: float) -> Solid:
        """The threaded arm of a drill-in hinge, from the knuckle into the wood."""
        x, y = self.axis
        start, stop = (x, y), (edge + way * 0.010, self.face + 0.020)
        angle = math.atan2(stop[0] - start[0], stop[1] - start[1])
        bar = cylinder(
            0.6 * self.radius,
            math.hypot(stop[0] - start[0], stop[1] - start[1]),
            axis="y",
            segments=10,
        )
        return bar.turned("z", -angle).at(x, y, z)

    def _finials(self, z: float, turning: bool) -> list[Solid]:
        x, y = self.axis
        ball = arc((0.0, 0.0), 1.0, -math.pi / 2.0 + 0.6, math.pi / 2.0, 4) * self.radius * 0.95
        ball[-1, 0] = 0.0
        cap = revolve(
            [(0.0, ball[0, 1] - 0.002), (ball[0, 0], ball[0, 1] - 0.002), *ball.tolist()],
            segments=10,
        )
        cap = cap.at(0.0, 0.0, self.radius * 0.8)
        bottom, top = (
            cap.mirrored("z").at(x, y, z - self.height / 2.0),
            cap.at(x, y, z + self.height / 2.0),
        )
        if self.kind == "butt":
            return [] if turning else [bottom, top]
        return [top] if turning else [bottom]

    def _cup(self, edge: float, way: float, z: float) -> Solid:
        """The plate of a concealed hinge, let in flush, its recess showing."""
        mid = self.face + 0.020
        plate = _between(edge, edge + way * 0.004, mid - 0.012, mid + 0.012, z, self.height / 2.0)
        recess = _between(
            edge + way * 0.002,
            edge - way * 0.01,
            mid - 0.009,
            mid + 0.009,
            z,
            self.height / 2.0 - 0.012,
        )
        return plate - recess


def _between(x0: float, x1: float, y0: float, y1: float, z: float, half: float) -> Solid:
    return slab((min(x0, x1), y0, z - half), (max(x0, x1), y1, z + half))
