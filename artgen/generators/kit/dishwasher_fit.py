"""Which numbers make a dishwasher whose door swings clear and whose racks hold plates."""

import math
from collections.abc import Callable, Mapping

from artgen.generators.kit.dishwasher_layout import DishwasherParams, layout


def handle_suits_front(p: DishwasherParams) -> bool:
    """Pockets are molded into sheet, not into furniture; grip grooves lie under a control panel."""
    if p.handle == "pocket":
        return not p.has_furniture_panel
    return not (p.handle == "groove" and p.hidden_console)


def door_clears_kick_plate(p: DishwasherParams) -> bool:
    """The panel's lower edge swings under the pin and must stop short of the kick plate."""
    at = layout(p)
    return at.door.pivot[0] + p.drop + 0.003 < p.toe_depth - 0.006


def panel_swings_under_sill(p: DishwasherParams) -> bool:
    """The open door's panel lies lower than the sill reaches."""
    at = layout(p)
    return at.door.pivot[1] - (at.door.pivot[0] - at.door.seam) < at.cabinet.toe_height - 0.002


def pin_above_kick(p: DishwasherParams) -> bool:
    """The door's lower edge leaves a visible kick plate of 30 mm at least."""
    at = layout(p)
    return at.door.skin_bottom - p.foot > 0.030


def pins_fit_under_rack(p: DishwasherParams) -> bool:
    """Plates on the lower rack stay below the spray arm of the upper one."""
    at = layout(p)
    return at.track + 0.044 + p.tine_height < at.upper_floor - 0.060


def swing_clears_sill(p: DishwasherParams) -> bool:
    """The lower edge of the door's inner body turns in front of the cabinet."""
    at = layout(p)
    y, z = at.door.pivot
    return y + math.hypot(at.door.inner - y, z - at.door.bottom) < -0.001


INVARIANTS: Mapping[str, Callable[[DishwasherParams], bool]] = {
    check.__name__: check
    for check in (
        handle_suits_front,
        door_clears_kick_plate,
        panel_swings_under_sill,
        pin_above_kick,
        pins_fit_under_rack,
        swing_clears_sill,
    )
}
