"""The sliding racks of a dishwasher: lower rack on wheels, upper rack and cutlery tray on rails."""

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip
from artgen.generators.kit.cutlery_basket import cup_shelf, cutlery_basket, cutlery_comb
from artgen.generators.kit.density import ABS, POLYPROPYLENE
from artgen.generators.kit.dishwasher_layout import RACK_GAP, DishwasherParams, Layout
from artgen.generators.kit.rack_wheel import rack_wheel
from artgen.generators.kit.wire_rack import WireBasket, basket_collision, basket_wires, tines
from artgen.geometry.solid import Solid, slab, union

COATED_WIRE = 6200.0
"""kg/m3; steel wire in 0.3 mm of nylon."""
WHEEL = 0.0185
"""m; radius."""
RAIL_HALF = 0.006
"""m; half height of the bar that runs in a rail."""


def lower_basket(p: DishwasherParams, at: Layout) -> WireBasket:
    """The wires of the lower rack."""
    rack, floor = at.rack, at.track + 0.040
    return WireBasket(
        half_width=rack.half_width,
        front=rack.front,
        back=rack.back,
        floor=floor,
        rim_front=floor + 0.105,
        rim_back=floor + 0.150,
        radius=p.wire,
        lengthwise=_count(2 * rack.half_width, p.pitch),
        crosswise=_count(rack.back - rack.front, p.pitch),
    )


def upper_basket(p: DishwasherParams, at: Layout) -> WireBasket:
    """The wires of the upper rack; its floor rises to the middle."""
    rack, floor = at.rack, at.upper_floor
    return WireBasket(
        half_width=rack.half_width,
        front=rack.front,
        back=rack.back,
        floor=floor,
        crown=0.018,
        rim_front=floor + 0.085,
        rim_back=floor + 0.125,
        radius=0.95 * p.wire,
        lengthwise=_count(2 * rack.half_width, 1.1 * p.pitch),
        crosswise=_count(rack.back - rack.front, 1.1 * p.pitch),
    )


def tray_basket(p: DishwasherParams, at: Layout) -> WireBasket:
    """The wires of the cutlery tray."""
    rack, floor = at.rack, at.tray_floor
    return WireBasket(
        half_width=rack.half_width,
        front=rack.front,
        back=rack.back,
        floor=floor,
        rim_front=floor + 0.044,
        rim_back=floor + 0.044,
        radius=0.85 * p.wire,
        lengthwise=_count(2 * rack.half_width, 0.9 * p.pitch),
        crosswise=5,
        belts=0,
    )


def _count(span: float, pitch: float) -> int:
    return max(5, round((span - 0.05) / pitch) + 1)


def lower_rack(p: DishwasherParams, at: Layout) -> DraftPart:
    """The rack that rolls out over the open door: plate pins, wheels, perhaps a cutlery basket."""
    basket = lower_basket(p, at)
    wires = [*basket_wires(basket), *_plate_pins(p, basket)]
    bodies = [_wired(wires, "rack_wire", basket), _plastic(_wheels(p, at), "rack_plastic")]
    bodies.append(_grip(basket))
    if p.cutlery != "tray":
        bodies.append(_plastic([_cutlery(p, basket)], "rack_plastic", POLYPROPYLENE))
    return DraftPart(
        name="lower_rack", label="rack", bodies=tuple(bodies), grips=_holds("lower_rack", basket)
    )


def _wired(wires: list[Solid], surface: str, basket: WireBasket) -> Body:
    return Body(
        solid=union(wires),
        surface=surface,
        density=COATED_WIRE,
        collision=basket_collision(basket),
    )


def _plastic(solids: list[Solid], surface: str, density: float = ABS) -> Body:
    return Body(solid=union(solids), surface=surface, density=density)


def _plate_pins(p: DishwasherParams, basket: WireBasket) -> list[Solid]:
    """Rows of pins along the lanes, between the rungs; none where the cutlery basket stands."""
    rows = [basket.lanes[k] for k in _spread(len(basket.lanes), p.tine_rows)]
    middles = (basket.rungs[1:] + basket.rungs[:-1]) / 2.0
    gap = basket.rungs[1] - basket.rungs[0]
    ys = np.sort(np.concatenate([middles - gap / 4.0, middles + gap / 4.0]))[1:-1]
    reserved = _cutlery_room(p, basket)
    made: list[Solid] = []
    for x in rows:
        free = [float(y) for y in ys if not (x > reserved[0] and y < reserved[1])]
        made += tines(basket, [float(x)], free, height=p.tine_height, lean=0.010)
    return made


def _spread(count: int, chosen: int) -> list[int]:
    """`chosen` indices evenly among 1 ... count - 2."""
    return sorted({round(k) for k in np.linspace(1, count - 2, min(chosen, count - 2))})


def _cutlery_room(p: DishwasherParams, basket: WireBasket) -> tuple[float, float]:
    """(x, y): the cutlery basket stands right of x and in front of y."""
    if p.cutlery == "tray":
        return np.inf, -np.inf
    return basket.half_width - 0.120, basket.front + 0.285


def _cutlery(p: DishwasherParams, basket: WireBasket) -> Solid:
    made = cutlery_basket(length=0.225, width=0.080, height=0.115, cells=3 if p.slim else 4)
    x = basket.half_width - 0.062
    return made.at(x, basket.front + 0.150, basket.top_of_floor(x))


