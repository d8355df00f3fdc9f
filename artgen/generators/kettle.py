"""Kettles: cordless electric ones on their power base, and whistling ones for the stove."""

import math
from collections.abc import Mapping

from artgen.articulation.types import Draft, DraftPart, Grip, Joint, Limit, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import kettle_params
from artgen.generators.kit.density import ABS
from artgen.generators.kit.kettle_jug import gauge_plane, gauge_plate, jug_bodies
from artgen.generators.kit.kettle_lid import lid_joint, lid_part
from artgen.generators.kit.kettle_marks import gauge_print
from artgen.generators.kit.kettle_params import FEET, KettleParams
from artgen.generators.kit.kettle_switch import (
    lever_joint,
    lever_part,
    lever_slot,
    lid_button,
    power_button,
)
from artgen.generators.kit.power_base import power_base
from artgen.generators.kit.quarter_turn import turned_joint, turned_part
from artgen.generators.kit.stove_kettle import StoveKettle, stove_works

PARAMS = KettleParams
INVARIANTS = kettle_params.INVARIANTS


def build(p: KettleParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Drawn with the spout towards -y, then turned: it pours to the left, the gauge faces front."""
    parts, joints, rules = _electric(p) if p.electric else _stove(p)
    prints = (gauge_print(p, gauge_plane(p).size),) if p.electric else ()
    specs = (*surfaces.values(), *prints)
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="kettle",
        parts=tuple(turned_part(part) for part in parts),
        joints=tuple(turned_joint(joint) for joint in joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
        preconditions=rules,
    )


STOVE_SIZE = (1.42, 0.62)
"""Radius and height of a kettle for the stove in those of an electric jug."""
Works = tuple[list[DraftPart], list[Joint], tuple[Precondition, ...]]


def _electric(p: KettleParams) -> Works:
    """At rest the jug stands on its base, the lid is shut and the switch is off."""
    stand = power_base(
        radius=p.radius + p.stand_margin, foot=FEET, height=p.stand_height, seat=p.radius,
        surface="trim", metal="metal", rubber="rubber",
    )  # fmt: skip
    parts = [DraftPart(name="base", label="base", bodies=stand)]
    joints = [_lift(p)]
    wells, movers, rules = [], [lid_part(p)], []
    joints.append(lid_joint(p, "jug"))
    if p.lid == "button":
        button, plane = lid_button(p)
        wells.append(plane.placed(button.well()))
        movers.append(button.part(plane, "accent", density=ABS))
        joints.append(button.joint(plane, parent="jug"))
        rules.append(
            Precondition(
                joint="lid_hinge", requires="lid_button_press", at_least=0.8 * button.travel
            )
        )
    if p.switch == "foot":
        wells.append(lever_slot(p))
        movers.append(lever_part(p))
        joints.append(lever_joint(p, "jug"))
    else:
        button, plane = power_button(p)
        wells.append(plane.placed(button.well()))
        movers.append(button.part(plane, "accent", density=ABS))
        joints.append(button.joint(plane, parent="jug"))
    bodies = (*jug_bodies(p, wells), gauge_plate(p))
    parts.append(DraftPart(name="jug", label="jug", bodies=bodies, grips=(_grip(p),)))
    return [*parts, *movers], joints, tuple(rules)


def _stove(p: KettleParams) -> Works:
    """At rest lid and flap are shut and the handle stands upright."""
    kettle = StoveKettle(
        radius=STOVE_SIZE[0] * p.radius,
        height=STOVE_SIZE[1] * p.height * (0.9 + 0.25 * p.belly),
        mouth=0.046,
        belly=p.belly,
        spout=p.spout_radius,
        lean=math.radians(p.spout_deg),
        handle=p.bail,
        fold=math.radians(p.fold_deg),
        flap=math.radians(p.flap_deg),
        grip=(p.handle_width, p.handle_thickness),
        skin="sheet" if p.form == "dome" else "painted",
        crown=p.crown,
    )
    parts, joints = stove_works(kettle)
    if p.bail != "swing":
        return parts, joints, ()
    held = Precondition(joint="lid_lift", requires="handle_swing", at_least=0.8 * kettle.fold)
    return parts, joints, (held,)


def _lift(p: KettleParams) -> Joint:
    return Joint(
        name="jug_lift", type="prismatic", parent="base", child="jug", axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=p.lift), friction=1.0, damping=8.0, effort=60.0, velocity=0.8,
    )  # fmt: skip


def _grip(p: KettleParams) -> Grip:
    y, z = p.handle_path[2] if p.handle == "arch" else p.handle_path[1]
    end = p.handle_path[2]
    middle = (0.0, (y + end[0]) / 2.0, (z + end[1]) / 2.0)
    return Grip(
        name="jug_handle", kind="handle", position=middle, outward=(0.0, 1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )  # fmt: skip
