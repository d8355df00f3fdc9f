"""Laptops: a lid with a lit screen on friction barrels over a base with keyboard and touchpad."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart, Joint, Limit
from artgen.core.conventions import GRAVITY
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.counterbalance import weighed
from artgen.generators.kit.keyboard import KeyInk, printed
from artgen.generators.laptop_base import base
from artgen.generators.laptop_layout import PLAY, LaptopParams, Layout
from artgen.generators.laptop_lid import lid

PARAMS = LaptopParams

LEAST_HOLD, MOST_HOLD = 0.5, 4.5
"""N m; weaker hinges rattle, stronger ones lift the base off the table."""
LIGHT = 0.18
"""Linear brightness above which print is dark."""


def build(p: LaptopParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the lid lies on the base; it turns up about the barrels at the rear."""
    at = Layout(p)
    parts = (base(at), lid(at))
    return Draft(
        category="laptop",
        parts=parts,
        joints=(lid_joint(at, parts[1]),),
        surfaces=worn(matched(at, surfaces), parts),
    )


def lid_joint(at: Layout, part: DraftPart) -> Joint:
    """The hinge; its friction holds the lid at every angle."""
    pivot = (0.0, at.axis_y, at.axis_z)
    mass, center = weighed(part.bodies)
    worst = mass * GRAVITY * math.hypot(center[1] - pivot[1], center[2] - pivot[2])
    friction = min(max(at.p.hold * worst, LEAST_HOLD), MOST_HOLD)
    return Joint(
        name="hinge",
        type="revolute",
        parent="base",
        child="lid",
        axis=(-1.0, 0.0, 0.0),  # +q lifts the front edge (front is -y)
        origin=pivot,
        limit=Limit(lower=0.0, upper=at.upper),
        friction=friction,
        damping=0.06,
        effort=3.0 * friction,
        velocity=6.0,
    )


def matched(at: Layout, surfaces: Mapping[str, SurfaceSpec]) -> list[SurfaceSpec]:
    """The drawn surfaces as the roles of this laptop: one shell, a deck that goes with it, readable
    keys, a picture of the screen's size."""
    p = at.p
    looks = dict(surfaces)
    shell = looks[f"shell_{p.style}"]
    deck = looks["deck_dark"] if p.two_tone else shell
    keys = looks["keys"] if _light(deck) else looks["keys_dark"]
    screen = looks["screen"]
    roles = {
        "shell": shell,
        "deck": deck,
        "pad": deck,
        "pad_button": deck,
        "trim": deck,
        "keybed": looks["keybed_dark"] if p.dark_well else deck,
        "bezel": looks[f"bezel_{p.bezel}"],
        "hinge": looks[f"hinge_{p.hinge}"],
        "lens": looks["bezel_glass"],
        **{name: looks[name] for name in ("dark", "logo", "port_metal", "rubber", "vent")},
    }
    picture = replace(
        screen, tile=at.screen_size, detail={**screen.detail, "seed": float(p.picture)}
    )
    named = [replace(spec, name=role) for role, spec in roles.items()]
    return [*named, picture, printed(keys, at.keyboard, _ink(keys, p))]


def worn(surfaces: list[SurfaceSpec], parts: tuple[DraftPart, ...]) -> tuple[SurfaceSpec, ...]:
    """Those that a body wears."""
    names = {body.surface for part in parts for body in part.bodies}
    return tuple(surface for surface in surfaces if surface.name in names)


def _light(spec: SurfaceSpec) -> bool:
    return sum(spec.color) / 3.0 > LIGHT


def _ink(keys: SurfaceSpec, p: LaptopParams) -> KeyInk:
    """Print that stands out; gaming keyboards mark the keys that steer."""
    background = srgb_hex(keys.color)
    gaming = p.style == "gaming"
    return KeyInk(
        background=background,
        modifier=background,
        accent="#a3262c" if gaming else background,
        ink="#2a2c2f" if _light(keys) else "#e9ebee",
        accents="W A S D" if gaming else "",
    )


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