def _wheels(p: DishwasherParams, at: Layout) -> list[Solid]:
    """Rollers on both sides, the foremost and hindmost near the ends."""
    rack, outer = at.rack, at.tub.half_width - 0.0075
    ys = np.linspace(rack.front + 0.055, rack.back - 0.060, p.wheels)
    right = [
        piece
        for y in ys
        for piece in rack_wheel(
            x=outer - 0.0085,
            y=float(y),
            z=at.track + RACK_GAP + WHEEL,
            radius=WHEEL,
            outer=outer,
            mount=rack.half_width + 1.2 * p.wire,
        )
    ]
    return [*right, *(piece.mirrored("x") for piece in right)]


def _grip(basket: WireBasket) -> Body:
    """A plastic clip on the middle of the front rim to pull at."""
    half, z = 0.24 * basket.half_width, basket.rim_front
    front = basket.front - 1.6 * basket.radius - 0.007
    solid = slab((-half, front, z - 0.026), (half, front + 0.007, z + 0.006))
    return Body(solid=solid, surface="rack_plastic", density=ABS, edge=0.0022)


def _holds(name: str, basket: WireBasket) -> tuple[Grip, ...]:
    """The clip on the front rim, taken from the front."""
    out = (0.0, -1.0, 0.0)
    front = basket.front - 1.6 * basket.radius - 0.0035
    place = (0.0, front, basket.rim_front - 0.010)
    return (Grip(name=f"{name}_rim", kind="rim", position=place, outward=out, pull=out),)


def upper_rack(p: DishwasherParams, at: Layout) -> DraftPart:
    """The rack on rails: pins for cups, cup shelves, the feed pipe of the spray arm below it."""
    basket = upper_basket(p, at)
    third = round(len(basket.lanes) / 3)
    rows = [float(basket.lanes[third]), float(basket.lanes[-1 - third])]
    ys = ((basket.rungs[1:] + basket.rungs[:-1]) / 2.0)[1:-1]
    pins = tines(basket, rows, [float(y) for y in ys], height=0.045, lean=0.006)
    plastic = [*_rail_bars(at, basket, rail_height(basket)), *_shelves(p, basket), *_feed(at)]
    bodies = (
        _wired([*basket_wires(basket), *pins], "rack_wire", basket),
        _plastic(plastic, "rack_plastic", POLYPROPYLENE),
        _grip(basket),
    )
    return DraftPart(
        name="upper_rack", label="rack", bodies=bodies, grips=_holds("upper_rack", basket)
    )


def rail_height(basket: WireBasket) -> float:
    """z of the rails that carry a basket."""
    return basket.floor + 0.55 * (basket.rim_front - basket.floor)


def _rail_bars(at: Layout, basket: WireBasket, z: float) -> list[Solid]:
    """Bars that run in the tub's rails, with three brackets to the wires on each side."""
    outer, near = at.tub.half_width - 0.0048, at.tub.half_width - 0.0175
    mount = basket.half_width + 1.2 * basket.radius
    bar = slab((near, basket.front + 0.004, z - RAIL_HALF), (outer, basket.back, z + RAIL_HALF))
    brackets = [
        slab((mount, y - 0.012, z - 0.010), (near, y + 0.012, z + 0.014))
        for y in np.linspace(basket.front + 0.05, basket.back - 0.05, 3)
    ]
    right = [bar, *brackets]
    return [*right, *(piece.mirrored("x") for piece in right)]


def _shelves(p: DishwasherParams, basket: WireBasket) -> list[Solid]:
    """Cup shelves inside the side walls, hung at half height."""
    length = 0.62 * (basket.back - basket.front)
    shelf = cup_shelf(length=length, width=0.092, thickness=0.004, bars=7)
    y, z = basket.front + 0.56 * (basket.back - basket.front), basket.floor + 0.078
    x = -basket.half_width + 4.2 * basket.radius
    left = shelf.turned("y", 0.10).at(x, y, z)
    return [left, left.mirrored("x")][: p.shelves]


def _feed(at: Layout) -> list[Solid]:
    """The water pipe under the rack: from the rear wall to above the spray arm's hub."""
    x, y = at.tub.sump
    z = at.upper_floor - 0.017
    return [
        slab((x - 0.011, y - 0.024, z - 0.008), (x + 0.011, at.rack.back + 0.006, z + 0.008)),
        slab((x - 0.020, y - 0.020, z - 0.012), (x + 0.020, y + 0.020, z + 0.0125)),
    ]


def cutlery_tray(p: DishwasherParams, at: Layout) -> DraftPart:
    """The shallow third rack with toothed rails for cutlery."""
    basket = tray_basket(p, at)
    width = 2.0 * (basket.half_width - basket.inset - 0.012)
    comb = cutlery_comb(length=0.030, width=width, height=0.019, teeth=7 if p.slim else 10)
    rest = basket.top_of_floor(0.0)
    combs = [comb.at(0.0, y, rest) for y in np.linspace(basket.front + 0.11, basket.back - 0.11, 2)]
    bodies = (
        _wired(basket_wires(basket), "rack_wire", basket),
        _plastic([*_rail_bars(at, basket, rail_height(basket)), *combs], "rack_plastic"),
        _grip(basket),
    )
    return DraftPart(
        name="cutlery_tray", label="tray", bodies=bodies, grips=_holds("cutlery_tray", basket)
    )


def side_rails(at: Layout, basket: WireBasket) -> list[Solid]:
    """The tub's rails for a basket: channels open to the inside, around the bars with play."""
    wall, z = at.tub.half_width, rail_height(basket)
    near, play = wall - 0.0145, RAIL_HALF + 0.0016
    low, high = (
        (near, basket.front - 0.006, z - play - 0.0022),
        (wall, at.tub.depth, z + play + 0.0022),
    )
    room = slab((near - 0.01, low[1] - 0.01, z - play), (wall - 0.0032, high[1] + 0.01, z + play))
    right = slab(low, high) - room
    return [right, right.mirrored("x")]
