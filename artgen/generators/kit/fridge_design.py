"""Refrigerators: what varies, how a case is divided, and what shuts each room."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from artgen.generators.kit.cold_case import Cell, ColdCase
from artgen.generators.kit.cold_leaf import ColdLeaf, Hinge
from artgen.generators.kit.door_pull import DoorPull, PullStyle
from artgen.generators.kit.handle import Handle
from artgen.generators.kit.insulated_door import InsulatedDoor
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.pull_out_bin import PanelStyle

FridgeLayout = Literal[
    "mini", "larder", "top_freezer", "bottom_freezer", "bottom_drawer", "french", "side_by_side",
    "four_door",
]  # fmt: skip
Closing = Literal["door", "pair", "drawer"]
SIZES: dict[FridgeLayout, tuple[tuple[float, float], ...]] = {
    "mini": ((0.470, 0.560), (0.44, 0.54), (0.82, 0.88)),
    "larder": ((0.540, 0.600), (0.54, 0.60), (1.25, 1.86)),
    "top_freezer": ((0.540, 0.760), (0.55, 0.66), (1.43, 1.78)),
    "bottom_freezer": ((0.545, 0.700), (0.56, 0.64), (1.70, 2.03)),
    "bottom_drawer": ((0.700, 0.800), (0.60, 0.68), (1.70, 1.80)),
    "french": ((0.830, 0.915), (0.62, 0.72), (1.74, 1.83)),
    "side_by_side": ((0.880, 0.915), (0.62, 0.70), (1.74, 1.80)),
    "four_door": ((0.830, 0.915), (0.60, 0.70), (1.78, 1.90)),
}
"""Width, depth of the case, height, m."""
SEAM = 0.004
"""m; between doors side by side."""
LEVEL_SEAM = 0.0115
"""m; between doors above each other, where the hinge plates lie."""
RUNNER = 0.012
"""m; room for runners beside bins and baskets."""
STOP = 0.035
"""rad that a door opens further than what slides out behind it needs."""
AIR = 0.012
"""m; between what is on a door and what stands in the room."""


@dataclass(frozen=True, kw_only=True)
class Zone:
    """A room's share of the front and how it is shut.

    Attributes:
        name: prefix of its parts.
        cell: of the case.
        cold: chilled or frozen.
        closing: one door, two doors that meet in the middle, or a drawer.
        hinge: of a single door.
    """

    name: str
    cell: Cell
    cold: Literal["fridge", "freezer"]
    closing: Closing
    hinge: Hinge = "right"


@dataclass(frozen=True, kw_only=True)
class FridgeParams:
    """Sampled values; units as in the rule file."""

    layout: FridgeLayout
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
    setback: float
    corner: float
    freezer_share: float
    hinge_left: bool
    pull: PullStyle
    handle_share: float
    handle_radius: float
    standoff: float
    handle_inset: float
    shelf_pitch: float
    shelf_shares: tuple[float, ...]
    crispers: int
    crisper_height: float
    bin_style: PanelStyle
    door_bins: int
    bin_depth: float
    bin_height: float
    freezer_inside: Literal["drawers", "shelves"]
    freezer_drawers: int
    drawer_fill: float
    dispenser: bool
    panel: bool
    control: Literal["dial", "digital"]
    led: str
    temperature: int
    lamp: float
    bars: int
    upright_bars: bool
    coil: bool
    brand: int
    groceries: tuple[str, ...]
    label: int
    foam: float
    door_foam: float
    compressor: float
    opening_deg: float
    travel: float
    friction: float
    slide_friction: float
    latch: float

    @cached_property
    def size(self) -> tuple[float, float, float]:
        """Width, depth of the case, height."""
        shares = (self.width_share, self.depth_share, self.height_share)
        w, d, h = (a + s * (b - a) for (a, b), s in zip(SIZES[self.layout], shares, strict=True))
        return w, d, h

    @cached_property
    def case(self) -> ColdCase:
        """The foamed case."""
        w, d, h = self.size
        return ColdCase(
            half=w / 2.0, depth=d, foot=self.foot, top=h, toe_height=self.foot + self.toe,
            toe_depth=self.toe_depth, wall=self.wall, niche=(0.17, 0.19), density=self.foam,
        )  # fmt: skip

    @cached_property
    def zones(self) -> list[Zone]:
        """From below, left before right."""
        a, low, top = self.case.half, self.case.toe_height + 0.009, self.case.top
        single: Hinge = "left" if self.hinge_left else "right"
        whole: Cell = ((-a, low), (a, top))
        if self.layout in ("mini", "larder"):
            return [Zone(name="fridge", cell=whole, cold="fridge", closing="door", hinge=single)]
        if self.layout == "side_by_side":
            x = -a + 2.0 * a * (0.40 + 0.25 * (self.freezer_share - 0.3))
            return [
                Zone(name="freezer", cell=((-a, low), (x, top)), cold="freezer", closing="door",
                     hinge="left"),
                Zone(name="fridge", cell=((x, low), (a, top)), cold="fridge", closing="door",
                     hinge="right"),
            ]  # fmt: skip
        if self.layout == "top_freezer":
            z = top - 0.9 * self.freezer_share * (top - low)
            return [
                Zone(name="fridge", cell=((-a, low), (a, z)), cold="fridge", closing="door",
                     hinge=single),
                Zone(name="freezer", cell=((-a, z), (a, top)), cold="freezer", closing="door",
                     hinge=single),
            ]  # fmt: skip
        return self._freezer_below(low, top, single)

    def _freezer_below(self, low: float, top: float, single: Hinge) -> list[Zone]:
        a = self.case.half
        z = low + 1.1 * self.freezer_share * (top - low)
        upper: Cell = ((-a, z), (a, top))
        closing: Closing = "door" if self.layout in ("bottom_freezer", "bottom_drawer") else "pair"
        fridge = Zone(name="fridge", cell=upper, cold="fridge", closing=closing, hinge=single)
        if self.layout == "four_door":
            return [
                Zone(name="left_freezer", cell=((-a, low), (0.0, z)), cold="freezer",
                     closing="door", hinge="left"),
                Zone(name="right_freezer", cell=((0.0, low), (a, z)), cold="freezer",
                     closing="door", hinge="right"),
                fridge,
            ]  # fmt: skip
        below: Closing = "door" if self.layout == "bottom_freezer" else "drawer"
        return [
            Zone(name="freezer", cell=((-a, low), (a, z)), cold="freezer", closing=below,
                 hinge=single),
            fridge,
        ]  # fmt: skip

    def room(self, zone: Zone) -> LinedCavity:
        """The lined room of a zone."""
        return self.case.room(zone.cell, corner=self.corner)

    def leaves(self, zone: Zone) -> list[ColdLeaf]:
        """What shuts it, from the left."""
        (x0, z0), (x1, z1) = zone.cell
        half = LEVEL_SEAM / 2.0
        low = z0 if z0 < self.case.toe_height + 0.01 else z0 + half
        high = z1 - (0.009 if z1 > self.case.top - 1e-9 else half)
        left = x0 + (0.0 if x0 < -self.case.half + 1e-9 else SEAM / 2.0)
        right = x1 - (0.0 if x1 > self.case.half - 1e-9 else SEAM / 2.0)
        if zone.closing == "pair":
            seam = (x0 + x1 - SEAM) / 2.0, (x0 + x1 + SEAM) / 2.0
            return [
                self._leaf(f"{zone.name}_left_door", "left", (left, seam[0]), low, high),
                self._leaf(f"{zone.name}_right_door", "right", (seam[1], right), low, high),
            ]
        if zone.closing == "drawer":
            return [self._leaf(f"{zone.name}_drawer", "left", (left, right), low, high)]
        return [self._leaf(f"{zone.name}_door", zone.hinge, (left, right), low, high)]

    def _leaf(
        self, name: str, hinge: Hinge, span: tuple[float, float], low: float, high: float
    ) -> ColdLeaf:
        return ColdLeaf(
            name=name, hinge=hinge, corner=(span[0] if hinge == "left" else span[1], 0.0, low),
            width=span[1] - span[0], length=high - low, thickness=self.door, gap=self.gap,
            inset=self.inset, setback=self.setback, seal_inset=self.inset + 0.0015,
        )  # fmt: skip

    def pull_of(self, leaf: ColdLeaf, zone: Zone) -> DoorPull:
        """Handles lie where a hand reaches them: low on upper doors, high on lower ones."""
        drawer = zone.closing == "drawer"
        longest = 0.86 * leaf.width if drawer else 0.80 * leaf.length
        length = min(0.75, longest, self.handle_share * (leaf.width if drawer else leaf.length))
        handle = Handle(style=self.pull, length=length, radius=self.handle_radius,
                        standoff=self.standoff)  # fmt: skip
        reach = length / 2.0 + 0.05
        hand = 1.05 - leaf.corner[2]
        level = min(max(hand, reach), leaf.length - reach)
        return DoorPull(leaf=leaf, style=self.pull, handle=handle, inset=self.handle_inset,
                        level=level, drawer=drawer)  # fmt: skip

    def door_of(self, leaf: ColdLeaf, zone: Zone) -> InsulatedDoor:
        """A door with its liner and bins."""
        room = self.room(zone)
        (x0, _, z0), (x1, _, z1) = room.low, room.high
        corner = leaf.corner
        near, far = (x0 - corner[0], x1 - corner[0]) if leaf.hinge == "left" else (
            corner[0] - x1, corner[0] - x0)  # fmt: skip
        if zone.closing == "pair":
            far = leaf.width + SEAM / 2.0 + 0.004
        drawers = zone.cold == "freezer" and self._has_drawers(zone)
        low, high = z0 - corner[2], z1 - corner[2]
        bins = () if drawers else self._bins(low + 0.05, high - 0.06)
        return InsulatedDoor(
            leaf=leaf, pull=self.pull_of(leaf, zone), near=near, far=far, low=low, high=high,
            rim=0.016 if drawers else 0.024, bins=bins, bin_depth=self.bin_depth,
            foam=self.door_foam,
        )  # fmt: skip

    def _bins(self, low: float, high: float) -> tuple[tuple[float, float], ...]:
        """z and height of the bins: the lowest is the highest, for bottles."""
        room = high - low
        most = min(self.door_bins, 2) if self.layout == "four_door" else self.door_bins
        count = max(1, min(most, int(room / 0.20)))
        step = room / count
        return tuple(
            (low + k * step, (1.25 if k == 0 else 1.0) * self.bin_height) for k in range(count)
        )

    def _has_drawers(self, zone: Zone) -> bool:
        tall = zone.cell[1][1] - zone.cell[0][1] > 0.45 and zone.name != "right_freezer"
        return self.freezer_inside == "drawers" and zone.closing == "door" and tall

    def inside_front(self, zone: Zone) -> float:
        """y where things in a room may begin."""
        if zone.cold == "freezer" and self._has_drawers(zone):
            return 0.016 + AIR
        return self.bin_depth + AIR

    def has_drawers(self, zone: Zone) -> bool:
        """A freezer with pull-out drawers behind its door."""
        return zone.cold == "freezer" and self._has_drawers(zone)

    def back_at(self, room: LinedCavity, low: float) -> float:
        """y where things that begin at height `low` have to end."""
        stepped = room.low[2] < self.case.step[1] - 0.01 and low < self.case.step[1]
        return (self.case.step[0] if stepped else room.high[1]) - 0.0025

    def needed(self, zone: Zone, leaf: ColdLeaf) -> float:
        """Angle, rad, at which a door is out of the way of what slides out next to its hinge."""
        beside = leaf_wall(zone, self.room(zone), leaf) + RUNNER
        return leaf.clearing_angle(self.door_of(leaf, zone).corners(), beside=beside - 0.004)

    @property
    def has_control(self) -> bool:
        """A knob or a display inside; none where the door carries one."""
        return not (self.has_dispenser or self.panel)

    @property
    def opening(self) -> float:
        """rad."""
        return math.radians(self.opening_deg)

    @property
    def has_dispenser(self) -> bool:
        """Ice and water in the door of the larger ones."""
        return self.dispenser and self.layout in ("side_by_side", "french", "four_door")


def leaf_wall(zone: Zone, room: LinedCavity, leaf: ColdLeaf) -> float:
    """x of the room's wall at the hinge, in the leaf's drawing."""
    corner = leaf.corner[0]
    return room.low[0] - corner if leaf.hinge == "left" else corner - room.high[0]


def doors_hold_bins(p: FridgeParams) -> bool:
    """Every room is deep enough for a shelf behind the bins."""
    return p.size[1] - p.wall - p.bin_depth > 0.26


def doors_open_far_enough(p: FridgeParams) -> bool:
    """Doors turn out of the way of crispers and drawers before they meet the case."""
    return all(
        p.needed(zone, leaf) + STOP <= leaf.widest()
        for zone in p.zones
        if zone.closing != "drawer"
        for leaf in p.leaves(zone)
    )


def freezer_holds_something(p: FridgeParams) -> bool:
    """No freezer is lower than 0.36 m."""
    return all(z.cell[1][1] - z.cell[0][1] > 0.36 for z in p.zones)
