"""Laptop: a clamshell whose lid lies on the base at rest and turns up about the rear edge."""

import dataclasses
import math
from collections.abc import Mapping

from artgen.articulation.types import Draft, Joint, Limit
from artgen.core.conventions import GRAVITY
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.laptop_body import base_part
from artgen.generators.laptop_lid import lid_part, screen_size
from artgen.generators.laptop_shape import (
    LaptopParams,
    LaptopShape,
    hinges_fit,
    keyboard_fits,
    weight_is_plausible,
)

PARAMS = LaptopParams
INVARIANTS = {
    "keyboard_fits": keyboard_fits,
    "hinges_fit": hinges_fit,
    "weight_is_plausible": weight_is_plausible,
}
LEAST_FRICTION = 0.55
"""N m; a lid that opens at a touch would fall shut at a knock."""


def build(p: LaptopParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Base and lid; the hinge's friction holds the lid at every angle."""
    shape = LaptopShape(p)
    base, lid = base_part(shape), lid_part(shape)
    mass = sum(body.density * body.solid.volume for body in lid.bodies)
    weight = mass * GRAVITY * (shape.axis_y + shape.half_depth) / 2.0
    hinge = Joint(
        name="hinge",
        type="revolute",
        parent="base",
        child="lid",
        axis=(-1.0, 0.0, 0.0),  # +q lifts the front edge (front is -y)
        origin=(0.0, shape.axis_y, shape.axis_z),
        limit=Limit(lower=0.0, upper=math.radians(p.opening_deg)),
        friction=max(LEAST_FRICTION, p.hinge_friction * weight),
        damping=0.05,
        effort=20.0,
    )
    return Draft(
        category="laptop",
        parts=(base, lid),
        joints=(hinge,),
        surfaces=tuple(_looks(shape, surfaces).values()),
    )


def _looks(s: LaptopShape, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """The drawn surfaces, with the decals sized to what they lie on."""
    looks = dict(surfaces)
    keys = looks["keys"]
    dark = sum(keys.color) < 0.4
    looks["keys"] = dataclasses.replace(
        keys,
        recipe="keyboard",
        tile=s.keys_size,
        detail={
            "background": srgb_hex(keys.color),
            "ink": "#d9dbdd" if dark else "#45474a",
            "numpad": float(s.has_numpad),
            "gap": s.p.key_gap,
        },
    )
    screen = looks["screen"]
    looks["screen"] = dataclasses.replace(
        screen, tile=screen_size(s), detail={**screen.detail, "seed": float(s.p.screen_seed)}
    )
    red, green, blue = looks["shell"].color
    looks["pad"] = dataclasses.replace(
        looks["shell"],
        name="pad",
        roughness=0.30,
        color=(0.88 * red, 0.88 * green, 0.88 * blue),
    )
    return looks
