"""Desk lamps: a weighted foot, a turret, two arms balanced by springs, a head that gives light."""

import math
from collections.abc import Mapping

from artgen.articulation.types import Draft, DraftPart, Grip, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import desk_lamp_design
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cord import cord_stub
from artgen.generators.kit.density import ABS, ALUMINIUM, GLASS, RUBBER, STEEL
from artgen.generators.kit.desk_lamp_design import DeskLampParams
from artgen.generators.kit.lamp_arm import placed
from artgen.generators.kit.lamp_controls import badge, lamp_switch
from artgen.generators.kit.spring_balance import balanced

PARAMS = DeskLampParams
INVARIANTS = desk_lamp_design.INVARIANTS
IRON = 4200.0
"""kg/m3; a cast weight in a sheet cover."""


def build(p: DeskLampParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the lower arm leans back, the upper one reaches forward, the light falls down."""
    turret, lower, upper, head = _chain(p)
    switch, switch_joint, cuts = lamp_switch(p)
    weight = Stock(surface="coat", density=IRON, edge=0.0)
    rubber = Stock(surface="rubber", density=RUBBER, edge=0.0)
    cord = cord_stub(
        (0.0, p.base.half_depth - 0.002, 0.010), out=(0.0, 1.0, 0.0), surface="rubber", run=0.02
    )
    name, print_ = badge(p, surfaces["coat"])
    base = DraftPart(
        name="base", label="base", bodies=(*p.base.bodies(weight, rubber, cuts), name, cord)
    )
    parts = (base, turret, lower, upper, head, switch)
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="desk_lamp",
        parts=parts,
        joints=(_swivel(p), *_hinges(p, lower, upper, head), switch_joint),
        surfaces=(*(spec for role, spec in surfaces.items() if role in worn), print_),
    )


def _chain(p: DeskLampParams) -> tuple[DraftPart, DraftPart, DraftPart, DraftPart]:
    """Turret, arms and head."""
    coat = Stock(surface="coat", density=0.55 * STEEL, edge=0.0006)
    if p.arm == "flat":
        coat = Stock(surface="coat", density=0.45 * ALUMINIUM, edge=0.0006)
    metal = Stock(surface="metal", density=STEEL, edge=0.0)
    knob = Stock(surface="knob", density=ABS, edge=0.0)
    cable = Stock(surface="rubber", density=RUBBER, edge=0.0)
    hollow = 0.35 if p.head == "bar" else 0.8
    shade = Stock(surface="shade" if p.two_tone else "coat", density=hollow * ALUMINIUM, edge=0.0)
    inner = Stock(surface="lining", density=ALUMINIUM, edge=0.0)
    glow = Stock(surface="light", density=0.25 * GLASS, edge=0.0)
    side = 1.0 if p.knob_left else -1.0
    first, second = p.leans
    lower = p.lower_arm.bodies(coat, metal, knob, cable, knob_side=side)
    upper = p.upper_arm.bodies(coat, metal, knob, cable, knob_side=side)
    head = p.lamp_head.bodies(shade, inner, glow, metal)
    return (
        DraftPart(name="turret", label="column", bodies=tuple(p.base.turret(coat, metal))),
        DraftPart(
            name="lower_arm", label="arm", bodies=tuple(placed(lower, first, p.base.pivot)),
            grips=(_grip("lower_arm_bar", p.base.pivot, p.elbow),),
        ),
        DraftPart(
            name="upper_arm", label="arm", bodies=tuple(placed(upper, second, p.elbow)),
            grips=(_grip("upper_arm_bar", p.elbow, p.wrist),),
        ),
        DraftPart(
            name="head", label="head", bodies=tuple(placed(head, 0.0, p.wrist)),
            grips=(_head_grip(p),),
        ),
    )  # fmt: skip


def _grip(name: str, start: tuple[float, float], end: tuple[float, float]) -> Grip:
    """The middle of an arm, pulled forward or up."""
    y, z = ((a + b) / 2.0 for a, b in zip(start, end, strict=True))
    along = (end[0] - start[0], end[1] - start[1])
    length = math.hypot(*along)
    pull = (0.0, -along[1] / length, along[0] / length)
    if name == "upper_arm_bar":
        pull = (0.0, along[1] / length, -along[0] / length)
    return Grip(name=name, kind="handle", position=(0.0, y, z), outward=(1.0, 0.0, 0.0), pull=pull)


def _head_grip(p: DeskLampParams) -> Grip:
    y, z = p.wrist
    bar = p.head == "bar"
    front = p.bar_width if bar else p.shade_radius
    low = p.neck + 0.006 if bar else p.neck + 0.030 + p.shade_depth
    return Grip(
        name="head_rim", kind="rim", position=(0.0, y - front, z - low),
        outward=(0.0, -1.0, 0.0), pull=(0.0, -1.0, 0.0),
    )  # fmt: skip


def _swivel(p: DeskLampParams) -> Joint:
    endless = p.swivel == "endless"
    reach = math.radians(p.swivel_deg)
    return Joint(
        name="turret_swivel",
        type="continuous" if endless else "revolute",
        parent="base",
        child="turret",
        axis=(0.0, 0.0, 1.0),
        origin=(0.0, p.base.post, 0.0),
        limit=None if endless else Limit(lower=-reach, upper=reach),
        friction=0.12,
        damping=0.01,
        effort=2.5,
    )


def _hinges(p: DeskLampParams, lower: DraftPart, upper: DraftPart, head: DraftPart) -> list[Joint]:
    """Forward, up and out by +q; springs carry what hangs on them, friction holds the rest."""
    chain = [
        ("lower_arm", "turret", p.base.pivot, 1.0, (lower, upper, head)),
        ("upper_arm", "lower_arm", p.elbow, -1.0, (upper, head)),
        ("head", "upper_arm", p.wrist, -1.0, (head,)),
    ]
    joints = []
    for (name, parent, at, sign, carried), limit in zip(chain, p.limits, strict=True):
        pivot = (0.0, *at)
        bodies = [body for part in carried for body in part.bodies]
        held = balanced(bodies, pivot=pivot, sign=sign, limit=limit, least=p.lean_friction)
        joints.append(
            Joint(
                name=f"{name}_{'tilt' if name == 'head' else 'hinge'}",
                type="revolute",
                parent=parent,
                child=name,
                axis=(sign, 0.0, 0.0),
                origin=pivot,
                limit=limit,
                friction=held.friction,
                damping=0.05,
                effort=4.0 * held.friction + 2.0 * held.load,
                spring=held.spring,
            )
        )
    return joints
