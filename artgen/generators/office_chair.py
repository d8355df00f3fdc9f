"""Office chairs: five casters, gas lift, swiveling seat, tilting back, arms and headrest."""

from collections.abc import Mapping

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import office_chair_design
from artgen.generators.kit.board import Stock
from artgen.generators.kit.caster import CasterLook, quarter_placed
from artgen.generators.kit.counterbalance import weighed
from artgen.generators.kit.density import STEEL
from artgen.generators.kit.gas_lift import TUBE
from artgen.generators.kit.mirror_image import mirrored_body, mirrored_joint, mirrored_part
from artgen.generators.kit.office_back_works import (
    back_grip,
    headrest,
    headrest_guide,
    headrest_joint,
    spine,
    tilt_joint,
)
from artgen.generators.kit.office_chair_design import OfficeChairParams

PARAMS = OfficeChairParams
INVARIANTS = office_chair_design.INVARIANTS
FOAM = 130.0
"""kg/m3; seat foam of 55 with its cover and the ply or plastic inside."""


def build(p: OfficeChairParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the seat is lowest and faces forward, the back is upright, arms and head are low."""
    cover = Stock(surface=p.cloth, density=FOAM, edge=0.0)
    seat, arm = p.seat, p.armrest
    sides: list[Body] = []
    if p.arms != "none":
        fixed = arm.sleeve(_HARD) if p.arms == "adjustable" else arm.loop(_HARD, _SOFT)
        sides = [*fixed, *map(mirrored_body, fixed)]
    bodies = [*seat.bodies(cover, _CORD, _HARD, _DARK, tuple(p.levers.values())), *sides]
    moving, joints = _above(p, cover)
    seat_part = DraftPart(name="seat", label="seat", bodies=tuple(bodies))
    column = p.lift.part(_ROD, _HARD)
    carried = sum(weighed(part.bodies)[0] for part in (seat_part, column, *moving))
    casters, turning = _casters(p)
    parts = (_base(p), *casters, column, seat_part, *moving)
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="office_chair",
        parts=parts,
        joints=(
            *turning,
            p.lift.joint(carried, friction=p.lift_friction),
            _swivel(),
            *joints,
        ),
        surfaces=tuple(spec for role, spec in surfaces.items() if role in worn),
        preconditions=(
            Precondition(joint="column_lift", requires="lift_lever_pull", at_least=0.10),
        ),
    )


_HARD = Stock(surface="hard", density=950.0, edge=0.0015)
_SOFT = Stock(surface="hard", density=500.0, edge=0.0)
_DARK = Stock(surface="hard", density=1900.0, edge=0.0015)
_CORD = Stock(surface="cord", density=500.0, edge=0.0)
_ROD = Stock(surface="chrome", density=0.55 * STEEL, edge=0.0)


def _base(p: OfficeChairParams) -> DraftPart:
    star = Stock(surface="star", density=1150.0, edge=0.0)
    tube = Stock(surface="hard", density=5500.0, edge=0.0)
    bodies = (p.star.body(star, TUBE - 0.001), p.lift.tube_body(tube))
    return DraftPart(name="base", label="base", bodies=bodies)


def _casters(p: OfficeChairParams) -> tuple[list[DraftPart], list[Joint]]:
    """A caster under each arm, its wheels in it."""
    look = CasterLook(
        hood=Stock(surface="hard", density=1150.0, edge=0.0),
        tread=Stock(surface="tread", density=1150.0, edge=0.0),
        hub=Stock(surface="hard", density=1100.0, edge=0.0),
        stem=Stock(surface="chrome", density=STEEL, edge=0.0),
    )
    parts: list[DraftPart] = []
    joints: list[Joint] = []
    for k, ((x, y), turn) in enumerate(zip(p.star.feet(), p.caster_turns, strict=True), start=1):
        place = quarter_placed((x, y, 0.0), turn)
        parts += [
            p.caster.swivel_part(f"caster_{k}", place, look),
            p.caster.wheel_part(f"wheel_{k}", place, look),
        ]
        joints += p.caster.joints(f"caster_{k}", f"wheel_{k}", place, parent="base")
    return parts, joints


def _above(p: OfficeChairParams, cover: Stock) -> tuple[list[DraftPart], list[Joint]]:
    """What moves on the seat: back, headrest, armrests and levers."""
    seat, back = p.seat, p.chair_back
    net = Stock(surface="net", density=500.0, edge=0.0)
    bodies = back.bodies(net if p.back == "net" else cover, _HARD, _CORD)
    bodies += spine(seat, back, _HARD, width=p.spine_width)
    parts: list[DraftPart] = []
    joints = [tilt_joint(seat, reach=p.tilt, preload=p.tilt_preload)]
    if p.headrest:
        bodies += headrest_guide(back, _HARD)
        size = (0.27, p.head_height, 0.055)
        parts.append(headrest(back, _HARD, cover, _CORD, size=size))
        joints.append(headrest_joint(travel=p.head_travel))
    tilting = DraftPart(
        name="backrest", label="backrest", bodies=tuple(bodies), grips=(back_grip(back),)
    )
    if p.arms == "adjustable":
        left = p.armrest.part("armrest_left", _HARD, _SOFT)
        right = mirrored_part(p.armrest.part("armrest_right", _HARD, _SOFT))
        parts += [left, right]
        joints += [
            p.armrest.joint("armrest_left"),
            mirrored_joint(p.armrest.joint("armrest_right")),
        ]
    for name, side in p.levers.items():
        parts.append(seat.lever_part(name, side, 0.46 * p.seat_width, _ROD, _HARD))
        joints.append(seat.lever_joint(name, side))
    return [tilting, *parts], joints


def _swivel() -> Joint:
    return Joint(
        name="seat_swivel",
        type="continuous",
        parent="column",
        child="seat",
        axis=(0.0, 0.0, 1.0),
        limit=None,
        friction=0.6,
        damping=0.15,
        effort=25.0,
        velocity=6.0,
    )
