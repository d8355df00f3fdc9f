"""Wardrobes, and cells whose doors slide: what stands behind the doors, and how bays follow."""

import math
from dataclasses import replace

from artgen.articulation.types import Body
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_movers import FitOut, Works, cell_works, loose_shelves
from artgen.generators.kit.carcass import SHELF
from artgen.generators.kit.case_stand import case_stand
from artgen.generators.kit.clothes_rail import clothes_rail, hanger, hat_shelf
from artgen.generators.kit.front_layout import Cell, Leaf, Node, Rect, Split
from artgen.generators.kit.sliding_door import (
    OVERLAP,
    PLAY,
    Fill,
    SlidingDoor,
    SlidingSet,
    even_doors,
    sliding_works,
)
from artgen.generators.kit.storage_block import Block, block, block_works
from artgen.generators.kit.storage_params import StorageParams, design, whole_case

HAT_ROOM = 0.27
"""Above the shelf over a clothes rail, m."""
LONG, SHORT = 1.25, 0.95
"""Rooms at least so high take a rail with a shelf, or a rail alone, m."""


def wardrobe_blocks(p: StorageParams) -> tuple[Block, ...]:
    """One tall case in bays of one or two doors."""
    case = whole_case(p, top="cap" if p.framed else "between")
    doors = max(2, min(4, round(p.width / 0.46)))
    single = Leaf(kind="door_left", inner=p.inner_drawers)
    pair = Leaf(kind="pair", inner=p.inner_drawers)
    if doors == 2:
        apart = p.columns > 1 and p.width > 0.95
        leaves = [single, Leaf(kind="door_right")] if apart else [pair]
    elif doors == 3:
        leaves = [single, pair] if p.hinge_left else [pair, Leaf(kind="door_right")]
    else:
        leaves = [pair, pair]
    if p.base_drawers:
        leaves = [replace(leaf, inner=0) for leaf in leaves]
    shares = tuple(2.0 if leaf.kind == "pair" else 1.0 for leaf in leaves)
    nodes = tuple(_bay(leaf, p, case.opening.height) for leaf in leaves)
    node = nodes[0] if len(nodes) == 1 else Split(axis="x", weights=shares, nodes=nodes)
    return (block(design(p, case), node),)


def _bay(leaf: Leaf, p: StorageParams, height: float) -> Node:
    """A door, with drawers below it where there are any."""
    if not p.base_drawers:
        return leaf
    low = 0.21 * p.base_drawers / height
    weights = (*(low / p.base_drawers,) * p.base_drawers, 1.0 - low)
    drawers = (Leaf(kind="drawer"),) * p.base_drawers
    return Split(axis="z", weights=weights, nodes=(*drawers, leaf))


def sliding_blocks(p: StorageParams) -> tuple[Block, ...]:
    """One tall case closed by sliding doors."""
    case = whole_case(p, top="cap")
    return (block(design(p, case), Leaf(kind="sliding")),)


def wardrobe_works(p: StorageParams, blocks: tuple[Block, ...]) -> Works:
    """Case, doors, what is inside, and what it stands on."""
    return storage_works(p, blocks[0])


def storage_works(p: StorageParams, one: Block) -> Works:
    """A block on its stand, its cells fitted out as the kind asks for."""

    def maker(design: Design, cell: Cell, number: int) -> Works:
        if cell.leaf.kind == "sliding":
            return sliding_cell(p, design, cell.opening, number)
        return cell_works(design, cell, number, fitting_out(p, number))

    stand = case_stand(one.design.case, one.design.stocks, sort=p.stand, leg=p.leg)
    return block_works(one, maker) + Works(base=stand)


def fitting_out(p: StorageParams, number: int) -> FitOut:
    """A rail where a bay is high and wide enough and the draw says so; else shelves."""
    if p.fit_out[number % len(p.fit_out)] == "shelves":
        return loose_shelves

    def hung(
        design: Design, room: Rect, front: float
    ) -> tuple[tuple[Body, ...], tuple[float, ...]]:
        if room.height < SHORT or room.width < 0.4 or design.case.rear - front < 0.43:
            return loose_shelves(design, room, front)
        return _hanging(p, design, room, front, number)

    return hung


