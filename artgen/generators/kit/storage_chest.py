"""Dressers with a mirror, sideboards with sliding doors, hutches and bookcases with glass doors."""

from dataclasses import replace

from artgen.articulation.types import Body
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_kinds import Site, door, stack
from artgen.generators.kit.cabinet_movers import Works, cell_works
from artgen.generators.kit.carcass import Case
from artgen.generators.kit.front_layout import Leaf, Node, Rect, Split
from artgen.generators.kit.furniture_make import MILLED
from artgen.generators.kit.furniture_mirror import POST, Mirror, fixed_mirror, swinging_mirror
from artgen.generators.kit.storage_block import Block, block, block_works
from artgen.generators.kit.storage_params import StorageParams, case_of, design, whole_case
from artgen.generators.kit.storage_wardrobe import storage_works

DRAWER = Leaf(kind="drawer")


def dresser_blocks(p: StorageParams) -> tuple[Block, ...]:
    """Columns of drawers, the middle one of three a door by choice."""
    case = whole_case(p, top="overhang")
    count = max(1, min(3, p.columns, int(p.width / 0.34)))
    return (block(design(p, case), _columns(p, case, count)),)


def _columns(p: StorageParams, case: Case, count: int) -> Node:
    weights = tuple(p.column_weight[min(k, count - 1 - k)] for k in range(count))
    nodes: list[Node] = []
    for k in range(count):
        width = case.opening.width * weights[k] / sum(weights)
        site = _site(p, width, case.opening.height, hinge_left=k == 0)
        if count == 3 and k == 1 and p.niche:
            nodes.append(door(site))
        else:
            nodes.append(stack(site, p.rows if count < 3 else min(p.rows, 3), site.height))
    return nodes[0] if count == 1 else Split(axis="x", weights=weights, nodes=tuple(nodes))


def _site(p: StorageParams, width: float, height: float, *, hinge_left: bool) -> Site:
    return Site(
        width=width,
        height=height,
        hinge_left=hinge_left,
        rows=p.rows,
        growth=p.growth,
        top_drawer=0.15,
        inner=0,
    )


def dresser_works(p: StorageParams, blocks: tuple[Block, ...]) -> Works:
    """The chest with its mirror."""
    works = storage_works(p, blocks[0])
    if p.mirror == "none":
        return works
    stocks = blocks[0].design.stocks
    glass = Mirror(
        shape=p.mirror_shape,
        width=min(0.74 * p.width, 0.95 * p.mirror_height if p.mirror_shape == "arch" else 1.1),
        height=p.mirror_height,
        border=p.mirror_border,
        y=p.depth / 2.0 - 0.075 if p.mirror == "swing" else p.depth / 2.0 - 0.0126,
        z=p.height,
        wood=replace(stocks["front"], edge=0.002),
        glass=stocks["mirror"],
        metal=stocks["metal"],
    )
    if p.mirror == "swing":
        room = p.width - 2.0 * POST - 0.02
        return works + swinging_mirror(replace(glass, width=min(glass.width, room)))
    return works + Works(base=fixed_mirror(glass))


def sideboard_blocks(p: StorageParams) -> tuple[Block, ...]:
    """Sliding doors, a row of drawers above them by choice."""
    case = whole_case(p, top="overhang")
    leaf: Node = Leaf(kind="sliding")
    if p.base_drawers and case.opening.height > 0.5:
        count = 3 if p.width > 1.7 else 2
        row = Split(axis="x", weights=(1.0,) * count, nodes=(DRAWER,) * count)
        share = 0.15 / case.opening.height
        leaf = Split(axis="z", weights=(1.0 - share, share), nodes=(leaf, row))
    return (block(design(p, case), leaf),)


def sideboard_works(p: StorageParams, blocks: tuple[Block, ...]) -> Works:
    """The piece on its legs."""
    return storage_works(p, blocks[0])


def display_blocks(p: StorageParams) -> tuple[Block, ...]:
    """A closed lower case, and an upper one with glass doors; the upper one of a hutch is less deep
    and may stand clear of the worktop on its sides."""
    hutch = p.kind == "hutch"
    table = p.stand_height + (p.height - p.stand_height) * (
        p.upper_share if hutch else 0.8 * p.upper_share
    )
    low = whole_case(p, top="overhang" if hutch else "cap", high=table)
    below = design(p, low)
    count = max(1, min(3 if hutch else 2, p.columns, round(p.width / 0.42)))
    width = p.width / count
    nodes = tuple(_lower(p, low, width, k) for k in range(count))
    node = nodes[0] if count == 1 else Split(axis="x", weights=(1.0,) * count, nodes=nodes)
    lower = block(below, node)
    return lower, _upper(p, below, table, count, first=1 + len(lower.cells))


def _lower(p: StorageParams, case: Case, width: float, k: int) -> Node:
    site = _site(p, width - p.board, case.opening.height, hinge_left=k == 0)
    if p.kind == "hutch" and p.base_drawers and site.height > 0.45:
        share = 0.15 / site.height
        return Split(axis="z", weights=(1.0 - share, share), nodes=(door(site), DRAWER))
    return door(site)


def _upper(p: StorageParams, below: Design, table: float, count: int, *, first: int) -> Block:
    hutch = p.kind == "hutch"
    raised = p.upper_gap if hutch and p.niche else 0.0
    side = p.width / 2.0 - (0.004 if hutch else 0.0)
    outside = Rect(x0=-side, x1=side, z0=table + raised, z1=p.height)
    depth = 0.72 * p.depth if hutch else p.depth
    case = case_of(p, outside, top="overhang" if hutch else "cap", foot=table, depth=depth)
    glass = replace(
        design(p, case),
        style="glass",
        grip="knob" if p.grip in MILLED else p.grip,
        handle=replace(below.handle, style="knob") if p.grip in MILLED else below.handle,
    )
    site = _site(p, p.width / count - p.board, case.opening.height, hinge_left=True)
    leaves = [door(replace(site, hinge_left=k == 0)) for k in range(count)]
    node: Node = leaves[0]
    if count > 1:
        node = Split(axis="x", weights=(1.0,) * count, nodes=tuple(leaves))
    return block(glass, node, first=first)


def display_works(p: StorageParams, blocks: tuple[Block, ...]) -> Works:
    """Both cases, with a cornice, and a back behind the gap where there is one."""
    lower, upper = blocks
    works = storage_works(p, lower) + block_works(upper, cell_works)
    return works + Works(base=(*_gap_back(lower, upper), *_cornice(p, upper.design)))


def _gap_back(lower: Block, upper: Block) -> tuple[Body, ...]:
    table, case = lower.design.case.outside.z1, upper.design.case
    if case.outside.z0 - table < 0.01:
        return ()
    o, y = case.opening, case.rear
    stock = upper.design.stocks["back"]
    return (stock.board((o.x0, y, table), (o.x1, y + case.panel, case.outside.z0), grain="z"),)


def _cornice(p: StorageParams, upper: Design) -> tuple[Body, ...]:
    """Two stepped boards that crown a hutch."""
    if p.kind != "hutch":
        return ()
    case, stock = upper.case, upper.stocks["top"]
    o, front = case.outside, case.overhang_from - case.overhang
    return tuple(
        stock.board(
            (o.x0 - case.overhang - out, front - out, o.z1 + low),
            (o.x1 + case.overhang + out, case.back, o.z1 + low + 0.016),
            grain="x",
        )
        for out, low in ((0.010, 0.0), (0.022, 0.016))
    )
