"""What varies in an office chair, and the measures that follow from it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.generators.kit.armrest import Armrest
from artgen.generators.kit.caster import Caster
from artgen.generators.kit.chair_back import ChairBack, Style
from artgen.generators.kit.gas_lift import TAPER, Cover, GasLift
from artgen.generators.kit.office_seat import OfficeSeat
from artgen.generators.kit.star_base import REST, StarBase

SEAT_GAP = 0.002
"""m; between the column's shoulder and the seat's mechanism."""


@dataclass(frozen=True, kw_only=True)
class OfficeChairParams:
    """Lengths in m, forces in N, torques in N m."""

    wheel_radius: float
    wheel_width: float
    trail: float
    hood: float
    caster_turns: tuple[int, ...]
    front_arm: bool
    reach: float
    hub_radius: float
    hub_height: float
    arm_root: float
    arm_tip: float
    arch: float
    rise: float
    cover: Cover
    travel: float
    lift_friction: float
    seat_width: float
    seat_depth: float
    cushion: float
    crown: float
    fall: float
    dish: float
    seat_corner: float
    panel: bool
    knob: bool
    back: Style
    back_width: float
    back_height: float
    back_gap: float
    lean: float
    bow: float
    lumbar: float
    back_corner: float
    taper: float
    padding: float
    cushions: int
    spine_width: float
    tilt_deg: float
    tilt_preload: float
    arms: str
    arm_height: float
    pad_length: float
    pad_width: float
    arm_travel: float
    headrest: bool
    head_height: float
    head_travel: float
    tilt_lever: bool
    cloth: str

    @property
    def caster(self) -> Caster:
        """One of the five casters."""
        return Caster(
            radius=self.wheel_radius,
            width=self.wheel_width,
            trail=self.trail,
            stem=0.016,
            hood=self.hood,
        )

    @property
    def star(self) -> StarBase:
        """The foot."""
        return StarBase(
            arms=5,
            heading=math.pi * (1.5 if self.front_arm else 0.5),
            reach=self.reach,
            low=self.caster.shoulder + REST,
            socket=0.018,
            rise=self.rise,
            hub=(self.hub_radius, self.hub_height),
            root=(self.arm_root, 0.95 * self.arm_root),
            tip=(self.arm_tip, 0.026),
            arch=self.arch,
        )

    @property
    def lift(self) -> GasLift:
        """The column."""
        star = self.star
        return GasLift(
            low=star.hub_low - 0.006, hub=star.hub_high, travel=self.travel, cover=self.cover
        )

    @property
    def seat(self) -> OfficeSeat:
        """The seat at its lowest."""
        lift = self.lift
        return OfficeSeat(
            base=lift.shoulder + SEAT_GAP,
            socket=(lift.head, TAPER + 0.0009),
            width=self.seat_width,
            depth=self.seat_depth,
            thickness=self.cushion,
            crown=self.crown,
            fall=self.fall,
            dish=self.dish,
            corner=(self.seat_corner, 0.8 * self.seat_corner),
            panel=self.panel,
            knob=self.knob,
        )

    @property
    def chair_back(self) -> ChairBack:
        """The back, upright."""
        seat = self.seat
        depth = self.lumbar if self.back == "net" else self.padding
        return ChairBack(
            style=self.back,
            width=self.back_width,
            height=self.back_height * (1.18 if self.back == "panels" else 1.0),
            low=seat.top + self.back_gap,
            front=seat.rear + 0.010 + self.bow + depth,
            lean=self.lean,
            bow=self.bow,
            lumbar=self.lumbar,
            corner=self.back_corner,
            taper=self.taper,
            padding=self.padding,
            cushions=self.cushions,
        )

    @property
    def armrest(self) -> Armrest:
        """The armrest at +x."""
        seat = self.seat
        return Armrest(
            x=seat.width / 2.0 + 0.5 * self.pad_width + 0.004,
            y=0.010,
            mount=seat.pan,
            top=seat.top + self.arm_height,
            length=self.pad_length,
            width=self.pad_width,
            travel=self.arm_travel,
        )

    @property
    def tilt(self) -> float:
        """How far the back leans, rad."""
        return math.radians(self.tilt_deg)

    @property
    def levers(self) -> dict[str, int]:
        """Name of each lever and the side that it stands out on."""
        return {"lift_lever": -1, **({"tilt_lever": 1} if self.tilt_lever else {})}


def back_fits_between_arms(p: OfficeChairParams) -> bool:
    """The back tilts between the armrests' pads."""
    arm = p.armrest
    return p.arms == "none" or p.back_width / 2.0 + 0.006 < arm.x - arm.width / 2.0


def few_files(p: OfficeChairParams) -> bool:
    """A second lever only where an armrest or the headrest is spared."""
    return not (p.tilt_lever and p.headrest and p.arms == "adjustable")


def low_backs_have_no_headrest(p: OfficeChairParams) -> bool:
    """A headrest stands on a back that reaches the shoulders."""
    return not p.headrest or p.back_height > 0.50


def arms_clear_the_pan(p: OfficeChairParams) -> bool:
    """The sleeve is long enough to guide the post."""
    low, high = p.armrest.sleeve_ends
    return high - low > p.arm_travel + 0.035


INVARIANTS: Mapping[str, Callable[[OfficeChairParams], bool]] = {
    check.__name__: check
    for check in (
        back_fits_between_arms,
        few_files,
        low_backs_have_no_headrest,
        arms_clear_the_pan,
    )
}
