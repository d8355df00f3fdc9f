"""The inside of a toaster: slots, mica boards with glowing wire, guards, the bread's carriages."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, prism, slab, union, upright, wire

BOARD = 0.0016
"""m; a mica board with the wire on its two faces counts as one plate."""
SHEETING = 3200.0
"""kg/m3; steel of 0.4 mm drawn 1 mm thick."""
GUARD = 0.0011
"""m; radius of the guard wires."""
BESIDE = 0.0095
"""m; from a slot's edge to the board beside it."""
CROSSBAR = 0.016
"""m; room at the lever's end of the chamber for the carriage's crossbar."""
CRUST = 0.004
"""m; from a slot's edge to the bread in it."""


@dataclass(frozen=True, kw_only=True)
class BreadChamber:
    """Slots along x side by side; the lever's end is +x.

    Attributes:
        back: x of the chamber's end away from the lever, m.
        slot_length: along x.
        slot_width: along y.
        gap: between neighboring slots.
        slots: how many.
        floor: z where the chamber opens into the crumb tray's room.
        top: z of the upper face.
        lip: thickness of the top around the slots.
    """

    back: float
    slot_length: float
    slot_width: float
    gap: float
    slots: int
    floor: float
    top: float
    lip: float

    @property
    def front(self) -> float:
        """x of the chamber's end at the lever."""
        return self.back + self.slot_length + 0.004 + CROSSBAR

    @property
    def slot_x(self) -> tuple[float, float]:
        """Ends of the slots."""
        return self.back + 0.004, self.back + 0.004 + self.slot_length

    @property
    def middles(self) -> tuple[float, ...]:
        """y of the slots' middles."""
        pitch = self.slot_width + self.gap
        return tuple((k - (self.slots - 1) / 2.0) * pitch for k in range(self.slots))

    @property
    def half(self) -> float:
        """Half of the chamber's width."""
        return self.middles[-1] + self.slot_width / 2.0 + BESIDE + 0.0035

    def room(self) -> Solid:
        """What the shell must leave free: the chamber and its slots."""
        under = slab(
            (self.back, -self.half, self.floor - 0.001),
            (self.front, self.half, self.top - self.lip),
        )
        return union([under, *self.openings(0.0)])

    def openings(self, shrink: float) -> list[Solid]:
        """Columns through the top, each edge drawn in by `shrink`."""
        x0, x1 = self.slot_x
        half = self.slot_width / 2.0 - shrink
        low, high = self.top - self.lip - 0.002, self.top + 0.02
        return [
            slab((x0 + shrink, y - half, low), (x1 - shrink, y + half, high)) for y in self.middles
        ]

    def strips(self) -> list[Solid]:
        """The top between and around the slots, as boxes below the face."""
        x0, x1 = self.slot_x
        low, high = self.top - self.lip, self.top
        edges = [-self.half]
        for y in self.middles:
            edges += [y - self.slot_width / 2.0, y + self.slot_width / 2.0]
        edges.append(self.half)
        between = zip(edges[::2], edges[1::2], strict=True)
        ends = [
            slab((self.back, -self.half, low), (x0, self.half, high)),
            slab((x1, -self.half, low), (self.front, self.half, high)),
        ]
        return [*(slab((x0, a, low), (x1, b, high)) for a, b in between), *ends]

    def inside(self, mica: Stock, glow: str, steel: Stock, *, rows: int, guards: int) -> list[Body]:
        """A sheet liner, boards, the wire wound on them and the guards before them."""
        x0, x1 = self.slot_x
        low, high = self.floor + 0.006, self.top - self.lip
        boards = [
            mica.board((x0, y - BOARD / 2.0, low), (x1, y + BOARD / 2.0, high))
            for y in self._boards()
        ]
        wires = union(self._windings(rows, (low + 0.012, high - 0.012)))
        winding = Body(solid=wires, surface=glow, density=2600.0)
        bars = steel.piece(union(self._guards(guards, (low, high))))
        return [*self._liner(replace(steel, density=SHEETING)), *boards, winding, bars]

    def _liner(self, steel: Stock) -> list[Body]:
        """The walls at the sides and at the end away from the lever."""
        low, high, wall = self.floor + 0.003, self.top - self.lip, 0.001
        return [
            steel.piece(slab((self.back, y, low), (self.front, y + wall, high)))
            for y in (-self.half, self.half - wall)
        ] + [steel.piece(slab((self.back, -self.half, low), (self.back + wall, self.half, high)))]

    def _boards(self) -> list[float]:
        pitch = self.slot_width + self.gap
        outer = self.middles[0] - self.slot_width / 2.0 - BESIDE
        between = [y + pitch / 2.0 for y in self.middles[:-1]]
        return [outer, *between, -outer]

    def _windings(self, rows: int, span: tuple[float, float]) -> list[Solid]:
        """Flat ribbons along x around each board, one above the other."""
        x0, x1 = self.slot_x[0] + 0.004, self.slot_x[1] - 0.004
        levels = np.linspace(*span, rows)
        half = BOARD / 2.0 + 0.0005
        return [
            slab((x0, y - half, z - 0.0008), (x1, y + half, z + 0.0008))
            for y in self._boards()
            for z in levels
        ]

    def _guards(self, count: int, span: tuple[float, float]) -> list[Solid]:
        xs = np.linspace(self.slot_x[0] + 0.008, self.slot_x[1] - 0.008, count)
        reach = self.slot_width / 2.0 - 0.0012
        return [
            wire([(x, y + side * reach, span[0]), (x, y + side * reach, span[1])], GUARD, sides=4)
            for y in self.middles
            for side in (-1.0, 1.0)
            for x in xs.tolist()
        ]

    def carriage(
        self,
        served: Sequence[float],
        steel: Stock,
        *,
        low: float,
        tongue: tuple[float, float, float],
    ) -> Body:
        """The racks that lift the bread of the slots at `served` y, their crossbar and its tongue.

        Args:
            low: z of the racks' lower edge at rest, m.
            tongue: y and z of the tongue's middle and x of its tip in the lever's channel.
        """
        x0, x1 = self.slot_x[0] + 0.003, self.front - 0.004
        bar = (x1 - 0.0045, x1)
        touch = []
        for y in served:
            touch.append(slab((x0, y - 0.0012, low), (bar[0], y + 0.0012, low + 0.009)))
            xs = np.linspace(x0 + 0.006, self.slot_x[1] - 0.006, 5 + 3 * (self.slot_length > 0.2))
            half = self.slot_width / 2.0 - CRUST
            touch += [
                slab((x - 0.001, y - half, low + 0.0062), (x + 0.001, y + half, low + 0.0088))
                for x in xs.tolist()
            ]
        y, z, tip = tongue
        y0, y1 = min(*served, y) - 0.0045, max(*served, y) + 0.0045
        post = (min(low, z) + 0.001, max(low, z) + 0.0034)
        touch += [
            slab((bar[0], y0, low + 0.0003), (bar[1], y1, low + 0.0086)),
            slab((bar[0] + 0.0003, y - 0.0041, post[0]), (bar[1] - 0.0003, y + 0.0041, post[1])),
            slab((bar[0] + 0.0006, y - 0.0045, z - 0.004), (tip, y + 0.0045, z + 0.004)),
        ]
        return steel.piece(union(touch), contact=tuple(touch))

    def bread(self, y: float, loaf: Stock, crust: Stock, *, low: float, size: float) -> list[Body]:
        """Slices that stand on the rack of the slot at `y`: crumb with a crust around it."""
        count = max(1, int(self.slot_length / (size + 0.004)))
        pitch = self.slot_length / count
        thick = self.slot_width - 2.0 * CRUST - 0.002
        bodies = []
        for k in range(count):
            x = self.slot_x[0] + (k + 0.5) * pitch
            rind = _slice(size, thick).at(x, y - thick / 2.0, low)
            crumb = _slice(size - 0.007, thick + 0.0008).at(
                x, y - thick / 2.0 - 0.0004, low + 0.0035
            )
            box = slab(
                (x - size / 2.0, y - thick / 2.0, low),
                (x + size / 2.0, y + thick / 2.0, low + size),
            )
            bodies += [crust.piece(rind, contact=(box,)), loaf.piece(crumb)]
        return bodies


def _slice(size: float, thick: float) -> Solid:
    """A slice of tin bread that stands on z = 0: straight below, two shoulders on top."""
    half, corner = size / 2.0, 0.12 * size
    points = [
        arc((-half + corner, corner), corner, math.pi, 1.5 * math.pi, 3),
        arc((half - corner, corner), corner, 1.5 * math.pi, 2.0 * math.pi, 3),
        arc((half - 0.2 * size, 0.8 * size), 0.2 * size, -0.15 * math.pi, 0.5 * math.pi, 5),
        arc((-half + 0.2 * size, 0.8 * size), 0.2 * size, 0.5 * math.pi, 1.15 * math.pi, 5),
    ]
    outline = np.concatenate(points)
    # upright(..., "y") reads a drawing of (z, x), so the outline is given with its axes swapped.
    return upright(prism(outline[::-1, ::-1], thick), "y")
