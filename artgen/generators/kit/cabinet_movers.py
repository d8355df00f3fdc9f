"""Drawers and doors of a cabinet: each with its joint and what it needs in the base."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from artgen.articulation.types import Body, DraftPart, Joint, Limit, Precondition
from artgen.generators.kit.cabinet_design import (
    BUMPER,
    OUTWARD,
    Design,
    Front,
    Side,
    door_front,
    drawer_front,
    halves,
    opening_angle,
)
from artgen.generators.kit.cabinet_hinge import AXIS_AHEAD, butt_hinge, cup_hinge, hinge_heights
from artgen.generators.kit.carcass import SHELF, door_stop, shelf_heights, shelf_on_pins
from artgen.generators.kit.drawer import (
    DrawerBox,
    drawer_box,
    fixed_runners,
    longest,
    moving_runners,
    travel,
)
from artgen.generators.kit.front_layout import Cell, Rect

REAR_ROOM = 0.014
"""m; behind a drawer's runners."""
PACKER = 0.038
"""m; what brings inner drawers clear of a door that stands open."""
INNER = 0.17
"""Height of an inner drawer's place, m."""


@dataclass(frozen=True, kw_only=True)
class Works:
    """Parts and joints, with the bodies that they need in the base."""

    parts: tuple[DraftPart, ...] = ()
    joints: tuple[Joint, ...] = ()
    base: tuple[Body, ...] = ()
    preconditions: tuple[Precondition, ...] = ()

    def __add__(self, other: "Works") -> "Works":
        return Works(
            parts=self.parts + other.parts,
            joints=self.joints + other.joints,
            base=self.base + other.base,
            preconditions=self.preconditions + other.preconditions,
        )


FitOut = Callable[[Design, Rect, float], tuple[tuple[Body, ...], tuple[float, ...]]]
"""What stands in the clear room of a cell behind y: its bodies, and heights that hinges avoid."""


def loose_shelves(
    design: Design, room: Rect, front: float
) -> tuple[tuple[Body, ...], tuple[float, ...]]:
    """Shelves on pins, the design's pitch apart."""
    heights = shelf_heights(room, design.shelf_pitch)
    bodies = tuple(
        body
        for z in heights
        for body in shelf_on_pins(
            room, z, front=front, rear=design.case.rear,
            stock=design.stocks["shelf"], metal=design.stocks["steel"],
        )
    )  # fmt: skip
    return bodies, tuple(z + SHELF / 2.0 for z in heights)


def cell_works(design: Design, cell: Cell, number: int, fit_out: FitOut = loose_shelves) -> Works:
    """Everything that belongs to one cell; `number` tells it from the others."""
    kind = cell.leaf.kind
    rect = design.front_rect(cell)
    if kind == "drawer":
        front = drawer_front(design, rect)
        return sliding_drawer(design, cell.opening, front, design.back, f"drawer_{number}")
    if kind == "open":
        return Works(base=fit_out(design, cell.opening, design.case.front + 0.012)[0])
    if kind == "pair":
        return _pair(design, cell, number, fit_out)
    side: Side = "left" if kind == "door_left" else "right"
    free_side = cell.at_left if side == "left" else cell.at_right
    name = f"door_{number}"
    room, inner = cell.opening, Works()
    if cell.leaf.inner and free_side:
        room, inner = _inner_drawers(design, cell, (name,), number)
    fitted, taken = fit_out(design, room, _behind_door(design))
    door = hinged_door(
        design, rect, cell.opening, side, name=name, free_side=free_side, taken=taken
    )
    return door + Works(base=fitted + _stops(design, cell.opening, (_free_x(rect, side),))) + inner


def _pair(design: Design, cell: Cell, number: int, fit_out: FitOut) -> Works:
    rect = design.front_rect(cell)
    left, right = halves(rect, design.gap)
    names = (f"door_{number}a", f"door_{number}b")
    room, inner = cell.opening, Works()
    if cell.leaf.inner and cell.at_left and cell.at_right:
        room, inner = _inner_drawers(design, cell, names, number)
    fitted, taken = fit_out(design, room, _behind_door(design))
    pair: tuple[tuple[Rect, Side, bool, str], ...] = (
        (left, "left", cell.at_left, names[0]),
        (right, "right", cell.at_right, names[1]),
    )
    works = Works(base=fitted)
    for half, side, free_side, name in pair:
        works += hinged_door(
            design, half, cell.opening, side, name=name, free_side=free_side, taken=taken
        )
    middle = rect.middle[0]
    stops = _stops(design, cell.opening, (middle - 0.03, middle + 0.03))
    return works + Works(base=stops) + inner


def _behind_door(design: Design) -> float:
    """y where shelves behind doors begin."""
    return max(design.back, design.case.front) + 0.02


def _free_x(rect: Rect, hinge: Side) -> float:
    return rect.x1 - 0.05 if hinge == "left" else rect.x0 + 0.05


def _stops(design: Design, opening: Rect, xs: tuple[float, ...]) -> tuple[Body, ...]:
    """Doors between the boards need something to close against."""
    if not design.inset:
        return ()
    stock = design.stocks["steel"]
    return tuple(door_stop(opening, x, design.back, play=0.0012, stock=stock) for x in xs)


