"""Toilets: a pan with water in it, seat and lid on one pin, a cistern behind or in the wall."""

from collections.abc import Mapping

from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import toilet_params
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cistern import Flushed, Tank, tiled_wall, wall_plate, water_pipe
from artgen.generators.kit.density import RUBBER, ZINC
from artgen.generators.kit.toilet_pan import Pan, bolt_caps
from artgen.generators.kit.toilet_params import ToiletParams, pan_of, seat_set

PARAMS = ToiletParams
INVARIANTS = toilet_params.INVARIANTS
METAL = Stock(surface="metal", density=ZINC, edge=0.0)
CISTERN = 640.0
"""kg/m3; walls of china around water and air."""


def build(p: ToiletParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Lid and seat lift their fronts; the pin lies at y = 0 and the wall behind it."""
    behind = seat_set(p, 0.1).behind + (0.030 if p.flush == "lever" else 0.004)
    china = Stock(surface="china", density=p.china_density, edge=0.0)
    if p.kind == "close_coupled":
        tank = Tank(
            size=(p.tank_width, p.tank_depth, p.tank_height),
            taper=p.taper,
            foot=p.rim_height - 0.001,
            front=behind,
            lid=p.tank_lid,
            over=p.tank_over,
            flush=p.flush,
        )
        back = behind + 0.72 * p.tank_depth
        flushed = tank.made(Stock(surface="china", density=CISTERN), METAL)
        extras = _beside_tank(p, behind)
    else:
        back = behind + p.room
        flushed, extras = _in_wall(p, back)
    pan, seats = pan_of(p, back), seat_set(p, back)
    bodies = (
        *pan.body(china, Stock(surface="water", density=1000.0)),
        *seats.posts(METAL),
        *_feet(p, pan),
        *flushed.base,
        *extras,
    )
    seat, lid = seats.parts(
        Stock(surface="seat", density=1350.0), Stock(surface="rubber", density=RUBBER)
    )
    hinges, rule = seats.joints()
    parts = (DraftPart(name="base", label="base", bodies=bodies), seat, lid, *flushed.parts)
    names = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="toilet",
        parts=parts,
        joints=(*hinges, *flushed.joints),
        surfaces=tuple(spec for role, spec in surfaces.items() if role in names),
        preconditions=(rule,),
    )


def _in_wall(p: ToiletParams, front: float) -> tuple[Flushed, tuple[Body, ...]]:
    """The cistern is hidden: a wall with a flush plate."""
    wall = tiled_wall(
        p.wall_width,
        p.wall_height,
        front=front,
        depth=p.wall_depth,
        tile=(2.0 * p.tile, p.tile),
        stock=Stock(surface="wall", density=420.0, edge=0.002),
    )
    z = min(p.rim_height + p.plate_height, p.wall_height - 0.11)
    plate = wall_plate((0.0, front, z), (0.246, 0.164), dual=p.flush == "dual", metal=METAL)
    return plate, (wall,)


def _beside_tank(p: ToiletParams, front: float) -> tuple[Body, ...]:
    if not p.pipe:
        return ()
    x = -0.5 * p.tank_width * (1.0 - p.taper) + 0.045
    x = min(x, -0.5 * p.rear_share * p.width - 0.016)
    return (water_pipe(x, front + 0.75 * p.tank_depth, p.rim_height + 0.004, metal=METAL),)


def _feet(p: ToiletParams, pan: Pan) -> tuple[Body, ...]:
    """Caps over the screws, low on both sides."""
    if p.kind == "wall_hung":
        return ()
    x = 0.40 * p.width * (1.0 if p.skirted else 0.98)
    return (bolt_caps(min(x, pan.rear_half * 0.97), -0.02, 0.035, stock=METAL),)
