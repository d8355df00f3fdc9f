"""Folding chairs of wood or steel tube: rear legs that close onto the frame and lift the seat."""

from collections.abc import Mapping

from artgen.articulation.types import Draft, DraftPart, Grip, Joint, Latch, Limit, Mimic
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import folding_chair_design
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import OAK, POLYPROPYLENE, RUBBER, STEEL
from artgen.generators.kit.folding_chair_design import FoldingChairParams

PARAMS = FoldingChairParams
INVARIANTS = folding_chair_design.INVARIANTS
TUBE = 1750.0
"""kg/m3 over the whole section: steel of 1.2 mm around air."""
FOAM = 120.0
SHEET = 1500.0
"""kg/m3; a steel sheet of 0.8 mm with rolled edges, drawn 10 mm thick."""


def build(p: FoldingChairParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest it stands unfolded on four feet; +q folds the rear legs, and the seat follows."""
    frame, seat = p.frame, p.chair_seat
    wood = p.make == "wood"
    bar = Stock(surface="wood", density=OAK, edge=0.0025)
    tube = Stock(surface="coat", density=TUBE, edge=0.0)
    member = bar if wood else tube
    board = _board(p)
    metal = Stock(surface="metal", density=STEEL, edge=0.0)
    rubber = Stock(surface="rubber", density=RUBBER, edge=0.0)
    soft = Stock(surface=_cover(p), density=FOAM, edge=0.0)
    cord = Stock(surface="rubber", density=400.0, edge=0.0)
    rail = Stock(surface="wood", density=OAK, edge=0.002) if wood else Stock(
        surface="coat", density=TUBE, edge=0.001
    )  # fmt: skip
    base = DraftPart(
        name="base",
        label="base",
        bodies=tuple(frame.base_bodies(member, metal, rubber, board, soft)),
        grips=(_back_grip(p),),
    )
    legs = DraftPart(
        name="rear_legs", label="leg", bodies=tuple(frame.leg_bodies(member, metal, rubber))
    )
    seat_part = DraftPart(
        name="seat",
        label="seat",
        bodies=tuple(seat.bodies(rail, board, soft, cord, metal)),
        grips=(_seat_grip(p),),
    )
    parts = (base, legs, seat_part)
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="folding_chair",
        parts=parts,
        joints=_joints(p),
        surfaces=tuple(spec for role, spec in surfaces.items() if role in worn),
    )


def _joints(p: FoldingChairParams) -> tuple[Joint, Joint]:
    """The rear legs fold; the seat, hinged to them, follows."""
    link = p.linkage
    fold = Joint(
        name="rear_legs_fold",
        type="revolute",
        parent="base",
        child="rear_legs",
        axis=(-1.0, 0.0, 0.0),
        origin=(0.0, *link.cross),
        limit=Limit(lower=0.0, upper=link.spread),
        friction=p.friction,
        damping=0.4,
        effort=12.0 * p.friction,
        latch=Latch(force=p.catch, reach=0.06),
    )
    follow = Joint(
        name="seat_fold",
        type="revolute",
        parent="rear_legs",
        child="seat",
        axis=(1.0, 0.0, 0.0),
        origin=(0.0, *link.hinge),
        limit=Limit(lower=0.0, upper=link.ratio * link.spread),
        friction=0.3,
        damping=0.05,
        effort=20.0,
        mimic=Mimic(joint="rear_legs_fold", multiplier=link.ratio),
    )
    return fold, follow


def _cover(p: FoldingChairParams) -> str:
    """What pads are covered with."""
    return "fabric" if p.make == "wood" else "vinyl"


def _board(p: FoldingChairParams) -> Stock:
    """What seat and back are made of."""
    if p.seat == "plastic":
        return Stock(surface="plastic", density=POLYPROPYLENE, edge=0.0)
    if p.make == "wood" or p.seat == "slats":
        return Stock(surface="wood", density=OAK, edge=0.002 if p.seat == "slats" else 0.0)
    return Stock(surface="coat", density=SHEET, edge=0.0)


def _back_grip(p: FoldingChairParams) -> Grip:
    y, z = p.frame.back_top
    return Grip(
        name="back_rim",
        kind="rim",
        position=(0.0, y, z),
        outward=(0.0, 0.0, 1.0),
        pull=(0.0, 0.0, 1.0),
    )


def _seat_grip(p: FoldingChairParams) -> Grip:
    return Grip(
        name="seat_rear_edge",
        kind="edge",
        position=(0.0, p.linkage.run + p.seat_rear, p.chair_seat.top - 0.008),
        outward=(0.0, 1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
