"""The fixed part of a dishwasher, and the spray arms."""

from artgen.articulation.types import Body, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.appliance_cabinet import (
    SHEET,
    cabinet_collision,
    chassis,
    feet,
    kick_plate,
    shell,
    worktop,
)
from artgen.generators.kit.density import ABS, POLYPROPYLENE, STAINLESS, STEEL
from artgen.generators.kit.dishwasher_layout import SEAL, DishwasherParams, Layout
from artgen.generators.kit.dishwasher_racks import side_rails, tray_basket, upper_basket
from artgen.generators.kit.drop_door import hinge_ears
from artgen.generators.kit.gasket import opening_gasket
from artgen.generators.kit.spray_arm import spray_arm, swept_collision
from artgen.generators.kit.washing_tub import Tub, filter_cup, salt_cap, tub_solid
from artgen.geometry.solid import Solid, cylinder, slab, union

CABINET_SHEET = 0.0006
"""m; galvanized steel of the cabinet."""
TUB_SHEET = 0.00045
"""m; stainless steel of the tub."""
BITUMEN = 3.4
"""kg/m2; damping mats glued to the tub."""
FRAME = 1.2
"""kg; the frame around the tub's mouth."""
PLASTIC_TUB = 0.0030
"""m; polypropylene of a molded tub."""
FOOT = 0.018
"""m; radius."""
ARM = 0.011
"""m; thickness of a spray arm."""
HUB = 0.024


def base(p: DishwasherParams, at: Layout, surfaces: dict[str, SurfaceSpec]) -> DraftPart:
    """Cabinet, tub, seal, rails, kick plate, feet; the machine room as one block of its mass."""
    cabinet, tub = at.cabinet, at.tub
    vessel = tub_solid(tub, flange=_flange(at))
    block = chassis(cabinet, top=tub.floor - 0.060)
    steel = STEEL * CABINET_SHEET / SHEET
    bodies = [
        Body(
            solid=shell(cabinet),
            surface="side",
            density=steel,
            edge=0.0012,
            collision=cabinet_collision(
                cabinet,
                cavity_half_width=tub.half_width,
                cavity_depth=tub.depth,
                floor=tub.floor - 0.001,
                ceiling=tub.ceiling,
                foot_radius=FOOT,
            ),
        ),
        Body(
            solid=block,
            surface="kick",
            density=p.equipment * (0.8 if p.slim else 1.0) / block.volume,
        ),
        Body(
            solid=vessel,
            surface="tub",
            density=_tub_density(tub, vessel, metallic=surfaces["tub"].metallic > 0.5),
        ),
        _seal(p, at, surfaces["seal"]),
        Body(solid=union(_fittings(p, at)), surface="metal", density=STAINLESS),
        Body(solid=filter_cup(tub), surface="rack_plastic", density=POLYPROPYLENE),
        Body(solid=salt_cap(tub), surface="seal", density=POLYPROPYLENE),
        Body(
            solid=kick_plate(cabinet, thickness=0.006, slots=p.slots),
            surface="kick",
            density=0.4 * ABS,
        ),
        Body(solid=union(feet(cabinet, radius=FOOT)), surface="kick", density=POLYPROPYLENE),
    ]
    if p.has_worktop:
        bodies.append(_worktop(p, at))
    return DraftPart(name="base", label="base", bodies=tuple(bodies))


def _flange(at: Layout) -> Solid:
    """The frame between the tub's mouth and the cabinet, with the sill that reaches down behind
    the door."""
    half, depth = at.cabinet.half_width - SHEET, 0.022
    low, high = at.cabinet.toe_height, at.cabinet.top - SHEET
    return slab((-half, 0.0, low), (half, depth, high))


def _tub_density(tub: Tub, solid: Solid, *, metallic: bool) -> float:
    """kg/m3 that gives the drawn tub the mass of the real sheet, its mats and its frame."""
    sheet = STAINLESS * TUB_SHEET if metallic else POLYPROPYLENE * PLASTIC_TUB
    width, height = 2.0 * tub.half_width, tub.ceiling - tub.floor
    area = 2.0 * (width + height) * tub.depth + width * height
    return (area * (sheet + BITUMEN) + FRAME) / solid.volume


def _seal(p: DishwasherParams, at: Layout, rubber: SurfaceSpec) -> Body:
    tub, room = at.tub, min(0.009, p.wall - 0.008)
    return opening_gasket(
        left=-tub.half_width - 0.003,
        right=tub.half_width + 0.003,
        bottom=tub.floor + 0.004,
        top=tub.ceiling + 0.003,
        corner=tub.corner,
        width=room,
        thickness=SEAL,
        front=0.0,
        surface=rubber,
    )


def _fittings(p: DishwasherParams, at: Layout) -> list[Solid]:
    """Rails, hinge ears, the shower head under the ceiling."""
    rails = side_rails(at, upper_basket(p, at))
    if p.cutlery != "basket":
        rails += side_rails(at, tray_basket(p, at))
    x, y = at.tub.sump
    shower = cylinder(0.026, 0.012, segments=20).at(x, y, at.tub.ceiling - 0.012)
    return [*rails, *hinge_ears(at.door, back=0.0), shower]


def _worktop(p: DishwasherParams, at: Layout) -> Body:
    low, half = at.cabinet.top, at.cabinet.half_width
    board = worktop(
        half_width=half, front=at.door.outer, back=at.cabinet.depth, bottom=low, top=at.top
    )
    return Body(
        solid=board,
        surface="worktop",
        density=430.0,  # particleboard frame with a plastic rim, hollow below
        edge=0.003,
        collision=(slab((-half, at.door.outer, low), (half, at.cabinet.depth, at.top)),),
    )


def lower_arm(p: DishwasherParams, at: Layout) -> DraftPart:
    """The arm that turns over the sump."""
    return _arm(at, name="lower_spray_arm", z=at.track + 0.010, blades=p.blades, rise=0.004)


def upper_arm(p: DishwasherParams, at: Layout) -> DraftPart:
    """The arm that turns under the upper rack and rides with it."""
    z = at.upper_floor - 0.0305 - 0.006 - ARM
    return _arm(at, name="upper_spray_arm", z=z, blades=2, rise=0.006)


def _arm(at: Layout, *, name: str, z: float, blades: int, rise: float) -> DraftPart:
    x, y = at.tub.sump
    reach = min(at.tub.half_width, 0.46 * at.tub.depth) - 0.052
    solid = spray_arm(reach=reach, blades=blades, thickness=ARM, hub=HUB, rise=rise)
    boxes = swept_collision(reach=reach, blades=blades, thickness=ARM, hub=HUB)
    body = Body(
        solid=solid.at(x, y, z),
        surface="arm",
        density=0.55 * ABS,  # hollow
        collision=tuple(piece.at(x, y, z) for piece in boxes),
    )
    return DraftPart(name=name, label="spray_arm", bodies=(body,))


def arm_pivot(at: Layout) -> tuple[float, float, float]:
    """A point on the axis of both arms."""
    return (*at.tub.sump, 0.0)