def sliding_drawer(design: Design, opening: Rect, front: Front, back: float, name: str) -> Works:
    """A drawer whose front is given; its box begins at y = `back`."""
    stocks = design.stocks
    room = design.case.rear - REAR_ROOM - back
    box = DrawerBox(
        opening=opening, front=back, length=longest(room), wall=design.wall, runner=design.runner
    )
    part = DraftPart(
        name=name,
        label="drawer",
        bodies=(
            *front.bodies,
            *drawer_box(box, stocks["box"], stocks["bottom"]),
            *moving_runners(box, stocks["steel"]),
        ),
        grips=front.grips(name),
    )
    joint = Joint(
        name=f"{name}_slide",
        type="prismatic",
        parent="base",
        child=name,
        axis=OUTWARD,
        limit=Limit(lower=0.0, upper=travel(box, design.travel)),
        friction=design.drawer_friction,
        damping=1.5 * design.drawer_friction,
        effort=80.0,
        velocity=1.0,
    )
    return Works(
        parts=(part,), joints=(joint,), base=fixed_runners(box, stocks["steel"], stocks["runner"])
    )


def hinged_door(
    design: Design,
    rect: Rect,
    opening: Rect,
    side: Side,
    *,
    name: str,
    free_side: bool,
    taken: tuple[float, ...],
) -> Works:
    """A door that turns about the outer edge of its face, or about the knuckles before it."""
    sign = 1.0 if side == "left" else -1.0
    edge = rect.x0 if side == "left" else rect.x1
    jamb = opening.x0 if side == "left" else opening.x1
    front = door_front(design, rect, side)
    heights = hinge_heights(rect.z0, rect.z1, taken=taken)
    if design.inset:
        hinges = [
            butt_hinge(jamb=jamb, gap=design.gap, sign=sign, face=design.face, z=z,
                       stock=design.stocks["metal"])
            for z in heights
        ]  # fmt: skip
        origin, ahead = (jamb + sign * design.gap / 2.0, design.face - AXIS_AHEAD, 0.0), AXIS_AHEAD
    else:
        hinges = [
            cup_hinge(edge=edge, jamb=jamb, sign=sign, back=design.back,
                      face=design.back + BUMPER, z=z, stock=design.stocks["steel"])
            for z in heights
        ]  # fmt: skip
        origin, ahead = (edge, design.face, 0.0), 0.0
    angle = opening_angle(design, front, free_side=free_side, ahead=ahead)
    part = DraftPart(
        name=name,
        label="door",
        bodies=(*front.bodies, *(body for hinge in hinges for body in hinge.door)),
        grips=front.grips(name),
    )
    joint = Joint(
        name=f"{name}_hinge",
        type="revolute",
        parent="base",
        child=name,
        axis=(0.0, 0.0, -sign),  # +q brings the free edge to the front, which is -y.
        origin=origin,
        limit=Limit(lower=0.0, upper=angle),
        friction=design.door_friction,
        damping=0.25 * design.door_friction,
        effort=30.0,
        velocity=3.0,
    )
    return Works(
        parts=(part,), joints=(joint,), base=tuple(body for hinge in hinges for body in hinge.base)
    )


def _inner_drawers(
    design: Design, cell: Cell, doors: tuple[str, ...], number: int
) -> tuple[Rect, Works]:
    """Drawers behind doors, on packers; they may leave once the doors stand square.

    Returns:
        The room that is left above them, and the works.
    """
    o, board = cell.opening, design.case.board
    count = min(cell.leaf.inner, int((o.height - 0.1) / INNER))
    top = o.z0 + count * INNER
    back = _behind_door(design) + 0.02 + design.maker.thickness
    works = Works(
        base=(
            design.stocks["shelf"].board(
                (o.x0, _behind_door(design), top), (o.x1, design.case.rear, top + board)
            ),
        )
    )
    for k in range(count):
        z0 = o.z0 + k * INNER
        place = Rect(x0=o.x0 + PACKER, x1=o.x1 - PACKER, z0=z0, z1=z0 + INNER)
        rect = replace(place.shrunk(0.002), z0=z0 + 0.004, z1=z0 + INNER - 0.03)
        x = rect.middle[0]
        front = Front(
            bodies=design.maker.cut_out(rect, back, "top", x),
            holds=((x, back - design.maker.thickness, rect.z1 - 0.03),),
            kind="edge",
        )
        name = f"drawer_{number}_{k + 1}"
        works += sliding_drawer(design, place, front, back, name)
        works += Works(
            base=tuple(
                design.stocks["shelf"].board(
                    (x, back + 0.004, z0 + 0.02), (x + PACKER, design.case.rear, z0 + 0.11)
                )
                for x in (o.x0, o.x1 - PACKER)
            ),
            preconditions=tuple(
                Precondition(
                    joint=f"{name}_slide", requires=f"{door}_hinge", at_least=math.pi / 2.0
                )
                for door in doors
            ),
        )
    return replace(o, z0=top + board), works
