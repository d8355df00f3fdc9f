"""Staplers: half and full strip, mini, heavy duty and long reach; base, magazine, arm."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart, Joint, Latch, Limit, Precondition, Spring
from artgen.core.conventions import GRAVITY
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.counterbalance import weighed
from artgen.generators.kit.printed import line, printed, words
from artgen.generators.kit.stapler_arm import BADGE, arm
from artgen.generators.kit.stapler_design import StaplerParams
from artgen.generators.kit.stapler_works import (
    SCALE,
    anvil_part,
    anvil_place,
    base,
    follower,
    follower_travel,
    magazine,
    paper_stop,
    stop_span,
)
from artgen.textures.appliance_panel import BRANDS

PARAMS = StaplerParams
UP, DOWN = (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)
"""Axes about which the front goes up or down."""
ASTRIDE = 2.55
"""rad; magazine and arm together open so far at most, else the arm would meet the base's tail."""
REACH_IN = 0.7
"""rad; the arm must be open by so much before the follower is drawn back."""


def build(p: StaplerParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the arm is shut over the magazine, which its spring holds above the anvil."""
    parts = [base(p), magazine(p), arm(p), follower(p)]
    joints = [_magazine_joint(p, parts[1:]), _arm_joint(p), _follower_joint(p)]
    if p.anvil_turns:
        parts.append(anvil_part(p))
        joints.append(_anvil_joint(p))
    if p.kind == "long_reach":
        parts.append(paper_stop(p))
        joints.append(_stop_joint(p))
    looks = matched(p, surfaces)
    specs = (*looks.values(), *_prints(p, looks))
    return Draft(
        category="stapler",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=_worn(specs, parts),
        preconditions=(
            Precondition(joint="follower_slide", requires="arm_hinge", at_least=REACH_IN),
        ),
    )


def matched(p: StaplerParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """One color for arm and base, or a base of its own."""
    looks = dict(surfaces)
    if p.one_color:
        looks["base"] = replace(looks["arm"], name="base")
    return looks


def _worn(specs: tuple[SurfaceSpec, ...], parts: list[DraftPart]) -> tuple[SurfaceSpec, ...]:
    worn = {body.surface for part in parts for body in part.bodies}
    return tuple(spec for spec in specs if spec.name in worn)


def _prints(p: StaplerParams, looks: Mapping[str, SurfaceSpec]) -> tuple[SurfaceSpec, ...]:
    """The brand on the arm; centimeters beside the paper stop."""
    light = sum(looks["arm"].color) / 3.0 > 0.25
    ink = "#1d1f22" if light else "#e6e7e8"
    middle = (BADGE[0] / 2.0, BADGE[1] / 2.0)
    name = [words(middle, BRANDS[p.brand].upper(), cap=0.0042, ink=ink)]
    badge = printed("badge", BADGE, background=srgb_hex(looks["arm"].color), marks=name)
    ticks = []
    for k in range(int(SCALE[1] / 0.005)):
        y, long = 0.002 + 0.005 * k, 0.006 if k % 2 == 0 else 0.0035
        ticks.append(line([(0.0006, y), (0.0006 + long, y)], width=0.0004, ink="#202224"))
        if k % 2 == 0:
            ticks.append(words((0.0092, y), str(k // 2), cap=0.0024, ink="#202224"))
    scale = printed("scale", SCALE, background="#d7d8d6", marks=ticks)
    return badge, scale


def _magazine_joint(p: StaplerParams, lifted: list[DraftPart]) -> Joint:
    """Pressed down onto the anvil, or opened up to tack; its spring carries what is `lifted`."""
    mass, center = weighed([body for part in lifted for body in part.bodies])
    torque = p.lift * mass * GRAVITY * -float(center[1])
    return Joint(
        name="magazine_hinge",
        type="revolute",
        parent="base",
        child="magazine",
        axis=UP if p.tacks else DOWN,
        origin=(0.0, 0.0, p.pivot),
        limit=Limit(lower=0.0, upper=min(1.2, ASTRIDE - p.opened) if p.tacks else p.press),
        friction=0.12 if p.tacks else 0.03,
        damping=0.01,
        effort=20.0,
        spring=None
        if p.tacks
        else Spring(stiffness=torque / (2.0 * p.press), reference=-2.0 * p.press),
        latch=Latch(force=0.25, reach=0.06) if p.tacks else None,
    )


def _arm_joint(p: StaplerParams) -> Joint:
    """Opened for loading; a catch keeps it shut."""
    return Joint(
        name="arm_hinge",
        type="revolute",
        parent="magazine",
        child="arm",
        axis=UP,
        origin=(0.0, 0.0, p.pivot),
        limit=Limit(lower=0.0, upper=p.opened),
        friction=p.hinge_friction * p.bulk**2,
        damping=0.01,
        effort=20.0,
        latch=Latch(force=0.30 * p.bulk**2, reach=0.08),
    )


def _follower_joint(p: StaplerParams) -> Joint:
    """Drawn to the rear to load; its spring pushes it onto the staples."""
    return Joint(
        name="follower_slide",
        type="prismatic",
        parent="magazine",
        child="follower",
        axis=(0.0, 1.0, 0.0),
        limit=Limit(lower=0.0, upper=follower_travel(p)),
        friction=0.6,
        damping=0.5,
        effort=20.0,
        velocity=1.0,
        spring=Spring(stiffness=28.0, reference=-0.04),
    )


def _anvil_joint(p: StaplerParams) -> Joint:
    """Half a turn from clinching to pinning."""
    return Joint(
        name="anvil_turn",
        type="revolute",
        parent="base",
        child="anvil",
        axis=(0.0, 0.0, 1.0),
        origin=(0.0, anvil_place(p), 0.0),
        limit=Limit(lower=0.0, upper=3.141592653589793),
        friction=0.01,
        damping=0.0005,
        effort=1.0,
    )


def _stop_joint(p: StaplerParams) -> Joint:
    """The paper stop slides to the rear along its ruler."""
    low, high = stop_span(p)
    return Joint(
        name="paper_stop_slide",
        type="prismatic",
        parent="base",
        child="paper_stop",
        axis=(0.0, 1.0, 0.0),
        limit=Limit(lower=0.0, upper=high - low),
        friction=2.5,
        damping=4.0,
        effort=20.0,
        velocity=1.0,
    )


def base_carries_the_ears(p: StaplerParams) -> bool:
    """Round ends leave room for the ears, and the arm is wider than its magazine."""
    return p.ear[1] + 0.0015 < p.base_half and p.tail > 0.011


def strip_fits(p: StaplerParams) -> bool:
    """The follower has 8 mm to go at least."""
    return follower_travel(p) > 0.008


INVARIANTS: Mapping[str, Callable[[StaplerParams], bool]] = {
    check.__name__: check for check in (base_carries_the_ears, strip_fits)
}
