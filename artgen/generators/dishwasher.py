"""Dishwashers: a drop-down door before a tub with sliding racks and turning spray arms."""

from collections.abc import Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart, Joint, Limit, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.counterbalance import counterbalance
from artgen.generators.kit.dishwasher_body import arm_pivot, base, lower_arm, upper_arm
from artgen.generators.kit.dishwasher_door import door
from artgen.generators.kit.dishwasher_fit import INVARIANTS
from artgen.generators.kit.dishwasher_layout import ENTRY, HOLD, DishwasherParams, Layout, layout
from artgen.generators.kit.dishwasher_racks import cutlery_tray, lower_rack, upper_rack

PARAMS = DishwasherParams
__all__ = ["INVARIANTS", "PARAMS", "build"]

DOOR_HOLD = 1.10
"""Friction of the hinge over the torque that the spring leaves: the door stays where it is put."""
LEAST_HOLD = 1.02
DOOR_LIMIT = 4.9
"""N m; doors that would ask for more are held by the least friction that holds them."""


def build(p: DishwasherParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the door is shut, the racks are in; the door falls forward, then racks slide out."""
    at = layout(p)
    looks = matched(p, surfaces)
    door_part, own = door(p, at, looks)
    parts = [base(p, at, looks), door_part, lower_rack(p, at), upper_rack(p, at)]
    joints = [
        door_joint(at, door_part),
        slide("lower_rack", at, friction=9.0),
        slide("upper_rack", at, friction=7.0),
    ]
    if p.cutlery != "basket":
        parts.append(cutlery_tray(p, at))
        joints.append(slide("cutlery_tray", at, friction=6.0))
    parts += [lower_arm(p, at), upper_arm(p, at)]
    joints += [
        spin("lower_spray_arm", at, parent="base"),
        spin("upper_spray_arm", at, parent="upper_rack"),
    ]
    return Draft(
        category="dishwasher",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=used((*looks.values(), *own), parts),
        preconditions=tuple(
            Precondition(
                joint=f"{rack}_slide",
                requires="door_hinge",
                at_least=at.upper - HOLD if rack == "lower_rack" else ENTRY,
            )
            for rack in ("lower_rack", "upper_rack", "cutlery_tray")
            if any(part.name == rack for part in parts)
        ),
    )


def matched(p: DishwasherParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """Surfaces by role: painted fronts have sides and worktop of their paint, built-in machines
    bare sheet sides, and half of the enamel doors a fascia of their own color."""
    looks = dict(surfaces)
    painted = looks["front"].metallic < 0.5
    if not p.has_worktop:
        looks["side"] = replace(looks["metal"], name="side")
    elif painted:
        looks["side"] = replace(looks["front"], name="side")
        looks["worktop"] = replace(looks["front"], name="worktop")
    if painted and p.plain_fascia and not p.has_furniture_panel:
        looks["fascia"] = replace(looks["front"], name="fascia")
    return looks


def used(surfaces: tuple[SurfaceSpec, ...], parts: list[DraftPart]) -> tuple[SurfaceSpec, ...]:
    """Those that a body wears."""
    worn = {body.surface for part in parts for body in part.bodies}
    return tuple(surface for surface in surfaces if surface.name in worn)


def door_joint(at: Layout, part: DraftPart) -> Joint:
    """The hinge; its spring carries the door, its friction holds it."""
    y, z = at.door.pivot
    pivot = (0.0, y, z)
    spring, left = counterbalance(part.bodies, pivot=pivot, upper=at.upper)
    return Joint(
        name="door_hinge",
        type="revolute",
        parent="base",
        child="door",
        axis=(1.0, 0.0, 0.0),  # +q turns the upper edge from +z towards the front, -y
        origin=pivot,
        limit=Limit(lower=0.0, upper=at.upper),
        friction=max(0.5, LEAST_HOLD * left, min(DOOR_HOLD * left, DOOR_LIMIT - left)),
        damping=0.8,
        effort=30.0,
        spring=spring,
    )


def slide(rack: str, at: Layout, *, friction: float) -> Joint:
    """A rack's way out, towards -y."""
    return Joint(
        name=f"{rack}_slide",
        type="prismatic",
        parent="base",
        child=rack,
        axis=(0.0, -1.0, 0.0),
        limit=Limit(lower=0.0, upper=at.rack.travel),
        friction=friction,
        damping=6.0,
        effort=120.0,
        velocity=1.0,
    )


def spin(arm: str, at: Layout, *, parent: str) -> Joint:
    """A spray arm's free turning."""
    return Joint(
        name=f"{arm}_axle",
        type="continuous",
        parent=parent,
        child=arm,
        axis=(0.0, 0.0, 1.0),
        origin=arm_pivot(at),
        limit=None,
        friction=0.01,
        damping=0.002,
        effort=1.0,
        velocity=6.0,
    )
