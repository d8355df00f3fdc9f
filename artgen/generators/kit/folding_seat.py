"""Seats of folding chairs: rails with pins, and slats, a panel, a pad or molded plastic on them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cushion import pad, piping, plan, upholstered
from artgen.generators.kit.folding_frame import PIN, FoldingFrame
from artgen.geometry.solid import Solid, cylinder, slab, union

SeatKind = Literal["slats", "panel", "padded", "plastic"]
RAIL = (0.016, 0.026)
"""m; a rail's width and height."""


@dataclass(frozen=True, kw_only=True)
class FoldingSeat:
    """A seat between the rear legs, level at rest.

    Attributes:
        frame: what carries it.
        kind: what one sits on.
        front: how far it reaches before its hinge, m.
        rear: how far it reaches behind its sliding pin, m.
        slats: how many, where it is slats.
        padding: thickness of a cushion, m.
        dish: how far a panel is pressed in, m.
    """

    frame: FoldingFrame
    kind: SeatKind
    front: float
    rear: float
    slats: int
    padding: float
    dish: float

    @property
    def _span(self) -> tuple[float, float]:
        """y of the front and the rear edge."""
        return -self.front, self.frame.linkage.run + self.rear

    @property
    def top(self) -> float:
        """z of what one sits on."""
        over = {"slats": 0.012, "panel": 0.010, "padded": 0.010 + self.padding, "plastic": 0.014}
        return self.frame.linkage.height + RAIL[1] / 2.0 + over[self.kind]

    def bodies(
        self, rail: Stock, board: Stock, soft: Stock, cord: Stock, metal: Stock
    ) -> list[Body]:
        """Rails, pins and seat."""
        make: Mapping[SeatKind, Callable[[], list[Body]]] = {
            "slats": lambda: self._slats(board),
            "panel": lambda: [self._panel(board, 0.010)],
            "plastic": lambda: [self._panel(board, 0.014)],
            "padded": lambda: [self._panel(board, 0.010), *self._cushion(soft, cord)],
        }
        return [*self._rails(rail), *make[self.kind](), metal.piece(self._pins())]

    def _rails(self, stock: Stock) -> list[Body]:
        z, half = self.frame.linkage.height, self.frame.seat_half
        front, rear = self._span
        inset = 0.0 if self.kind == "slats" else 0.018
        right = slab((half - RAIL[0], front + inset, z - RAIL[1] / 2.0),
                     (half, rear - inset, z + RAIL[1] / 2.0))  # fmt: skip
        return [stock.piece(solid, contact=(solid,)) for solid in (right, right.mirrored("x"))]

    def _slats(self, stock: Stock) -> list[Body]:
        """Boards across the rails, eased along their edges."""
        (front, rear), z = self._span, self.frame.linkage.height + RAIL[1] / 2.0
        pitch = (rear - front + 0.009) / self.slats
        half = self.frame.seat_half
        bodies = []
        for k in range(self.slats):
            y = front + k * pitch
            board = slab((-half, y, z), (half, y + pitch - 0.009, z + 0.012))
            bodies.append(stock.piece(board, contact=(board,), grain="x"))
        return bodies

    def _panel(self, stock: Stock, thick: float) -> Body:
        """A board, sheet or molding with rounded corners, pressed in a little."""
        (front, rear), z = self._span, self.frame.linkage.height + RAIL[1] / 2.0
        outline = plan(2.0 * self.frame.seat_half, rear - front, 0.035, segments=3)
        reach = min(self.frame.seat_half, (rear - front) / 2.0)
        edge = 0.35 * thick
        steps = [(0.7 * reach, 0.0), (edge, 0.0), (0.0, edge), (0.0, thick - edge), (edge, thick)]
        steps += [(share * reach, thick) for share in (0.3, 0.6, 0.9)]
        solid = pad(outline, steps, self._pressed)
        half = self.frame.seat_half - 0.012
        low = z - 0.5 * self.dish
        touch = slab((-half, front + 0.012, low), (half, rear - 0.012, low + thick))
        return stock.piece(solid, contact=(touch,))

    def _pressed(self, flat: Floats) -> Floats:
        """In place; the middle pressed in where there is no cushion, the nose turned down."""
        front, rear = self._span
        half, long = self.frame.seat_half, (rear - front) / 2.0
        x, y, z = flat.T
        across = 1.0 - np.clip(x / half, -1.0, 1.0) ** 2
        along = 1.0 - np.clip(y / long, -1.0, 1.0) ** 2
        dish = 0.0 if self.kind == "padded" else self.dish
        nose = 0.012 * np.clip((-y / long - 0.7) / 0.3, 0.0, 1.0) ** 2
        base = self.frame.linkage.height + RAIL[1] / 2.0
        return np.c_[x, y + (front + rear) / 2.0, base + z - dish * across * along - nose]

    def _cushion(self, stock: Stock, cord: Stock) -> list[Body]:
        front, rear = self._span
        half = self.frame.seat_half - 0.004
        outline = plan(2.0 * half, rear - front - 0.008, 0.035, segments=3)
        thick = 0.8 * self.padding
        reach = min(half, (rear - front) / 2.0 - 0.004)
        steps = upholstered(
            thick, roll=0.5 * thick, crown=0.2 * self.padding, reach=reach, rings=(2, 4, 3)
        )

        def lie(flat: Floats) -> Floats:
            return self._pressed(flat + np.array((0.0, 0.0, 0.010)))

        base = self.frame.linkage.height + RAIL[1] / 2.0 + 0.010
        touch = slab(
            (-half + 0.006, front + 0.02, base), (half - 0.006, rear - 0.014, base + thick)
        )
        seam = piping(outline, (0.0003, 0.42 * thick), lie, 0.0018)
        return [stock.piece(pad(outline, steps, lie), contact=(touch,)), cord.piece(seam)]

    def _pins(self) -> Solid:
        """Hinge pins into the rear legs, and the rod whose ends slide in the guides."""
        frame, link = self.frame, self.frame.linkage
        start = frame.seat_half - 0.008
        ends = (
            (link.hinge, frame.leg_x + frame.leg.thick / 2.0 - 0.0005),
            (link.pin, frame.pin_reach),
        )
        pins = [
            cylinder(PIN, end - start, axis="x", segments=12).at(start, y, z)
            for (y, z), end in ends
        ]
        right = union(pins)
        rod = cylinder(PIN, 2.0 * start, axis="x", segments=12).at(-start, *link.pin)
        return union([right, right.mirrored("x"), rod])
