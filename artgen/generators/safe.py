"""Safes: a door on barrels or hidden pins; a handle draws its bolts before it swings."""

import math
from collections.abc import Mapping

from artgen.articulation.types import (
    Body,
    Draft,
    DraftPart,
    Grip,
    Joint,
    Limit,
    Mimic,
    Precondition,
)  # fmt: skip
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import safe_layout
from artgen.generators.kit.boltwork import Boltwork
from artgen.generators.kit.density import STEEL, ZINC
from artgen.generators.kit.mirror_image import mirrored_body
from artgen.generators.kit.safe_case import AIR, Case, anchors, barrel_pair, carpet, feet, shell
from artgen.generators.kit.safe_case import shelves as shelf_sheets
from artgen.generators.kit.safe_door import DoorFittings, door_plate, door_signs
from artgen.generators.kit.safe_layout import SafeParams, case_of, fittings_of, works_of
from artgen.generators.kit.safe_lock import lock
from artgen.generators.kit.turn_handle import turn_handle
from artgen.geometry.solid import union

PARAMS = SafeParams
INVARIANTS = safe_layout.INVARIANTS
LOCKED = 0.98
"""Share of the handle's turn from which the bolts clear the frame."""


def build(p: SafeParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Drawn with the hinge at -x; what has no writing is mirrored where it is at +x."""
    case, side = case_of(p), -1.0 if p.hinge == "left" else 1.0
    works, at = works_of(p, case), fittings_of(p, case, side)
    own = lock(p.lock, at.lock_plane, trim="trim", mark="mark", handle="handle", size=p.dial_size)
    signs, labels = door_signs(case, works, at, p.brand)
    end = min(0.045, (case.high - case.low) / 2.0 - 0.031)  # Low doors: 60 mm each, 2 mm apart.
    pairs = [] if p.hinges == "hidden" else [
        barrel_pair(-case.opening_x - p.gap / 2.0, p.barrel, z, gap=p.gap)
        for z in (case.low + end, case.high - end)
    ]  # fmt: skip
    iron = [Body(solid=union(moved), surface="handle", density=STEEL) for _, moved in pairs]
    base = [
        shell(case, "case"),
        *shelf_sheets(case, "inside", count=p.shelves, front=works.back + 0.03),
    ]
    base += [carpet(case, "carpet"), anchors(case, "bolt")] if p.carpet else []
    base += feet(case, "trim")
    base += [Body(solid=union(fixed), surface="handle", density=STEEL) for fixed, _ in pairs]
    drawn, touch = works.bolts()
    bolts = Body(solid=drawn, surface="bolt", density=STEEL, collision=touch)
    plate = door_plate(case, works, at, gap=p.gap, side=side, dial=p.lock == "dial")
    parts = (
        DraftPart(name="base", label="base", bodies=handed(base, side)),
        DraftPart(
            name="door", label="door", bodies=(*plate, *handed(iron, side), *own.bodies, *signs),
            grips=(at.edge(-side * works.far),),
        ),
        handle_part(p, case, at),
        DraftPart(name="bolts", label="latch", bodies=handed([bolts], side)),
        *((own.part,) if own.part else ()),
    )  # fmt: skip
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="safe",
        parts=parts,
        joints=(*joints(p, case, works, at, side), *((own.joint,) if own.joint else ())),
        surfaces=tuple(
            surface
            for surface in (*surfaces.values(), *own.surfaces, *labels)
            if surface.name in worn
        ),
        preconditions=(
            Precondition(
                joint="door_hinge", requires="handle_turn",
                at_least=LOCKED * math.radians(p.turn_deg),
            ),
        ),
    )  # fmt: skip


def handed(bodies: list[Body], side: float) -> tuple[Body, ...]:
    """Bodies drawn for a hinge at -x, for one at `side`."""
    return tuple(bodies) if side < 0.0 else tuple(mirrored_body(body) for body in bodies)


def handle_part(p: SafeParams, case: Case, at: DoorFittings) -> DraftPart:
    """The handle on its shaft through the plate."""
    plane, stand = at.handle_plane, 0.006
    solid, touch = turn_handle(p.handle, p.handle_size, shaft=stand + case.lip - 0.0005)
    body = Body(
        solid=plane.placed(solid.at(z=stand)), surface="handle", density=ZINC, edge=0.0012,
        collision=tuple(plane.placed(piece.at(z=stand)) for piece in touch),
    )  # fmt: skip
    place = plane.point(0.55 * p.handle_size, 0.0, stand + 0.026)
    grip = Grip(
        name="handle_grip", kind="lever", position=place, outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, -1.0),
    )  # fmt: skip
    return DraftPart(name="handle", label="lever", bodies=(body,), grips=(grip,))


def joints(
    p: SafeParams, case: Case, works: Boltwork, at: DoorFittings, side: float
) -> tuple[Joint, ...]:
    """The hinge, the handle, and the bolts that follow it."""
    turn, hidden = math.radians(p.turn_deg), p.hinges == "hidden"
    pivot = (side * (case.opening_x + p.gap / 2.0), 0.0 if hidden else -p.barrel - AIR, 0.0)
    return (
        Joint(
            name="door_hinge", type="revolute", parent="base", child="door",
            axis=(0.0, 0.0, side),  # +q turns the free edge from +-x towards the front, -y
            origin=pivot, limit=Limit(lower=0.0, upper=math.radians(p.opening_deg)),
            friction=p.door_drag, damping=0.4, effort=40.0,
        ),
        Joint(
            name="handle_turn", type="revolute", parent="door", child="handle",
            axis=(0.0, 1.0, 0.0),  # clockwise, seen from the front
            origin=at.handle_plane.origin, limit=Limit(lower=0.0, upper=turn),
            friction=0.5, damping=0.02, effort=8.0,
        ),
        Joint(
            name="bolts_slide", type="prismatic", parent="door", child="bolts",
            axis=(side, 0.0, 0.0), limit=Limit(lower=0.0, upper=works.travel),
            friction=1.0, damping=2.0, effort=80.0, velocity=0.5,
            mimic=Mimic(joint="handle_turn", multiplier=works.travel / turn),
        ),
    )  # fmt: skip
