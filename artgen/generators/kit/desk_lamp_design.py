"""What varies in a desk lamp, and the measures that follow from it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.lamp_arm import ArmStyle, LampArm
from artgen.generators.kit.lamp_base import LampBase, PlateStyle
from artgen.generators.kit.lamp_head import HeadStyle, LampHead
from artgen.generators.kit.spring_balance import leaning

Point = tuple[float, float]
SOCKET = 0.0235
"""m; radius of a socket's cover."""
PLATE_HALF = 0.0190
"""m; half the height of the plates that hold an arm's two rods."""
ARM_HALF = 0.0130
"""m; half the thickness of an arm near the head."""


@dataclass(frozen=True, kw_only=True)
class DeskLampParams:
    """Lengths in m, angles in degrees."""

    plate: PlateStyle
    plate_size: float
    plate_height: float
    plate_crown: float
    post_back: float
    arm: ArmStyle
    lower: float
    upper: float
    girth: float
    springs: int
    back_deg: float
    dip_deg: float
    reach_deg: float
    lift_deg: float
    tilt_deg: float
    swivel: Literal["limited", "endless"]
    swivel_deg: float
    head: HeadStyle
    shade_radius: float
    shade_depth: float
    bar_half: float
    bar_width: float
    neck: float
    vents: bool
    switch: Literal["button", "dial", "long_button"]
    switch_size: float
    knob_left: bool
    lean_friction: float
    two_tone: bool
    brand: int

    @property
    def base(self) -> LampBase:
        """The foot."""
        plate = LampBase(
            style=self.plate, size=self.plate_size, height=self.plate_height,
            crown=self.plate_crown, post=0.0,
        )  # fmt: skip
        post = self.post_back * (plate.half_depth - 0.035)
        return LampBase(
            style=self.plate, size=self.plate_size, height=self.plate_height,
            crown=self.plate_crown, post=post,
        )  # fmt: skip

    @property
    def lower_arm(self) -> LampArm:
        """From turret to elbow."""
        return LampArm(style=self.arm, length=self.lower, girth=self.girth, springs=self.springs)

    @property
    def upper_arm(self) -> LampArm:
        """From elbow to head."""
        springs = max(self.springs - 1, 0)
        return LampArm(style=self.arm, length=self.upper, girth=self.girth, springs=springs)

    @property
    def lamp_head(self) -> LampHead:
        """Shade or bar."""
        bar = self.head == "bar"
        return LampHead(
            style=self.head,
            radius=self.bar_half if bar else self.shade_radius,
            depth=self.bar_width if bar else self.shade_depth,
            neck=self.neck,
            vents=self.vents,
        )

    @property
    def shade(self) -> Floats:
        """(N, 2) radius and height below the head's joint of the shade's outside; none for bars."""
        return self.lamp_head.profile() if self.head != "bar" else np.zeros((0, 2))

    @property
    def leans(self) -> tuple[float, float]:
        """How far lower and upper arm lean forward at rest, rad."""
        return -math.radians(self.back_deg), math.radians(90.0 + self.dip_deg)

    @property
    def elbow(self) -> Point:
        """(y, z) of the joint between the arms at rest."""
        return _beyond(self.base.pivot, self.leans[0], self.lower)

    @property
    def wrist(self) -> Point:
        """(y, z) of the head's joint at rest."""
        return _beyond(self.elbow, self.leans[1], self.upper)

    @property
    def limits(self) -> tuple[Limit, Limit, Limit]:
        """Of lower arm, upper arm and head."""
        degrees = (self.back_deg + self.reach_deg, self.lift_deg, self.tilt_deg)
        a, b, c = (Limit(lower=0.0, upper=math.radians(d)) for d in degrees)
        return a, b, c


def _beyond(start: Point, lean: float, length: float) -> Point:
    y, z = leaning(lean)
    return start[0] + length * y, start[1] + length * z


def head_hangs_above_the_plate(p: DeskLampParams) -> bool:
    """At rest the shade clears the plate and what stands on it."""
    depth = p.neck + 0.030 + (p.shade_depth if p.head != "bar" else 0.0)
    return p.wrist[1] - depth > p.plate_height + 0.06


def head_stays_before_the_arm(p: DeskLampParams) -> bool:
    """At rest the shade does not meet the lower arm."""
    reach = p.shade_radius if p.head != "bar" else p.bar_width
    return p.wrist[0] + reach + 0.03 < min(p.base.pivot[0], p.elbow[0])


def shades_suit_arms(p: DeskLampParams) -> bool:
    """Flat arms carry bars of light; rods carry shades."""
    return (p.arm == "flat") == (p.head == "bar") or p.arm == "tube"


def head_clears_a_rising_arm(p: DeskLampParams) -> bool:
    """Where the upper arm rises to the head, the neck keeps the head below it."""
    rise = math.radians(max(-p.dip_deg, 0.0))
    reach = p.bar_width if p.head == "bar" else SOCKET
    if reach * math.tan(rise) + ARM_HALF / math.cos(rise) + 0.003 >= p.neck:
        return False
    half = PLATE_HALF if p.arm == "parallel" else ARM_HALF
    below = [reach * math.tan(rise) + half / math.cos(rise) + 0.004 for reach in p.shade[:, 0]]
    return bool((-p.shade[:, 1] > below).all())


def elbow_stays_open(p: DeskLampParams) -> bool:
    """At rest the arms enclose at least 70 degrees."""
    return p.back_deg + p.dip_deg < 20.0


def it_cannot_tip(p: DeskLampParams) -> bool:
    """The plate reaches far enough under the head."""
    return -p.wrist[0] < 3.4 * p.base.half_depth


INVARIANTS: Mapping[str, Callable[[DeskLampParams], bool]] = {
    check.__name__: check
    for check in (
        head_hangs_above_the_plate,
        head_stays_before_the_arm,
        shades_suit_arms,
        head_clears_a_rising_arm,
        elbow_stays_open,
        it_cannot_tip,
    )
}
