"""Microwave ovens: what varies, and where things lie."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.control_panel import ControlPanel
from artgen.generators.kit.dial import DialStyle
from artgen.generators.kit.glass_turntable import GlassTurntable
from artgen.generators.kit.heel_door import HeelDoor
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.window_leaf import Window

SEAM = 0.0018
"""m; between door and panel."""
GAP = 0.0015
"""m; between door and front flange."""
LINER, FLANGE = 0.0025, 0.004
"""m; lining and front flange as drawn; their densities are scaled to 0.6 mm of steel."""
SCOOP = 0.018
"""m; how far a finger scoop reaches into the panel."""
BORDER = 0.004
"""m; of the panel around its foil."""
TIMES = ("12:30", "8:45", "1:30", "0:30", "17:05", "9:00")


@dataclass(frozen=True, kw_only=True)
class MicrowaveParams:
    """Sampled values; units as in the rule file."""

    form: Literal["side", "drop"]
    width: float
    height: float
    depth: float
    door: float
    foot: float
    heel: float
    panel_share: float
    wall_left: float
    wall_rear: float
    wall_low: float
    wall_top: float
    corner: float
    ribs: int
    platform: Literal["turntable", "flatbed"]
    plate_share: float
    rollers: int
    control: Literal["keypad", "dials", "jog"]
    buttons: int
    dial: DialStyle
    dial_share: float
    brand: int
    time: int
    led: str
    opening: Literal["bar", "square", "bow", "button", "scoop"]
    handle_share: float
    handle_radius: float
    standoff: float
    border: float
    free_border: float
    radius: float
    skin_share: float
    vents: int
    vent_height: float
    lamp: float
    heft: float
    opening_deg: float
    friction: float
    latch: float

    @property
    def half(self) -> float:
        """Half of the width."""
        return self.width / 2.0

    @property
    def has_handle(self) -> bool:
        """A handle stands on the door."""
        return self.opening in ("bar", "square", "bow")

    @property
    def face(self) -> float:
        """y of the front of door and panel."""
        return -GAP - self.door

    @property
    def split(self) -> float:
        """Where the panel begins: x beside the door, or z above it."""
        if self.form == "side":
            return self.half - self.panel_share * self.width
        return self.height - 0.50 * self.panel_share * self.width

    @property
    def cavity(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Lower and upper corner of the cooking space."""
        side = self.form == "side"
        right = self.split - 0.028 if side else self.half - self.wall_left
        top = self.height - self.wall_top if side else self.split - 0.026
        low = (-self.half + self.wall_left, 0.0, self.foot + self.wall_low)
        return low, (right, self.depth - self.wall_rear, top)

    @cached_property
    def lined(self) -> LinedCavity:
        """The cooking space with its lining, behind the front flange."""
        (x0, _, z0), high = self.cavity
        return LinedCavity(low=(x0, FLANGE, z0), high=high, corner=self.corner, lining=LINER)

    @cached_property
    def leaf(self) -> HeelDoor:
        """The door."""
        tall = self.height - self.foot
        side = self.form == "side"
        width = (self.split + self.half if side else self.split - self.foot) - SEAM
        length = tall if side else self.width
        return HeelDoor(
            hinge="left" if side else "bottom",
            corner=(-self.half, 0.0, self.foot),
            width=width,
            length=length,
            thickness=self.door,
            gap=GAP,
            heel=self.heel,
            ears=(0.030, length - 0.030),
        )

    @cached_property
    def window(self) -> Window:
        """The glazed opening of the door, in the door's drawing."""
        d = self.leaf
        free = self.free_border + (0.022 if self.has_handle else 0.0)
        return Window(
            lower=(self.heel + 0.016 + self.border, self.border + 0.010),
            upper=(d.width - free, d.length - self.border - 0.010),
            radius=self.radius,
        )

    @cached_property
    def panel_block(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Lower and upper corner of the panel's housing."""
        high = (self.half, 0.0, self.height)
        if self.form == "side":
            return (self.split, self.face, self.foot), high
        return (-self.half, self.face, self.split), high

    @cached_property
    def panel(self) -> ControlPanel:
        """What is on it."""
        (x0, y0, z0), (x1, _, z1) = self.panel_block
        inset = SCOOP + BORDER if self.opening == "scoop" else BORDER
        low = (x0 + inset, z0 + BORDER) if self.form == "side" else (x0 + BORDER, z0 + inset)
        size = (x1 - BORDER - low[0], z1 - BORDER - low[1])
        return ControlPanel(
            plane=PanelPlane(
                origin=(low[0], y0, low[1]), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=size
            ),
            kind=self.control,
            buttons=self.buttons,
            release=self.opening == "button",
            dial=self.dial,
            dial_share=self.dial_share,
            brand=self.brand,
            time=TIMES[self.time],
            led=self.led,
            tagline="800 W",
        )

    @cached_property
    def turntable(self) -> GlassTurntable:
        """The plate in the middle of the cavity's floor."""
        (x0, _, z0), (x1, y1, _) = self.cavity
        return GlassTurntable(
            center=((x0 + x1) / 2.0, y1 / 2.0),
            floor=z0,
            radius=self.plate_share * min(x1 - x0, y1) / 2.0,
            rollers=self.rollers,
        )


def drop_door_has_no_button(p: MicrowaveParams) -> bool:
    """Release buttons lie below upright panels; drop-down doors are pulled."""
    return p.form == "side" or p.opening != "button"


def window_is_wide(p: MicrowaveParams) -> bool:
    """At least 100 mm of the window's height and width remain."""
    w = p.window
    return w.upper[0] - w.lower[0] > 0.10 and w.upper[1] - w.lower[1] > 0.10


def heel_fits_door(p: MicrowaveParams) -> bool:
    """The pin lies in the rear half of the door and leaves the skin whole."""
    return 1.9 * p.heel < p.door - 0.004


def open_door_clears_table(p: MicrowaveParams) -> bool:
    """The lower edge of a drop-down door turns under its pin and stays above the table."""
    return p.form == "side" or p.foot + 2.0 * p.heel - p.door > 0.002
