"""Desks: a top on one or two pedestals, with a keyboard tray or a pencil drawer over the knees."""

from collections.abc import Mapping
from dataclasses import replace

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_design import Design, drawer_front
from artgen.generators.kit.cabinet_movers import REAR_ROOM, Works, cell_works, sliding_drawer
from artgen.generators.kit.case_stand import case_stand
from artgen.generators.kit.density import STEEL
from artgen.generators.kit.drawer import DrawerBox, fixed_runners, longest, moving_runners
from artgen.generators.kit.front_layout import Leaf, Node, Rect, Split
from artgen.generators.kit.stand import TUBE_FILL
from artgen.generators.kit.storage_block import Block, block, block_works
from artgen.generators.kit.storage_params import StorageParams, case_of, design
from artgen.geometry.solid import cylinder, slab, tube, union

OVERHANG = 0.018
"""How far the top stands out before the fronts, m."""
HANGER = 0.018
"""Thickness of the boards that carry what slides under the top, m."""
TRAY, PENCILS = 0.085, 0.098
"""Height of the room of a keyboard tray and of a pencil drawer, m."""


def under(p: StorageParams) -> float:
    """z of the top's underside."""
    return p.height - p.top_thickness


def desk_blocks(p: StorageParams) -> tuple[Block, ...]:
    """One or two pedestals, each a column of drawers or a drawer over a door."""
    blocks: list[Block] = []
    for side in ("left", "right"):
        if p.pedestals not in (side, "both"):
            continue
        x0 = -p.width / 2.0 if side == "left" else p.width / 2.0 - p.pedestal_width
        outside = Rect(x0=x0, x1=x0 + p.pedestal_width, z0=p.plinth_height, z1=under(p))
        case = case_of(p, outside, top="between", foot=0.0, depth=p.depth - OVERHANG)
        with_door = p.niche and side == "right"
        node = _column(p, with_door, case.opening.height, hinge_left=side == "left")
        first = 1 + sum(len(one.cells) for one in blocks)
        blocks.append(block(design(p, case), node, first=first))
    return tuple(blocks)


def _column(p: StorageParams, with_door: bool, height: float, *, hinge_left: bool) -> Node:
    drawer = Leaf(kind="drawer")
    if with_door:
        leaf = Leaf(kind="door_left" if hinge_left else "door_right")
        return Split(axis="z", weights=(height - 0.15, 0.15), nodes=(leaf, drawer))
    rows = max(2, min(4, p.rows))
    weights = tuple(p.growth ** (rows - 1 - k) for k in range(rows))
    return Split(axis="z", weights=weights, nodes=(drawer,) * rows)


def knees(p: StorageParams) -> Rect:
    """The room for the knees, in the x, z plane."""
    x0, x1 = -p.width / 2.0, p.width / 2.0
    x0 += p.pedestal_width if p.pedestals in ("left", "both") else 0.03
    x1 -= p.pedestal_width if p.pedestals in ("right", "both") else 0.03
    return Rect(x0=x0, x1=x1, z0=0.0, z1=under(p))


def desk_works(p: StorageParams, blocks: tuple[Block, ...]) -> Works:
    """Pedestals, top, the other end, a modesty panel, and what slides under the top."""
    works = Works()
    for one in blocks:
        stand = case_stand(one.design.case, one.design.stocks, sort="panel", leg=p.leg)
        works += block_works(one, cell_works) + Works(base=stand)
    first = blocks[0].design
    room = knees(p)
    back = slab(
        (room.x0, p.depth / 2.0 - 0.06, under(p) - 0.38), (room.x1, p.depth / 2.0 - 0.044, under(p))
    )
    base: list[Body] = [*_top(p, first), *_other_end(p, first.stocks)]
    base.append(first.stocks["case"].piece(back, contact=(back,), grain="x"))
    slides = {"tray": _keyboard_tray, "drawer": _pencil_drawer}.get(p.under_top)
    return works + Works(base=tuple(base)) + (slides(p, first) if slides else Works())


def _top(p: StorageParams, first: Design) -> list[Body]:
    """The top, with two cable outlets near its rear."""
    x, y = p.width / 2.0, p.depth / 2.0
    over = p.overhang if p.desk_end == "panel" else 0.0
    plain = slab((-x - over, -y, under(p)), (x + over, y, p.height))
    outlets = [(sx * (x - 0.2), y - 0.085) for sx in (-1.0, 1.0)]
    holes = union(cylinder(0.03, 0.2, segments=28).at(u, v, under(p) - 0.1) for u, v in outlets)
    stock, plastic = first.stocks["top"], Stock(surface="plastic", density=1050.0, edge=0.0)
    bodies = [stock.piece(plain - holes, contact=(plain,), grain="x")]
    for u, v in outlets:
        ring = tube(0.034, 0.024, 0.0025, segments=28).at(u, v, p.height)
        sleeve = tube(0.03, 0.027, p.top_thickness, segments=28).at(u, v, under(p))
        lid = cylinder(0.0245, 0.002, segments=28).at(u, v, p.height - 0.001)
        slot = slab((u - 0.009, v, p.height - 1.0), (u + 0.009, v + 0.04, p.height + 1.0))
        bodies.append(plastic.piece(union([ring, sleeve, lid - slot])))
    return bodies


