"""Beverage refrigerators: what varies, and where things lie."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from artgen.generators.kit.bottles import CONTAINERS
from artgen.generators.kit.cold_case import Cell, ColdCase
from artgen.generators.kit.cold_leaf import SEAL_PLAY, ColdLeaf, Hinge
from artgen.generators.kit.door_pull import PullStyle
from artgen.generators.kit.flat_shelf import SIDE_PLAY, FlatShelf, ShelfStyle
from artgen.generators.kit.glazed_cold_door import FrameStyle, GlazedDoor
from artgen.generators.kit.handle import Handle
from artgen.generators.kit.lined_cavity import LinedCavity

Form = Literal["compact", "undercounter", "upright"]
SIZES: dict[tuple[Form, int], tuple[tuple[float, float], ...]] = {
    ("compact", 1): ((0.43, 0.48), (0.43, 0.50), (0.52, 0.86)),
    ("undercounter", 1): ((0.590, 0.600), (0.54, 0.60), (0.820, 0.870)),
    ("undercounter", 2): ((0.890, 1.200), (0.52, 0.58), (0.820, 0.900)),
    ("upright", 1): ((0.54, 0.68), (0.54, 0.66), (1.45, 1.95)),
    ("upright", 2): ((0.96, 1.22), (0.58, 0.68), (1.75, 1.98)),
}
"""Width, depth of the case, height, m."""
SEAM = 0.004
"""m; between two doors, and around them."""
BAR = 0.034
"""m; height and depth of the control bar under the ceiling."""
COVER = 0.0065
"""m; thickness of the evaporator's cover at the back."""
MOST_SLIDING = 6
ON_A_SHELF = {1: 5, 2: 3}
"""Most containers on a shelf, by the number of doors; a bundle stays below 3 MB."""


