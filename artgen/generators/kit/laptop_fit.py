"""Which numbers make a laptop that is built: sizes, keys, grilles, and a lid that clears."""

import math
from collections.abc import Callable, Mapping

from artgen.generators.kit.laptop_layout import PLAY, LaptopParams, Layout


def style_suits_size(p: LaptopParams) -> bool:
    """Gaming laptops begin at 15 inches, chromebooks end there, ultrabooks end at 16."""
    smallest, largest = {
        "ultrabook": (11.0, 16.5), "business": (12.0, 17.5), "gaming": (15.0, 17.5),
        "chromebook": (11.0, 15.7),
    }[p.style]  # fmt: skip
    return smallest <= p.screen_inch <= largest


def shape_suits_screen(p: LaptopParams) -> bool:
    """Panels that are made: 11.6, 15.6 and 17.3 inches are 16:9; 3:2 is for ultrabooks."""
    if p.screen_inch in (11.6, 15.6, 17.3):
        return p.aspect == "16:9"
    if p.aspect == "3:2":
        return p.style in ("ultrabook", "chromebook")
    return p.screen_inch != 16.0 or p.aspect == "16:10"


def keys_wide_enough(p: LaptopParams) -> bool:
    """A row's pitch is at least 16.8 mm, as on laptops with a number block."""
    return Layout(p).keyboard.pitch >= 0.0168


def speakers_have_room(p: LaptopParams) -> bool:
    """Grilles beside the keyboard need 20 mm on each side, those behind it 13 mm."""
    if p.speakers == "sides":
        at = Layout(p)
        return at.width / 2.0 - at.well.x1 >= 0.020
    return p.speakers != "top" or p.deck_rear >= 0.013


def button_has_room(p: LaptopParams) -> bool:
    """A power button of its own needs 14 mm behind the keyboard and no grille there."""
    return p.power == "key" or (p.deck_rear >= 0.014 and p.speakers != "top")


def hinge_suits_style(p: LaptopParams) -> bool:
    """One long barrel goes with ultrabooks and chromebooks; business laptops lie flat on two."""
    return p.hinge == "twin" or p.style in ("ultrabook", "chromebook")


def buttons_suit_style(p: LaptopParams) -> bool:
    """Touchpads with buttons of their own are found on business and gaming laptops."""
    return p.pad == "plain" or p.style in ("business", "gaming")


def lid_clears_block(p: LaptopParams) -> bool:
    """The outer edges of lid and ledge pass over what the base has behind the hinge."""
    at = Layout(p)
    if at.rear <= at.hinge_rear:
        return True
    corners = ((at.reach, at.top), (at.ledge_reach, at.ledge_top - at.axis_z))
    sin, cos = math.sin(at.upper), math.cos(at.upper)
    return min(y * sin + z * cos for y, z in corners) >= PLAY - at.axis_above_deck


def lid_clears_table(p: LaptopParams) -> bool:
    """The lid's rear edge turns above the table."""
    at = Layout(p)
    return math.hypot(at.reach, at.top) < at.axis_z - PLAY


INVARIANTS: Mapping[str, Callable[[LaptopParams], bool]] = {
    check.__name__: check
    for check in (
        style_suits_size,
        shape_suits_screen,
        keys_wide_enough,
        speakers_have_room,
        button_has_room,
        hinge_suits_style,
        buttons_suit_style,
        lid_clears_block,
        lid_clears_table,
    )
}
