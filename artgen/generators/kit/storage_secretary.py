"""Secretaries: drawers below, a fall flap to write on, pigeonholes with small drawers behind it."""

import math
from dataclasses import replace

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Precondition
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_movers import Works, cell_works
from artgen.generators.kit.case_stand import case_stand
from artgen.generators.kit.fall_flap import ROOM, FallFlap, fall_flap, flap_floor
from artgen.generators.kit.front_layout import Cell, Leaf, Node, Rect, Separator, Split
from artgen.generators.kit.handle import Handle
from artgen.generators.kit.storage_block import Block, block, block_works
from artgen.generators.kit.storage_params import StorageParams, design, whole_case
from artgen.geometry.solid import Solid, revolve

WRITING, FLAP = 0.73, 0.40
"""Height of the writing surface over the floor, and of the flap, m."""
THIN = 0.009
"""Boards of the pigeonholes, m."""
PASSING = 0.0015
"""m; between the open flap and the drawer under it."""
SMALL = 0.070
"""Height of the small drawers' row, m."""


def secretary_blocks(p: StorageParams) -> tuple[Block, ...]:
    """Drawers, the flap, and a niche above where the height allows one."""
    case = whole_case(p, top="overhang")
    o = case.opening
    rows = max(2, min(3, p.rows))
    low = WRITING - o.z0
    rest = o.z1 - WRITING
    drawers = Split(
        axis="z",
        weights=tuple(p.growth ** (rows - 1 - k) for k in range(rows)),
        nodes=(Leaf(kind="drawer"),) * rows,
    )
    nodes: list[Node] = [drawers, Leaf(kind="flap")]
    weights = [low, rest]
    if rest > FLAP + 0.15:
        nodes.append(Leaf(kind="open"))
        weights = [low, FLAP, rest - FLAP]
    node = Split(axis="z", weights=tuple(weights), nodes=tuple(nodes))
    return (block(design(p, case), node),)


def flap_of(p: StorageParams, one: Design, opening: Rect) -> FallFlap:
    """The flap that closes an opening."""
    return FallFlap(
        opening=opening,
        front=one.case.front,
        thickness=min(p.front_thickness, p.board + p.gap - PASSING),
        gap=p.gap,
        arm=p.flap_arm,
        friction=p.flap_friction,
        grip=Handle(style="knob", length=0.096, radius=p.handle_radius, standoff=p.standoff),
        wood=replace(one.stocks["front"], edge=0.0012),
        leather=one.stocks["leather"] if p.leather else None,
        metal=one.stocks["metal"],
    )


def secretary_works(p: StorageParams, blocks: tuple[Block, ...]) -> Works:
    """The case on its legs; the flap's floor is notched for its hinges."""
    one = blocks[0]
    cell = next(cell for cell in one.cells if cell.leaf.kind == "flap")
    flap = flap_of(p, one.design, cell.opening)

    def floors(board: Separator) -> Body | None:
        if abs(board.place.z1 - cell.opening.z0) > 1e-6:
            return None
        return flap_floor(flap, board.place, one.design.case.rear, one.design.stocks["case"])

    def maker(design: Design, cell: Cell, number: int) -> Works:
        if cell.leaf.kind != "flap":
            return cell_works(design, cell, number)
        return fall_flap(flap, "flap") + _pigeonholes(p, design, flap)

    stand = case_stand(one.design.case, one.design.stocks, sort=p.stand, leg=p.leg)
    return block_works(one, maker, floors=floors) + Works(base=stand)


def _pigeonholes(p: StorageParams, design: Design, flap: FallFlap) -> Works:
    """A low row of small drawers under open pigeonholes, clear of the stays."""
    o, stock = flap.opening, replace(design.stocks["shelf"], edge=0.0005)
    front, rear = flap.hinge[0] + 0.045, design.case.rear
    x0, x1 = o.x0 + ROOM + 0.002, o.x1 - ROOM - 0.002
    low, high = o.z0 + SMALL, o.z0 + min(0.30, 0.72 * (o.z1 - o.z0))
    count = p.pigeonholes
    step = (x1 - x0 - THIN) / count
    levels = [
        stock.board((x0, front, z), (x1, rear, z + THIN), grain="x") for z in (o.z0, low, high)
    ]
    uprights = [
        stock.board((x0 + k * step, front, z0), (x0 + k * step + THIN, rear, z1), grain="z")
        for k in range(count + 1)
        for z0, z1 in ((o.z0 + THIN, low), (low + THIN, high))
        if z0 > low or k in (0, 1, count - 1, count)
    ]
    works = Works(base=(*levels, *uprights))
    for name, k in (("small_drawer_left", 0), ("small_drawer_right", count - 1)):
        left = x0 + k * step + THIN
        place = Rect(
            x0=left + 0.0015, x1=left + step - THIN - 0.0015, z0=o.z0 + THIN + 0.001, z1=low
        )
        works += _small_drawer(p, design, replace(place, z1=low - 0.0015), front, name)
    return works


def _small_knob() -> Solid:
    """A turned button on a short neck, on the face y = 0."""
    outline = [(0.0, 0.0), (0.003, 0.0), (0.003, 0.008), (0.0068, 0.0105), (0.0068, 0.0135),
               (0.0045, 0.0155), (0.0, 0.0155)]  # fmt: skip
    return revolve(outline, axis="y", segments=12).mirrored("y")


def _small_drawer(p: StorageParams, design: Design, place: Rect, front: float, name: str) -> Works:
    """A little box with a knob that slides on the floor; the flap must lie open before it."""
    length, t = min(0.22, design.case.rear - front - 0.01), 0.006
    stocks = design.stocks
    box, face = replace(stocks["box"], edge=0.0), replace(stocks["front"], edge=0.0006)
    back, height = front + length, place.z0 + 0.78 * place.height
    x, z = place.middle
    sides = [
        box.board((u, front + 0.01, place.z0), (u + t, back, height))
        for u in (place.x0, place.x1 - t)
    ]
    inner = (place.x0 + t, place.x1 - t)
    rest = [
        box.board((inner[0], back - t, place.z0), (inner[1], back, height)),
        box.board((inner[0], front + 0.01, place.z0), (inner[1], back - t, place.z0 + 0.004)),
    ]
    knob = _small_knob().at(x, front, z)
    front_board = face.board((place.x0, front, place.z0), (place.x1, front + 0.01, place.z1))
    outward = (0.0, -1.0, 0.0)
    part = DraftPart(
        name=name,
        label="drawer",
        bodies=(front_board, *sides, *rest, stocks["metal"].piece(knob)),
        grips=(
            Grip(
                name=f"{name}_knob",
                kind="knob",
                position=(x, front - 0.014, z),
                outward=outward,
                pull=outward,
            ),
        ),
    )
    joint = Joint(
        name=f"{name}_slide",
        type="prismatic",
        parent="base",
        child=name,
        axis=outward,
        limit=Limit(lower=0.0, upper=round(0.6 * length, 3)),
        friction=5.0,
        damping=6.0,
        effort=30.0,
        velocity=1.0,
    )
    opened = Precondition(joint=joint.name, requires="flap_hinge", at_least=math.pi / 2.0 - 0.02)
    return Works(parts=(part,), joints=(joint,), preconditions=(opened,))
