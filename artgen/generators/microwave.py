"""Microwave ovens: a side-hinged or drop-down door, a glass turntable, dials and buttons."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart, Grip, Joint, Latch
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.board import Stock
from artgen.generators.kit.counterbalance import counterbalance
from artgen.generators.kit.density import ABS, ALUMINIUM, POLYPROPYLENE, STEEL
from artgen.generators.kit.handle import Handle
from artgen.generators.kit.microwave_cabinet import (
    base_bodies,
    hooks,
    lamp_print,
    panel_housing,
    rating_print,
)
from artgen.generators.kit.microwave_design import (
    MicrowaveParams,
    drop_door_has_no_button,
    heel_fits_door,
    open_door_clears_table,
    window_is_wide,
)
from artgen.generators.kit.window_leaf import inner_frame, panes, skin

PARAMS = MicrowaveParams
SKIN, FRAME = 0.42 * ABS, 0.62 * ABS
"""kg/m3; molded shells with ribs, and the steel frame inside."""
BEAD = 0.0015
"""m; depth of the groove around the window on the door's inner side."""
HANDLE_INSET = 0.027
"""m; from the door's free edge to the handle's axis."""


def build(p: MicrowaveParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the door is shut; the plate turns on its ring, which rolls half as fast."""
    looks = matched(p, surfaces)
    door = door_part(p)
    base = DraftPart(
        name="base",
        label="base",
        bodies=(*base_bodies(p), panel_housing(p), p.panel.core("panel"), p.panel.foil()),
    )
    parts = [base, door, *p.panel.parts("knob", "mark", "keycap")]
    joints = [door_joint(p, door), *p.panel.joints()]
    if p.platform == "turntable":
        parts += [p.turntable.ring_part("ring"), p.turntable.plate_part("plate")]
        joints += p.turntable.joints()
    specs = (*looks.values(), p.panel.print(looks["foil"]), lamp_print(p, looks["liner"]),
             rating_print(p))  # fmt: skip
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="microwave",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
    )


def matched(p: MicrowaveParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """Surfaces by role: white ovens are white all over, steel doors have dark or steel panels."""
    looks = dict(surfaces)
    light = sum(looks["front"].color) / 3.0 > 0.5 and looks["front"].metallic < 0.5
    if light:
        looks["cover"] = replace(looks["front"], name="cover")
        looks["panel"] = replace(looks["front"], name="panel")
        looks["inner"] = replace(looks["front"], name="inner")
    looks["foil"] = replace(looks["panel"], name="foil")
    pale = sum(looks["knob"].color) / 3.0 > 0.18
    looks["mark"] = SurfaceSpec(
        name="mark", recipe="plain", color=(0.02, 0.02, 0.02) if pale else (0.8, 0.8, 0.8)
    )
    return looks


def door_part(p: MicrowaveParams) -> DraftPart:
    """Skin, frame, panes, hooks, pins, and a handle where there is one."""
    d, w = p.leaf, p.window
    depth = p.skin_share * p.door
    drawn = [
        Body(solid=skin(d, w, depth=depth), surface="front", density=SKIN, edge=0.0025,
             collision=w.frame_pieces(d)),
        Body(solid=inner_frame(d, w, depth=depth, bead=BEAD), surface="inner", density=FRAME,
             edge=0.0012),
        *panes(d, w, depth=depth, glass="glass", screen="screen"),
        Body(solid=hooks(p), surface="ring", density=POLYPROPYLENE),
        Body(solid=d.pin_solids(), surface="metal", density=STEEL),
    ]  # fmt: skip
    if p.has_handle:
        drawn.append(_handle(p))
    return DraftPart(
        name="door",
        label="door",
        bodies=tuple(d.carried(body) for body in drawn),
        grips=(_grip(p),),
    )


def _handle(p: MicrowaveParams) -> Body:
    d = p.leaf
    handle = Handle(style=p.opening, length=p.handle_share * d.length, radius=p.handle_radius,
                    standoff=p.standoff)  # fmt: skip
    stock = Stock(surface="handle", density=0.5 * ALUMINIUM, edge=0.0008)
    return handle.at(d.width - HANDLE_INSET, d.front, d.length / 2.0, "z", stock)


def _grip(p: MicrowaveParams) -> Grip:
    """On the handle, in the scoop behind the free edge, or on the edge that springs open."""
    d = p.leaf
    if p.has_handle:
        position = d.point(d.width - HANDLE_INSET, d.front - p.standoff, d.length / 2.0)
    else:
        position = d.point(d.width, d.front + 0.010, d.length / 2.0)
    outward = (0.0, -1.0, 0.0)
    return Grip(name="door_handle" if p.has_handle else "door_edge",
                kind="handle" if p.has_handle else "edge",
                position=position, outward=outward, pull=outward)  # fmt: skip


def door_joint(p: MicrowaveParams, door: DraftPart) -> Joint:
    """Upright pins, or a sprung hinge below; hooks hold the door shut."""
    upper, latch = math.radians(p.opening_deg), Latch(force=p.latch, reach=0.06)
    if p.form == "side":
        return p.leaf.joint(upper=upper, friction=p.friction, latch=latch)
    upper = math.pi / 2.0
    spring, left = counterbalance(door.bodies, pivot=p.leaf.point(*p.leaf.pin, 0.0), upper=upper)
    return p.leaf.joint(upper=upper, friction=max(0.5, 1.25 * left), latch=latch, spring=spring)


INVARIANTS: Mapping[str, Callable[[MicrowaveParams], bool]] = {
    check.__name__: check
    for check in (drop_door_has_no_button, window_is_wide, heel_fits_door, open_door_clears_table)
}