def _other_end(p: StorageParams, stocks: Mapping[str, Stock]) -> list[Body]:
    """What carries the top where there is no pedestal."""
    if p.pedestals == "both":
        return []
    x = -p.width / 2.0 if p.pedestals == "right" else p.width / 2.0
    sign = 1.0 if x < 0.0 else -1.0
    if p.desk_end == "panel":
        x0, x1 = sorted((x, x + sign * 0.025))
        low, high = (x0, -p.depth / 2.0 + 0.03, 0.0), (x1, p.depth / 2.0 - 0.02, under(p))
        return [stocks["case"].board(low, high, grain="z")]
    t = 0.028
    x0, x1 = sorted((x + sign * 0.002, x + sign * (0.002 + t)))
    y0, y1 = -p.depth / 2.0 + 0.03, p.depth / 2.0 - 0.02
    bars = [
        slab((x0, y0, 0.0), (x1, y1, t)),
        slab((x0, y0, under(p) - t), (x1, y1, under(p))),
        slab((x0, y0, t), (x1, y0 + t, under(p) - t)),
        slab((x0, y1 - t, t), (x1, y1, under(p) - t)),
    ]
    hollow = Stock(surface="metal", density=TUBE_FILL * STEEL, edge=0.001)
    return [hollow.piece(union(bars), contact=tuple(bars))]


def _slide_room(p: StorageParams, height: float, widest: float) -> Rect:
    room = knees(p)
    half = min(widest, room.width - 0.05) / 2.0
    middle = room.middle[0]
    return Rect(x0=middle - half, x1=middle + half, z0=under(p) - height, z1=under(p))


def _hangers(first: Design, room: Rect, front: float) -> tuple[Body, ...]:
    """Boards under the top at both sides of a room."""
    stock = first.stocks["case"]
    return tuple(
        stock.board((x, front, room.z0), (x + HANGER, first.case.rear - 0.06, room.z1), grain="y")
        for x in (room.x0 - HANGER, room.x1)
    )


def _keyboard_tray(p: StorageParams, first: Design) -> Works:
    """A board with a raised front edge on ball-bearing slides."""
    room, front = _slide_room(p, TRAY, 0.72), -p.depth / 2.0 + 0.05
    box = DrawerBox(
        opening=room,
        front=front,
        length=min(0.35, longest(first.case.rear - 0.06 - REAR_ROOM - front)),
        wall=0.016,
        runner="metal",
    )
    (low, _), o = box.rail, box.outside
    stocks = first.stocks
    board = stocks["case"].board(
        (o.x0, front, low), (o.x1, front + box.length - 0.004, low + 0.018), grain="x"
    )
    edge = stocks["case"].board(
        (o.x0, front - 0.02, low - 0.006), (o.x1, front, low + 0.026), grain="x"
    )
    middle = (o.middle[0], front - 0.02, low + 0.006)
    grip = Grip(
        name="keyboard_tray_edge",
        kind="edge",
        position=middle,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )
    tray = DraftPart(
        name="keyboard_tray",
        label="tray",
        bodies=(board, edge, *moving_runners(box, stocks["steel"])),
        grips=(grip,),
    )
    joint = Joint(
        name="keyboard_tray_slide",
        type="prismatic",
        parent="base",
        child="keyboard_tray",
        axis=(0.0, -1.0, 0.0),
        limit=Limit(lower=0.0, upper=0.75 * box.length),
        friction=0.7 * p.drawer_friction,
        damping=p.drawer_friction,
        effort=60.0,
        velocity=1.0,
    )
    runners = fixed_runners(box, stocks["steel"], stocks["runner"])
    hung = _hangers(first, room, front + 0.002)
    return Works(parts=(tray,), joints=(joint,), base=(*runners, *hung))


def _pencil_drawer(p: StorageParams, first: Design) -> Works:
    """A flat drawer between two boards under the top."""
    room = _slide_room(p, PENCILS, 0.62)
    rect = Rect(
        x0=room.x0 - HANGER + 0.002,
        x1=room.x1 + HANGER - 0.002,
        z0=room.z0 + 0.001,
        z1=room.z1 - 0.0025,
    )
    shallow = replace(first, case=replace(first.case, back=first.case.back - 0.06))
    front = drawer_front(replace(shallow, style="slab"), rect)
    works = sliding_drawer(shallow, room, front, shallow.back, "pencil_drawer")
    return works + Works(base=_hangers(first, room, first.case.front))
