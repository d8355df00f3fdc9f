"""What varies in a folding chair, and the measures that follow from it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from artgen.generators.kit.chair_member import Member
from artgen.generators.kit.fold_linkage import FoldLinkage
from artgen.generators.kit.folding_frame import BackKind, FoldingFrame
from artgen.generators.kit.folding_seat import FoldingSeat, SeatKind


@dataclass(frozen=True, kw_only=True)
class FoldingChairParams:
    """Lengths in m, torques in N m."""

    make: Literal["wood", "tube"]
    width: float
    pin_height: float
    lean_deg: float
    rake_deg: float
    arm: float
    top: float
    bend_share: float
    kick_deg: float
    bar_thick: float
    bar_deep: float
    tube_radius: float
    seat: SeatKind
    seat_front: float
    seat_rear: float
    seat_slats: int
    padding: float
    dish: float
    back: BackKind
    back_height: float
    back_slats: int
    bow: float
    hand_hole: bool
    front_rungs: int
    rear_rungs: int
    friction: float
    catch: float

    @property
    def linkage(self) -> FoldLinkage:
        """How it folds."""
        return FoldLinkage(
            height=self.pin_height,
            lean=math.radians(self.lean_deg),
            rake=math.radians(self.rake_deg),
            arm=self.arm,
        )

    @property
    def frame(self) -> FoldingFrame:
        """Front legs, back and rear legs."""
        link, tube = self.linkage, self.make == "tube"
        r = self.tube_radius
        post = Member(thick=2 * r, deep=2 * r, round=True)
        leg = Member(thick=2 * r - 0.004, deep=2 * r - 0.004, round=True)
        if not tube:
            post = Member(thick=self.bar_thick, deep=self.bar_deep, round=False)
            leg = Member(thick=self.bar_thick - 0.001, deep=self.bar_deep - 0.004, round=False)
        free = link.arm + link.run + 0.012
        whole = (self.top - link.cross[1]) / math.cos(link.lean)
        return FoldingFrame(
            linkage=link,
            width=self.width,
            member=post,
            leg=leg,
            bend=free + self.bend_share * max(whole - free - 0.16, 0.0),
            kick=math.radians(self.kick_deg),
            top=self.top,
            back=self.back,
            back_height=self.back_height,
            slats=self.back_slats,
            bow=self.bow,
            hand_hole=self.hand_hole,
            rungs=(self.front_rungs, self.rear_rungs),
        )

    @property
    def chair_seat(self) -> FoldingSeat:
        """The seat, level."""
        return FoldingSeat(
            frame=self.frame,
            kind=self.seat,
            front=self.seat_front,
            rear=self.seat_rear,
            slats=self.seat_slats,
            padding=self.padding,
            dish=self.dish,
        )


def seat_folds_below_the_back(p: FoldingChairParams) -> bool:
    """Folded, the seat's rear edge stays below the back."""
    link = p.linkage
    return link.arm + link.run + p.seat_rear + 0.014 < p.frame.back_low


def make_suits_what_it_carries(p: FoldingChairParams) -> bool:
    """Wooden frames carry wood, tubes carry sheet, pads and plastic; seat and back match."""
    pairs = {
        "wood": ("slats slats", "slats panel", "panel panel", "panel slats", "padded slats"),
        "tube": ("panel panel", "padded padded", "padded panel", "plastic plastic", "slats slats"),
    }
    return f"{p.seat} {p.back}" in pairs[p.make]


def stands_on_wide_feet(p: FoldingChairParams) -> bool:
    """Feet front and rear stand far enough apart, and not too far."""
    link = p.linkage
    stance = link.on_legs(link.legs_reach)[0] - link.on_frame(-link.frame_reach)[0]
    return 0.33 < stance < 0.46


INVARIANTS: Mapping[str, Callable[[FoldingChairParams], bool]] = {
    check.__name__: check
    for check in (seat_folds_below_the_back, make_suits_what_it_carries, stands_on_wide_feet)
}