@dataclass(frozen=True, kw_only=True)
class BeverageParams:
    """Sampled values; units as in the rule file."""

    form: Form
    two_doors: bool
    width_share: float
    depth_share: float
    height_share: float
    wall: float
    foot: float
    toe: float
    toe_depth: float
    gap: float
    door: float
    inset: float
    corner: float
    frame: FrameStyle
    rail: float
    low_rail: float
    hinge_left: bool
    pull: PullStyle
    handle_share: float
    handle_radius: float
    standoff: float
    lock: bool
    shelf: ShelfStyle
    shelf_pitch: float
    wires: int
    wire: float
    slides: bool
    travel: float
    slide_friction: float
    control: Literal["dial", "digital"]
    led: Literal["top", "sides"]
    lamp: float
    temperature: int
    sign: int
    canopy: float
    bars: int
    upright_bars: bool
    coil: bool
    stock: tuple[str, ...]
    fill: tuple[float, ...]
    label: int
    label_colors: tuple[int, ...]
    foam: float
    compressor: float
    opening_deg: float
    friction: float
    latch: float

    @property
    def doors(self) -> int:
        """One or two; compact ones have one."""
        return 2 if self.two_doors and self.form != "compact" else 1

    @cached_property
    def size(self) -> tuple[float, float, float]:
        """Width, depth of the case, height."""
        shares = (self.width_share, self.depth_share, self.height_share)
        spans = SIZES[self.form, self.doors]
        w, d, h = (a + s * (b - a) for (a, b), s in zip(spans, shares, strict=True))
        return w, d, h

    @property
    def has_canopy(self) -> bool:
        """Upright ones carry a lit sign over their doors."""
        return self.form == "upright" and self.sign > 0

    @cached_property
    def case(self) -> ColdCase:
        """The foamed case."""
        w, d, h = self.size
        return ColdCase(
            half=w / 2.0, depth=d, foot=self.foot, top=h, toe_height=self.foot + self.toe,
            toe_depth=self.toe_depth, wall=self.wall, niche=(0.17, 0.19), density=self.foam,
        )  # fmt: skip

    @property
    def door_span(self) -> tuple[float, float]:
        """z of the doors' lower and upper edge."""
        top = self.case.top - (self.canopy if self.has_canopy else 0.0)
        return self.case.toe_height + 0.008, top - 0.008

    @cached_property
    def rooms(self) -> list[tuple[Cell, LinedCavity]]:
        """A room behind each door, from the left."""
        c, (low, high) = self.case, self.door_span
        step = 2.0 * c.half / self.doors
        cells = []
        for k in range(self.doors):
            x0, x1 = -c.half + k * step, -c.half + (k + 1) * step
            if k == self.doors - 1:
                x1 = c.half
            cell = ((x0, low), (x1, c.top))
            room = c.room(cell, corner=self.corner)
            (a, b, e), (f, g, _) = room.low, room.high
            ceiling = min(room.high[2], high - 0.72 * self.wall)
            cells.append((cell, LinedCavity(low=(a, b, e), high=(f, g, ceiling),
                                            corner=room.corner, lining=room.lining)))  # fmt: skip
        return cells

    @cached_property
    def leaves(self) -> list[ColdLeaf]:
        """The doors, from the left."""
        made = []
        low, high = self.door_span
        for k, (((x0, _), (x1, _)), _) in enumerate(self.rooms):
            left = self.hinge_left if self.doors == 1 else k == 0
            hinge: Hinge = "left" if left else "right"
            outer = 0.0 if self.doors == 1 else SEAM / 2.0
            width = x1 - x0 - outer
            name = "door" if self.doors == 1 else ("left_door", "right_door")[k]
            made.append(
                ColdLeaf(
                    name=name, hinge=hinge, corner=(x0 if left else x1, 0.0, low), width=width,
                    length=high - low, thickness=self.door, gap=self.gap, inset=self.inset,
                    setback=self.inset,
                    seal_inset=self.inset + 0.0015,
                )
            )  # fmt: skip
        return made

    def glazed(self, leaf: ColdLeaf) -> GlazedDoor:
        """A door's works."""
        length = min(0.62, self.handle_share * leaf.length)
        handle = Handle(style=self.pull, length=length, radius=self.handle_radius,
                        standoff=self.standoff)  # fmt: skip
        return GlazedDoor(leaf=leaf, frame=self.frame, rail=self.rail, low_rail=self.low_rail,
                          pull=self.pull, handle=handle, lock=self.lock)  # fmt: skip

    def shelves(self, room: LinedCavity) -> list[FlatShelf]:
        """From the lowest."""
        (x0, _, z0), (x1, y1, z1) = room.low, room.high
        floor, ceiling = max(z0, self.case.step[1]), z1 - BAR
        count = max(1, min(7 - 2 * self.doors, round((ceiling - floor) / self.shelf_pitch)))
        start = self.case.step[1] + 0.035
        step = (ceiling - start) / count
        wires = self.wires if self.doors == 1 else 7 if self.shelf == "slats" else 10
        return [
            FlatShelf(
                left=x0 + SIDE_PLAY, right=x1 - SIDE_PLAY, front=0.016, back=y1 - COVER - 0.0025,
                top=start + k * step, style=self.shelf, wires=wires, radius=self.wire,
            )
            for k in range(count)
        ]  # fmt: skip

    def level_room(self, room: LinedCavity, k: int) -> float:
        """Height between shelf k and what lies above it."""
        shelves = self.shelves(room)
        above = shelves[k + 1].top - shelves[k + 1].depth - 0.01 if k + 1 < len(shelves) else (
            room.high[2] - BAR - 0.014)  # fmt: skip
        return above - shelves[k].top

    def kind_on(self, room: LinedCavity, k: int, number: int) -> str:
        """What stands on shelf k of room `number`: the stock's kind if it fits, else cans."""
        kind = self.stock[(k + number) % len(self.stock)]
        fits = self.level_room(room, k) > CONTAINERS[kind].height + 0.01 if kind != "none" else True
        if fits:
            return kind
        small = self.level_room(room, k) > CONTAINERS["can"].height + 0.01
        return "can" if small else "none"

    def ranks_on(self, k: int) -> tuple[int, int]:
        """Most columns and ranks of containers on a shelf."""
        most = ON_A_SHELF[self.doors]
        columns = max(2, round(self.fill[k % len(self.fill)] * most))
        return columns, 2 if 2 * columns <= most else 1

    def clear_at(self, leaf: ColdLeaf) -> float:
        """Angle, rad, from which on a door is out of the way of what slides out behind it."""
        seal = leaf.seal_inset
        corners = [(0.0, leaf.back), (leaf.width, leaf.back), (seal, -SEAL_PLAY),
                   (leaf.width - seal, -SEAL_PLAY)]  # fmt: skip
        return leaf.clearing_angle(corners, beside=self.wall + SIDE_PLAY - 0.003)

    def upper(self, leaf: ColdLeaf) -> float:
        """How far a door opens, rad."""
        wanted = max(math.radians(self.opening_deg), self.clear_at(leaf) + math.radians(2.0))
        return min(wanted, leaf.widest())


def rails_hold_gasket(p: BeverageParams) -> bool:
    """The frame is as wide as the gasket that is clipped into it."""
    return p.rail >= p.inset + 0.0015 + 0.014 and p.low_rail >= p.rail - 0.004


def mullion_carries_gaskets(p: BeverageParams) -> bool:
    """Both gaskets lie on the post between two rooms."""
    return p.doors == 1 or 0.72 * p.wall >= p.inset + 0.0155 - 0.004
