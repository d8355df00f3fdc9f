"""The numbers of a toilet, and the pan and seat that follow from them."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.generators.kit.cistern import Flush
from artgen.generators.kit.toilet_pan import Pan, Shape
from artgen.generators.kit.toilet_seat import SeatSet


@dataclass(frozen=True, kw_only=True)
class ToiletParams:
    """See category_rules/toilet.toml."""

    kind: str
    skirted: bool
    flush: Flush
    width: float
    length: float
    rim_height: float
    power: float
    rear_share: float
    border: float
    bowl_depth: float
    rimless: bool
    water_depth: float
    hung_height: float
    seat_thickness: float
    lid_thickness: float
    crown: float
    over: float
    hinge_half: float
    opening_deg: float
    friction: float
    soft_close: bool
    slow: float
    tank_width: float
    tank_depth: float
    tank_height: float
    taper: float
    tank_lid: float
    tank_over: float
    wall_width: float
    wall_height: float
    wall_depth: float
    tile: float
    plate_height: float
    pipe: bool
    china_density: float
    room: float

    @property
    def shape(self) -> Shape:
        """Of the pan's outside."""
        if self.kind == "wall_hung":
            return "hung"
        return "skirted" if self.skirted else "pedestal"


def _lever_needs_a_tank(p: ToiletParams) -> bool:
    return p.flush != "lever" or p.kind == "close_coupled"


INVARIANTS: Mapping[str, Callable[[ToiletParams], bool]] = {
    "lever_needs_a_tank": _lever_needs_a_tank,
}


def seat_set(p: ToiletParams, back: float) -> SeatSet:
    """Seat and lid on a pan whose rear lies at y = `back`."""
    return SeatSet(
        pan=pan_of(p, back),
        seat=p.seat_thickness,
        lid=p.lid_thickness,
        crown=p.crown,
        over=p.over,
        hinge=p.hinge_half,
        opening=math.radians(p.opening_deg),
        friction=p.friction,
        damping=p.slow if p.soft_close else 0.08,
    )


def pan_of(p: ToiletParams, back: float) -> Pan:
    """The pan, from its front to y = `back`."""
    return Pan(
        shape=p.shape,
        half=p.width / 2.0,
        length=p.length,
        back=back,
        rear_half=p.rear_share * p.width / 2.0,
        rim=p.rim_height,
        tall=p.hung_height if p.kind == "wall_hung" else p.rim_height,
        power=p.power,
        border=p.border,
        deep=p.bowl_depth,
        rimless=p.rimless,
        water=p.water_depth,
    )
