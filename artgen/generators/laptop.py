"""Laptops: a lid with a lit screen on friction barrels over a base with keyboard and touchpad."""

import math
from collections.abc import Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart, Joint, Limit
from artgen.core.conventions import GRAVITY
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.counterbalance import weighed
from artgen.generators.kit.keyboard import KeyInk, printed
from artgen.generators.kit.laptop_base import base
from artgen.generators.kit.laptop_fit import INVARIANTS
from artgen.generators.kit.laptop_layout import LaptopParams, Layout
from artgen.generators.kit.laptop_lid import lid

PARAMS = LaptopParams
__all__ = ["INVARIANTS", "PARAMS", "build"]

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
