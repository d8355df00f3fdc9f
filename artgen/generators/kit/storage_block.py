"""Blocks of storage furniture: one case each, with its cells, and the works inside."""

from collections.abc import Callable
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.carcass import back_panel, case_boards, inner_boards
from artgen.generators.kit.front_layout import Cell, Joinery, Node, Separator, slice_face


@dataclass(frozen=True, kw_only=True)
class Block:
    """A case divided into cells; `first` numbers them."""

    design: Design
    cells: tuple[Cell, ...]
    boards: tuple[Separator, ...]
    first: int


def block(design: Design, node: Node, *, first: int = 1) -> Block:
    """A case with its face divided as the node says."""
    joinery = Joinery(
        board=design.case.board, rail=0.02 if design.inset else 0.0, by_cover=not design.inset
    )
    cells, boards = slice_face(node, design.case.opening, design.case.face, joinery)
    return Block(design=design, cells=tuple(cells), boards=tuple(boards), first=first)


CellMaker = Callable[[Design, Cell, int], Works]


def block_works(
    one: Block, maker: CellMaker, *, floors: Callable[[Separator], Body | None] | None = None
) -> Works:
    """Boards and cells; `floors` may put another board in the place of a separator."""
    design = one.design
    stocks = design.stocks
    works = Works(
        base=(
            *case_boards(design.case, stocks["case"], stocks["top"]),
            back_panel(design.case, stocks["back"], ()),
        )
    )
    for board in one.boards:
        special = floors(board) if floors else None
        bodies = (special,) if special else inner_boards(design.case, [board], stocks["case"])
        works += Works(base=bodies)
    for k, cell in enumerate(one.cells):
        works += maker(design, cell, one.first + k)
    return works
