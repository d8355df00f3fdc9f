"""Lids of electric kettles: sprung on a button, pulled up by a tab, or lifted off by a knob."""

import math

from artgen.articulation.types import (
    Body,
    DraftPart,
    Grip,
    Joint,
    Latch,
    Limit,
    Spring,
)
from artgen.generators.kit.density import ABS, RUBBER
from artgen.generators.kit.kettle_jug import EAR, ear_place
from artgen.generators.kit.kettle_params import AFLOAT, FLANGE, KettleParams
from artgen.generators.kit.round_contact import round_boxes, square_box
from artgen.generators.kit.turned_knob import turned_knob
from artgen.geometry.solid import Solid, box, cylinder, revolve, slab, tube, union

PLUG = 0.012
"""m; how deep a lid sits in the mouth."""
PLAY = 0.0012
"""m; between plug and wall."""
KNOB = (0.0150, 0.022)
"""m; radius and height of a lift-off lid's knob."""


def lid_part(p: KettleParams) -> DraftPart:
    """Flange, crown and plug, and what it is taken by."""
    low, r = p.rim + AFLOAT, p.mouth + 0.0010
    inner = p.mouth - p.wall - PLAY
    top = low + FLANGE
    crown = [
        (0.80 * r * math.cos(a), top - 0.0004 + p.crown * math.sin(a))
        for a in (math.pi / 2.0 * k / 6.0 for k in range(7))
    ]
    crown[-1] = (0.0, crown[-1][1])
    outline = [
        (0.0, low - PLUG), (inner - 0.001, low - PLUG), (inner, low - PLUG + 0.001), (inner, low),
        (r - 0.0006, low), (r, low + 0.0006), (r, top - 0.0010), (r - 0.0010, top),
        (0.82 * r, top), *crown,
    ]  # fmt: skip
    cup = tube(0.9 * inner, 0.9 * inner - 0.0015, PLUG + 0.001, segments=32).at(
        z=low - PLUG - 0.001
    )
    hollow = cylinder(inner - 0.0025, PLUG - 0.0015, segments=40).at(z=low - PLUG - 0.001)
    shell = revolve(outline, segments=56) - hollow
    seal = tube(inner + 0.0002, inner - 0.0012, 0.003, segments=56).at(z=low - 0.008)
    flange = round_boxes(r, low, top)
    plug = square_box(0.86 * inner, low - PLUG, low)
    bodies = [
        Body(solid=shell, surface="lid", density=0.8 * ABS, collision=(*flange, plug)),
        Body(solid=cup, surface="lid", density=ABS),
        Body(solid=seal, surface="rubber", density=RUBBER),
    ]
    if p.lid == "knob":
        return _lifted(p, bodies, top + p.crown)
    bodies.append(_knuckle(p, top))
    if p.lid == "tab":
        bodies.append(_tab(p, top))
    grip = Grip(
        name="lid_edge",
        kind="edge",
        position=(0.0, -p.mouth, top),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
    return DraftPart(name="lid", label="lid", bodies=tuple(bodies), grips=(grip,))


def _lifted(p: KettleParams, bodies: list[Body], top: float) -> DraftPart:
    knob, contact = turned_knob(*KNOB)
    body = Body(
        solid=knob.at(z=top - 0.0008),
        surface="trim",
        density=ABS,
        collision=tuple(piece.at(z=top - 0.0008) for piece in contact),
    )
    grip = Grip(
        name="lid_knob", kind="knob", position=(0.0, 0.0, top + 0.7 * KNOB[1]),
        outward=(0.0, 0.0, 1.0), pull=(0.0, 0.0, 1.0),
    )  # fmt: skip
    return DraftPart(name="lid", label="lid", bodies=(*bodies, body), grips=(grip,))


def _knuckle(p: KettleParams, top: float) -> Body:
    """The barrel between the ears, and the tongue that joins it to the flange."""
    y, z = p.hinge
    half = ear_place(p) - 0.0010
    barrel = cylinder(EAR - 0.0012, 2.0 * half, axis="x", segments=18).at(-half, y, z)
    tongue = slab((-half, p.mouth - 0.006, z - FLANGE), (half, y, z))
    core = slab((-half, p.mouth - 0.004, z - FLANGE), (half, y + 0.0016, z))
    return Body(solid=union([barrel, tongue]), surface="lid", density=ABS, collision=(core,))


def _tab(p: KettleParams, top: float) -> Body:
    """A tongue over the pouring lip, turned up for a thumb."""
    r = p.mouth
    flat = box((0.020, 0.010, FLANGE), at=(0.0, -r - 0.002, top - FLANGE))
    rise: Solid = box((0.020, 0.0034, 0.010), at=(0.0, -r - 0.0053, top - FLANGE))
    touch = slab((-0.010, -r - 0.007, top - FLANGE), (0.010, -r + 0.002, top + 0.0068))
    return Body(solid=flat | rise, surface="lid", density=ABS, edge=0.0008, collision=(touch,))


def lid_joint(p: KettleParams, parent: str) -> Joint:
    """Turned up about the axis above the handle, or lifted straight off."""
    if p.lid == "knob":
        return Joint(
            name="lid_lift", type="prismatic", parent=parent, child="lid", axis=(0.0, 0.0, 1.0),
            limit=Limit(lower=0.0, upper=PLUG + KNOB[1]), friction=0.6, damping=2.0, effort=20.0,
            velocity=0.6,
        )  # fmt: skip
    y, z = p.hinge
    upper = math.radians(p.opening_deg)
    sprung = p.lid == "button"
    return Joint(
        name="lid_hinge",
        type="revolute",
        parent=parent,
        child="lid",
        axis=(-1.0, 0.0, 0.0),
        origin=(0.0, y, z),
        limit=Limit(lower=0.0, upper=upper),
        friction=0.03 if sprung else 0.08,
        damping=0.01,
        effort=3.0,
        spring=Spring(stiffness=0.05, reference=1.2 + upper) if sprung else None,
        latch=Latch(force=0.5 if sprung else 0.15, reach=0.06),
    )
