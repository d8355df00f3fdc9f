"""Ovens: a sprung drop-down door before racks on rails; built in, or ranges with hob and drawer."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart, Grip, Joint, Latch, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.board import Stock
from artgen.generators.kit.counterbalance import counterbalance
from artgen.generators.kit.density import ALUMINIUM, STEEL
from artgen.generators.kit.handle import Handle
from artgen.generators.kit.oven_body import (
    base_bodies,
    drawer_room,
    has_drawer,
    lamp_surface,
    panel_housing,
    range_bodies,
    rating_print,
)
from artgen.generators.kit.oven_design import (
    GAP,
    OvenParams,
    heel_fits_door,
    range_has_room,
    shelves_have_levels,
    window_is_wide,
)
from artgen.generators.kit.range_drawer import range_drawer
from artgen.generators.kit.window_leaf import inner_frame, panes, skin

PARAMS = OvenParams
SKIN, FRAME = 1150.0, 260.0
"""kg/m3; glass or sheet with its stiffeners, and the hollow inner frame with a third pane."""
BEAD, HANDLE_INSET = 0.002, 0.042
"""m; depth of the groove around the window; from the door's upper edge to the handle's axis."""
DOOR_HOLD, DOOR_LIMIT = 1.12, 4.9
"""Friction over the torque that the spring leaves, and the most that people accept, N m."""
UPPER = math.radians(89.5)
OPEN_ENOUGH = 0.06
"""rad; racks slide out over a door that is this near to fully open."""


def build(p: OvenParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the door is shut and the racks are in; they slide out over the open door."""
    looks = matched(p, surfaces)
    door = door_part(p)
    bodies = [*base_bodies(p), panel_housing(p), p.panel.core("panel"), p.panel.foil()]
    if p.is_range:
        bodies += range_bodies(p)
    parts = [DraftPart(name="base", label="base", bodies=tuple(bodies)), door]
    joints = [door_joint(p, door)]
    for shelf in p.shelves:
        tray = shelf.name == "baking_tray"
        parts.append(
            shelf.tray_part("tray", depth=p.tray_depth) if tray else shelf.rack_part("wire")
        )
        joints.append(shelf.joint(travel=round(p.travel * (shelf.back - shelf.front), 3),
                                  friction=6.0 if tray else 7.0))  # fmt: skip
    if has_drawer(p):
        part, joint = range_drawer(
            drawer_room(p), half=p.half, face=p.face, low=p.sill + 0.004,
            high=p.sill + p.drawer_height, seam=GAP,
            reach=p.leaf.width - HANDLE_INSET - p.door - p.handle_radius - 0.02,
        )  # fmt: skip
        parts.append(part)
        joints.append(joint)
    parts += p.panel.parts("knob", "mark", "trim")
    joints += p.panel.joints()
    specs = [*looks.values(), p.panel.print(looks["panel"]), rating_print(p), lamp_surface(p)]
    if p.is_range and p.hob == "ceramic":
        specs.append(p.cooktop.print(style=p.zone_style))
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="oven",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
        preconditions=tuple(
            Precondition(
                joint=f"{shelf.name}_slide", requires="door_hinge", at_least=UPPER - OPEN_ENOUGH
            )
            for shelf in p.shelves
        ),
    )


def matched(p: OvenParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """Surfaces by role; a ceramic hob brings its own print, white ranges are white all over."""
    looks = dict(surfaces)
    white = looks["front"].metallic < 0.5 and sum(looks["front"].color) > 1.5
    if white:
        if p.is_range:
            looks["cover"] = replace(looks["front"], name="cover")
        looks["panel"] = replace(looks["front"], name="panel")
        looks["hob"] = replace(looks["front"], name="hob")
    if p.hob == "ceramic":
        del looks["hob"]
    pale = sum(looks["knob"].color) / 3.0 > 0.18
    looks["mark"] = SurfaceSpec(
        name="mark", recipe="plain", color=(0.02, 0.02, 0.02) if pale else (0.85, 0.85, 0.85)
    )
    return looks


def door_part(p: OvenParams) -> DraftPart:
    """Outer skin, inner frame, outer and inner pane, pins, handle."""
    d, w = p.leaf, p.window
    depth = p.skin_share * p.door
    handle = Handle(style=p.handle, length=p.handle_share * d.length, radius=p.handle_radius,
                    standoff=p.standoff)  # fmt: skip
    bar = handle.at(
        d.width - HANDLE_INSET, d.front, d.length / 2.0, "z",
        Stock(surface="handle", density=0.5 * ALUMINIUM, edge=0.0008),
    )  # fmt: skip
    drawn = [
        Body(solid=skin(d, w, depth=depth), surface="front", density=SKIN, edge=0.002,
             collision=w.frame_pieces(d)),
        Body(solid=inner_frame(d, w, depth=depth, bead=BEAD), surface="frame", density=FRAME,
             edge=0.0006),
        *panes(d, w, depth=depth, glass="glass", screen="inner_glass"),
        Body(solid=d.pin_solids(), surface="metal", density=STEEL),
        bar,
    ]  # fmt: skip
    out = (0.0, -1.0, 0.0)
    grip = Grip(
        name="door_handle", kind="handle", outward=out, pull=out,
        position=d.point(d.width - HANDLE_INSET, d.front - p.standoff, d.length / 2.0),
    )  # fmt: skip
    bodies = tuple(d.carried(body) for body in drawn)
    return DraftPart(name="door", label="door", bodies=bodies, grips=(grip,))


def door_joint(p: OvenParams, door: DraftPart) -> Joint:
    """Springs carry the door, friction holds it at every angle, cams pull it shut."""
    pivot = p.leaf.point(*p.leaf.pin, 0.0)
    spring, left = counterbalance(door.bodies, pivot=pivot, upper=UPPER)
    friction = max(0.5, 1.02 * left, min(DOOR_HOLD * left, DOOR_LIMIT - left))
    latch = Latch(force=p.latch, reach=0.05)
    return p.leaf.joint(upper=UPPER, friction=friction, latch=latch, spring=spring)


INVARIANTS: Mapping[str, Callable[[OvenParams], bool]] = {
    check.__name__: check
    for check in (window_is_wide, heel_fits_door, shelves_have_levels, range_has_room)
}
