"""Params of a cabinet, the layout that follows from them, and what makes a draw valid."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.generators.kit.cabinet_design import BUMPER
from artgen.generators.kit.cabinet_kinds import KINDS, PATTERNS, Site, columns_of, picked
from artgen.generators.kit.carcass import Case
from artgen.generators.kit.front_layout import (
    Cell,
    Joinery,
    Node,
    Rect,
    Separator,
    Split,
    slice_face,
)
from artgen.generators.kit.furniture_make import MILLED, MOVERS, FurnitureMake, clears_gaps


@dataclass(frozen=True, kw_only=True)
class CabinetParams(FurnitureMake):
    """Lengths in m; factors multiply the kind's usual sizes; tuples hold one draw a column."""

    kind: str
    width_factor: float
    depth_factor: float
    height_factor: float
    columns: int
    column_weight: tuple[float, ...]
    column_pattern: tuple[float, ...]
    rows: tuple[int, ...]
    symmetric: bool
    hinge_left: tuple[bool, ...]
    growth: float
    top_drawer: float
    inner_drawers: int
    most_movers: int
    stand: str
    plinth_height: float
    leg_height: float
    leg_girth: float
    leg_splay: float
    stand_inset: float
    top: str
    top_thickness: float
    overhang: float
    worktop: bool
    basin: bool

    @property
    def width(self) -> float:
        """Of the case."""
        return KINDS[self.kind].width * self.width_factor

    @property
    def depth(self) -> float:
        """From the fronts' faces to the back."""
        return KINDS[self.kind].depth * self.depth_factor

    @property
    def height(self) -> float:
        """From the floor to the top."""
        return KINDS[self.kind].height * self.height_factor

    @property
    def stand_height(self) -> float:
        """Under the case."""
        if self.stand == "wall":
            return 0.0
        return self.plinth_height if self.stand in ("plinth", "panel") else self.leg_height


def case_of(p: CabinetParams) -> Case:
    """The case that the params describe."""
    face = -p.depth / 2.0
    return Case(
        outside=Rect(x0=-p.width / 2.0, x1=p.width / 2.0, z0=p.stand_height, z1=p.height),
        front=face if p.inset else face + p.front_thickness + BUMPER,
        back=p.depth / 2.0,
        board=p.board,
        panel=0.006,
        top_thickness=p.top_thickness if p.top == "overhang" else p.board,
        top=p.top,
        overhang=p.overhang,
        overhang_from=face,
        foot=0.0 if p.stand == "panel" else p.stand_height,
    )


def layout(p: CabinetParams) -> tuple[list[Cell], list[Separator]]:
    """The divided face."""
    case = case_of(p)
    joinery = Joinery(board=p.board, rail=0.02 if p.inset else 0.0, by_cover=not p.inset)
    return slice_face(_tree(p, case), case.opening, case.face, joinery)


def _tree(p: CabinetParams, case: Case) -> Node:
    """Columns side by side, each divided by the pattern that was drawn for it."""
    kind = KINDS[p.kind]
    count = columns_of(kind, p.columns, p.width)
    drawn = [min(k, count - 1 - k) if p.symmetric else k for k in range(count)]
    weights = tuple(p.column_weight[k] for k in drawn)
    nodes = []
    for column, k in enumerate(drawn):
        outer_left, outer_right = column == 0, column == count - 1
        site = Site(
            width=case.opening.width * weights[column] / sum(weights),
            height=case.opening.height,
            hinge_left=p.hinge_left[k] if outer_left == outer_right else outer_left,
            rows=p.rows[k],
            growth=p.growth,
            top_drawer=p.top_drawer,
            inner=p.inner_drawers,
        )
        nodes.append(PATTERNS[picked(kind.patterns, p.column_pattern[k])](site))
    return nodes[0] if count == 1 else Split(axis="x", weights=weights, nodes=tuple(nodes))


def movers(p: CabinetParams) -> int:
    """How many drawers and doors there are, inner drawers counted in full."""
    return sum(MOVERS[cell.leaf.kind] + cell.leaf.inner for cell in layout(p)[0])


def fronts_are_usable(p: CabinetParams) -> bool:
    """Drawers hold something, doors are neither slits nor barn doors, niches take a hand."""
    for cell in layout(p)[0]:
        o = cell.opening
        kind = cell.leaf.kind
        if kind == "drawer" and not (0.095 <= o.height <= 0.37 and 0.2 <= o.width <= 1.1):
            return False
        wide = o.width / 2.0 if kind == "pair" else o.width
        if kind not in ("drawer", "open") and not (0.21 <= wide <= 0.62 and o.height >= 0.18):
            return False
        if kind == "open" and min(o.height, o.width) < 0.12:
            return False
    return True


def doors_clear_their_gap(p: CabinetParams) -> bool:
    """The free edges of all doors pass what lies beside them."""
    return clears_gaps(p, layout(p)[0])


INVARIANTS: Mapping[str, Callable[[CabinetParams], bool]] = {
    "stand_suits_kind": lambda p: p.stand in KINDS[p.kind].stands,
    "milled_grips_need_plain_fronts": lambda p: p.grip not in MILLED or p.style == "slab",
    "few_moving_parts": lambda p: KINDS[p.kind].fewest <= movers(p) <= p.most_movers,
    "fronts_are_usable": fronts_are_usable,
    "doors_clear_their_gap": doors_clear_their_gap,
}
