"""Front-loading washing machines: what varies, and where things lie."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.control_panel import ControlPanel
from artgen.generators.kit.dial import DialStyle
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.porthole_door import PortholeDoor
from artgen.generators.kit.wash_drum import TUB, WashDrum

FASCIA = 0.014
"""m; how far the panel stands in front of the cabinet."""
GAP = 0.003
"""m; between the door's ring and the cabinet."""
TIMES = ("1:49", "2:35", "0:30", "3:20", "1:00")


@dataclass(frozen=True, kw_only=True)
class WasherParams:
    """Sampled values; units as in the rule file."""

    width: float
    height: float
    depth: float
    foot: float
    panel_height: float
    worktop: float
    opening: float
    rim: float
    door_drop: float
    thickness: float
    bowl: float
    covered: bool
    grip: Literal["scoop", "bulge"]
    opening_deg: float
    friction: float
    latch: float
    lip: float
    drum_margin: float
    paddles: int
    paddle_height: float
    tub_front: float
    tub_rear: float
    drum_friction: float
    drawer_side: Literal["left", "right"]
    drawer_width: float
    drawer_depth: float
    drawer_lip: float
    cups: int
    console: Literal["washer", "washer_right", "washer_touch"]
    endless: bool
    buttons: int
    dial: DialStyle
    dial_share: float
    brand: int
    time: int
    led: str
    flap: Literal["left", "right", "none"]
    flap_size: float
    kick: float
    heft: float

    @property
    def half(self) -> float:
        """Half of the width."""
        return self.width / 2.0

    @property
    def top(self) -> float:
        """z below the worktop."""
        return self.height - self.worktop

    @property
    def split(self) -> float:
        """z where the panel begins."""
        return self.top - self.panel_height

    @property
    def center(self) -> float:
        """z of door and drum."""
        return self.split - self.rim - self.door_drop

    @cached_property
    def door(self) -> PortholeDoor:
        """The round door."""
        return PortholeDoor(
            center=self.center,
            rim=self.rim,
            mouth=self.opening - self.lip - 0.008,
            lip=self.opening - self.lip,
            thickness=self.thickness,
            gap=GAP,
            bowl=self.bowl,
            covered=self.covered,
            grip=self.grip,
        )

    @cached_property
    def drum(self) -> WashDrum:
        """Behind the bellows."""
        return WashDrum(
            center=self.center,
            radius=self.half - self.drum_margin,
            mouth=self.opening - 0.004,
            front=self.tub_front + 0.008,
            back=self.depth - self.tub_rear,
            paddles=self.paddles,
            paddle_height=self.paddle_height,
        )

    @cached_property
    def drawer_room(self) -> LinedCavity:
        """The detergent drawer's compartment."""
        left = -self.half + 0.018
        if self.drawer_side == "right":
            left = self.half - 0.018 - self.drawer_width
        return LinedCavity(
            low=(left, -FASCIA, self.split + 0.012),
            high=(left + self.drawer_width, self.drawer_depth, self.top - 0.012),
            corner=0.003,
            lining=0.0015,
        )

    @cached_property
    def panel(self) -> ControlPanel:
        """Beside the drawer."""
        border, (x0, _, _), (x1, _, _) = 0.003, self.drawer_room.low, self.drawer_room.high
        low, high = x1 + 0.012, self.half - border
        if self.drawer_side == "right":
            low, high = -self.half + border, x0 - 0.012
        return ControlPanel(
            plane=PanelPlane(
                origin=(low, -FASCIA, self.split + border),
                right=(1.0, 0.0, 0.0),
                up=(0.0, 0.0, 1.0),
                size=(high - low, self.panel_height - 2.0 * border),
            ),
            kind=self.console,
            buttons=self.buttons,
            release=False,
            dial=self.dial,
            dial_share=self.dial_share,
            brand=self.brand,
            time=TIMES[self.time],
            led=self.led,
            endless=self.endless,
            tagline=f"{6 + round(20.0 * (self.depth - 0.43))} kg  1400",
        )

    @property
    def flap_corner(self) -> tuple[float, float]:
        """(x, z) of the filter flap's lower left corner."""
        x = self.half - 0.035 - self.flap_size
        return (x if self.flap == "right" else -self.half + 0.035), self.foot + 0.020


def tub_fits(p: WasherParams) -> bool:
    """The tub leaves room for the drawer above it and for pump and suspension below."""
    reach = p.drum.radius + TUB + 0.004
    return p.center + reach < p.split + 0.004 and p.center - reach > p.foot + 0.035


def door_clears_flap(p: WasherParams) -> bool:
    """The ring ends above the kick strip and the flap, and beside the cabinet's edges."""
    if p.center - p.rim < p.foot + p.kick + 0.012 or p.rim + 0.030 > p.half:
        return False
    if p.flap == "none":
        return True
    x, z = p.flap_corner
    near = x if p.flap == "right" else x + p.flap_size
    return math.hypot(near, p.center - z - p.flap_size) > p.rim + 0.012


def ring_covers_opening(p: WasherParams) -> bool:
    """The ring's rim lies on the cabinet around the opening."""
    return p.rim > p.opening + 0.030


def bowl_stays_before_drum(p: WasherParams) -> bool:
    """The bowl reaches into the drum's mouth, not beyond its first third."""
    return p.bowl < p.tub_front + 0.3 * (p.drum.back - p.drum.front) and p.bowl > 0.05