def _hanging(
    p: StorageParams, design: Design, room: Rect, front: float, number: int
) -> tuple[tuple[Body, ...], tuple[float, ...]]:
    """Hat shelf, rail and hangers; a shelf below where the draw halves the bay."""
    stocks, rear = design.stocks, design.case.rear
    bodies: list[Body] = []
    taken: list[float] = []
    top = room.z1
    if room.height > LONG:
        top = room.z1 - HAT_ROOM
        bodies.append(hat_shelf(room, top, front=front, rear=rear, stock=stocks["shelf"]))
        taken.append(top + SHELF / 2.0)
    if p.fit_out[number % len(p.fit_out)] == "half" and top - room.z0 > 1.5:
        low = replace(room, z1=top - 1.05)
        bodies.append(hat_shelf(room, low.z1, front=front, rear=rear, stock=stocks["shelf"]))
        more, heights = loose_shelves(design, low, front)
        bodies += more
        taken += [low.z1 + SHELF / 2.0, *heights]
    y, z = (front + rear) / 2.0, top - 0.06
    bodies += clothes_rail(room, y, z, stocks["steel"])
    count = min(p.hangers, int((room.width - 0.1) / 0.07))
    for k in range(count):
        x = room.x0 + 0.07 + 0.055 * k + 0.02 * math.sin(2.3 * k + number)
        lean = 0.10 * math.sin(1.7 * k + number)
        bodies += hanger(x, y, z - 0.0022, lean=lean, wood=stocks["hanger"], steel=stocks["steel"])
    return tuple(bodies), tuple(taken)


def sliding_cell(p: StorageParams, design: Design, opening: Rect, number: int) -> Works:
    """Sliding doors over bays with dividers between them."""
    doors = _doors(p, design, opening)
    works = sliding_works(doors, number)
    count = 3 if p.niche or len(doors.doors) == 3 else 2
    front, rear, t = doors.front + doors.depth + 0.005, design.case.rear, design.case.board
    lines = [opening.x0 + k * opening.width / count for k in range(1, count)]
    for x in lines:
        divider = design.stocks["case"].board(
            (x - t / 2.0, front, opening.z0), (x + t / 2.0, rear, opening.z1), grain="z"
        )
        works += Works(base=(divider,))
    ends = [opening.x0, *(x + t / 2.0 for x in lines)]
    for k, (x0, x1) in enumerate(
        zip(ends, [*(x - t / 2.0 for x in lines), opening.x1], strict=True)
    ):
        room = replace(opening, x0=x0, x1=x1)
        works += Works(base=fitting_out(p, number + k)(design, room, front + 0.01)[0])
    return works


def _doors(p: StorageParams, design: Design, opening: Rect) -> SlidingSet:
    three = p.columns > 2 and opening.width > 1.75 and not p.niche
    tracks = 3 if three else 2
    framed = p.framed and p.kind == "sliding_wardrobe"
    if p.niche:
        doors = _beside_niche(p, opening, framed)
    else:
        fills = tuple(_fills(p, k) for k in range(tracks))
        doors = even_doors(opening, fills, tracks=tracks, mirrored=p.mirrored, framed=framed)
    return SlidingSet(
        opening=opening,
        front=design.case.front,
        tracks=tracks,
        thickness=p.front_thickness,
        profile=p.profile,
        friction=p.slide_friction,
        doors=doors,
        stocks=dict(design.stocks),
        maker=design.maker,
        style=design.style if design.style in ("grooved", "fluted") else "slab",
    )


def _beside_niche(p: StorageParams, opening: Rect, framed: bool) -> tuple[SlidingDoor, ...]:
    """Two doors at the ends that slide over the open middle."""
    width = opening.width / 3.0 + OVERLAP / 2.0
    left, right = opening.x0 + PLAY, opening.x1 - PLAY - width
    return tuple(
        SlidingDoor(
            x0=x,
            x1=x + width,
            track=k if p.mirrored else 1 - k,
            way=1.0 - 2.0 * k,
            travel=width - OVERLAP,
            fills=_fills(p, k),
            framed=framed,
        )
        for k, x in enumerate((left, right))
    )


def _fills(p: StorageParams, k: int) -> tuple[Fill, ...]:
    """Fields of door `k` from bottom to top."""
    if p.door_fill == "mirror" or (p.door_fill == "mixed" and k % 2 == 0):
        return ("mirror",)
    if p.door_fill == "banded" and p.fields > 2:
        return tuple("mirror" if 0 < j < p.fields - 1 else "panel" for j in range(p.fields))
    return tuple("panel" for _ in range(p.fields))
