"""Front-loading washing machines: porthole door, bellows, perforated drum, detergent drawer."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.washer_body import (
    base_bodies,
    drawer_joint,
    drawer_part,
    flap_joint,
    flap_part,
    rating_print,
)
from artgen.generators.kit.washer_design import (
    WasherParams,
    bowl_stays_before_drum,
    door_clears_flap,
    ring_covers_opening,
    tub_fits,
)

PARAMS = WasherParams


def build(p: WasherParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest door, drawer and flap are shut; the drum turns on its own."""
    looks = matched(surfaces)
    door = p.door.part(ring="ring", glass="glass", cover="cover", trim="hoop", metal="metal")
    parts = [
        DraftPart(name="base", label="base", bodies=base_bodies(p)),
        door,
        p.drum.part(shell="drum", rear="drum_rear", paddle="paddle"),
        drawer_part(p),
    ]
    joints = [
        p.door.joint(upper=math.radians(p.opening_deg), friction=p.friction, latch=p.latch),
        p.drum.joint(friction=p.drum_friction),
        drawer_joint(p),
    ]
    if p.flap != "none":
        parts.append(flap_part(p))
        joints.append(flap_joint(p))
    parts += p.panel.parts("knob", "mark", "keycap")
    joints += p.panel.joints()
    specs = (*looks.values(), p.panel.print(looks["panel"]), rating_print(p))
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="washing_machine",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
    )


def matched(surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """Surfaces by role: the worktop matches the cabinet, dark machines have dark panels."""
    looks = dict(surfaces)
    dark = sum(looks["cabinet"].color) / 3.0 < 0.5
    looks["worktop"] = replace(looks["cabinet"], name="worktop")
    if not dark:
        looks["panel"] = replace(looks["cabinet"], name="panel")
        looks["trim"] = replace(looks["cabinet"], name="trim")
    pale = sum(looks["knob"].color) / 3.0 > 0.18
    looks["mark"] = SurfaceSpec(
        name="mark", recipe="plain", color=(0.02, 0.02, 0.02) if pale else (0.8, 0.8, 0.8)
    )
    return looks


INVARIANTS: Mapping[str, Callable[[WasherParams], bool]] = {
    check.__name__: check
    for check in (tub_fits, door_clears_flap, ring_covers_opening, bowl_stays_before_drum)
}
