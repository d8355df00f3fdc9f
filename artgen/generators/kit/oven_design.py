"""Ovens: what varies, and where things lie; built into furniture or as ranges with a hob."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.control_panel import ControlPanel
from artgen.generators.kit.dial import DialStyle
from artgen.generators.kit.heel_door import HeelDoor
from artgen.generators.kit.hob import Hob, zone_radii
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.oven_rack import OvenRack, RackLadders
from artgen.generators.kit.window_leaf import Window

GAP = 0.003
"""m; between door and front frame, where the seal lies."""
SEAM = 0.004
"""m; between door and panel."""
FRAME = 0.012
"""m; thickness of the front frame."""
TIMES = ("12:30", "18:45", "7:05", "0:25", "21:40")
CLASS = {"built_in": 0.595, "compact": 0.455}
"""m; heights of built-in fronts (EN 1116)."""


@dataclass(frozen=True, kw_only=True)
class OvenParams:
    """Sampled values; units as in the rule file."""

    form: Literal["built_in", "compact", "range"]
    range_width: float
    play: float
    range_height: float
    depth: float
    door: float
    heel: float
    panel_height: float
    vent_strip: float
    wall_side: float
    wall_low: float
    wall_top: float
    wall_rear: float
    corner: float
    levels: int
    racks: int
    tray: bool
    tray_depth: float
    bars: int
    bar: float
    travel: float
    fan: Literal["round", "square", "none"]
    fan_radius: float
    fan_holes: int
    grill_loops: int
    lamp: float
    console: Literal["knobs", "touch", "timer"]
    range_console: Literal["range", "range_plain"]
    dial: DialStyle
    dial_share: float
    brand: int
    time: int
    led: str
    handle: Literal["bar", "square", "bow"]
    handle_share: float
    handle_radius: float
    standoff: float
    border: float
    radius: float
    skin_share: float
    hob: Literal["gas", "plates", "ceramic"]
    zone_scale: float
    zone_order: int
    zone_style: int
    backguard: bool
    guard_height: float
    drawer: bool
    drawer_height: float
    foot: float
    heft: float
    latch: float

    @property
    def is_range(self) -> bool:
        """Stands on the floor and carries a hob."""
        return self.form == "range"

    @property
    def width(self) -> float:
        """m, of the front."""
        return (self.range_width if self.is_range else 0.595) - self.play

    @property
    def half(self) -> float:
        """Half of it."""
        return self.width / 2.0

    @property
    def body_half(self) -> float:
        """Half the width of the housing: built-in ones pass through a 560 mm recess."""
        return self.half if self.is_range else 0.275

    @property
    def top(self) -> float:
        """z of the front's upper edge: below the hob, or the front's height class."""
        return self.range_height - 0.035 if self.is_range else CLASS[self.form] - self.play

    @property
    def sill(self) -> float:
        """z above the feet, or above the recess's floor, where the housing begins."""
        return self.foot if self.is_range else 0.006

    @property
    def dip(self) -> float:
        """How far the front's lower edge swings below the door."""
        return math.hypot(self.heel, self.door - self.heel) - self.heel

    @property
    def door_low(self) -> float:
        """z of the door's lower edge."""
        clear = self.dip + 0.004
        below = self.sill + self.drawer_height if self.is_range else 0.002
        return below + max(clear, self.vent_strip)

    @property
    def split(self) -> float:
        """z where the panel begins."""
        return self.top - self.panel_height

    @property
    def face(self) -> float:
        """y of the front of door and panel."""
        return -GAP - self.door

    @cached_property
    def leaf(self) -> HeelDoor:
        """The door."""
        return HeelDoor(
            hinge="bottom",
            corner=(-self.half, 0.0, self.door_low),
            width=self.split - SEAM - self.door_low,
            length=self.width,
            thickness=self.door,
            gap=GAP,
            heel=self.heel,
            ears=(0.075, self.width - 0.075),
        )

    @cached_property
    def cavity(self) -> LinedCavity:
        """The oven's inside."""
        x = self.body_half - self.wall_side
        return LinedCavity(
            low=(-x, FRAME, self.door_low + self.wall_low),
            high=(x, self.depth - self.wall_rear, self.split - SEAM - self.wall_top),
            corner=self.corner,
            lining=0.003,
        )

    @cached_property
    def window(self) -> Window:
        """In the door, smaller than the cavity's mouth."""
        (x0, _, z0), (x1, _, z1) = self.cavity.low, self.cavity.high
        b = self.border
        return Window(
            lower=(z0 - self.door_low + 0.7 * b, x0 + self.half + b),
            upper=(min(z1 - self.door_low - 0.4 * b, self.leaf.width - 0.085), x1 + self.half - b),
            radius=self.radius,
        )

    @cached_property
    def panel(self) -> ControlPanel:
        """The controls above the door."""
        border = 0.003
        kind = self.range_console if self.is_range else self.console
        return ControlPanel(
            plane=PanelPlane(
                origin=(-self.half + border, self.face, self.split + border),
                right=(1.0, 0.0, 0.0),
                up=(0.0, 0.0, 1.0),
                size=(self.width - 2.0 * border, self.panel_height - 2.0 * border),
            ),
            kind=kind,
            buttons=2,
            release=False,
            dial=self.dial,
            dial_share=self.dial_share,
            brand=self.brand,
            time=TIMES[self.time],
            led=self.led,
        )

    @cached_property
    def ladders(self) -> RackLadders:
        """Rails at both walls."""
        (_, _, z0), (_, y1, z1) = self.cavity.low, self.cavity.high
        low, high = z0 + 0.055, z1 - 0.075
        return RackLadders(
            cavity=self.cavity,
            levels=tuple(float(z) for z in np.linspace(low, high, self.levels)),
            front=0.055,
            back=y1 - 0.060,
        )

    @cached_property
    def shelves(self) -> list[OvenRack]:
        """Racks from below, then the tray above them."""
        step = 2 if self.levels > 4 else 1
        names = ["rack" if self.racks == 1 else f"rack_{k + 1}" for k in range(self.racks)]
        if self.tray:
            names.append("baking_tray")
        return [
            OvenRack(
                name=name, ladders=self.ladders, level=min(self.levels - 1, step * k),
                front=0.034, back=self.cavity.high[1] - 0.045, bars=self.bars, bar=self.bar,
            )
            for k, name in enumerate(names)
        ]  # fmt: skip

    @cached_property
    def cooktop(self) -> Hob:
        """On a range."""
        scale = self.zone_scale * min(1.0, self.width / 0.58)
        return Hob(
            kind=self.hob,
            low=(-self.half + 0.004, self.face + 0.010),
            high=(self.half - 0.004, self.depth - 0.010),
            bottom=self.top + 0.0285,
            zones=zone_radii(scale, self.zone_order),
        )


def window_is_wide(p: OvenParams) -> bool:
    """At least 110 mm of the window's height remain."""
    return p.window.upper[0] - p.window.lower[0] > 0.11


def heel_fits_door(p: OvenParams) -> bool:
    """The pin lies in the rear of the door and leaves the skin whole."""
    return 1.9 * p.heel < (1.0 - p.skin_share) * p.door + 0.010


def shelves_have_levels(p: OvenParams) -> bool:
    """Each rack has its own pair of rails, with room for the stop of the rack below it."""
    used = [shelf.level for shelf in p.shelves]
    heights = [p.ladders.levels[level] for level in used]
    deep = [p.tray_depth + 0.045 if shelf.name == "baking_tray" else 0.045 for shelf in p.shelves]
    return len(set(used)) == len(used) and all(
        upper - lower > need
        for lower, upper, need in zip(heights[:-1], heights[1:], deep[1:], strict=True)
    )


def range_has_room(p: OvenParams) -> bool:
    """At least 260 mm of a range's height remain for its door."""
    return p.leaf.width > 0.26
