"""Cabinets: sideboards, chests, base units, vanities, nightstands, media units, tall cupboards."""

from collections.abc import Mapping

from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import cabinet_params
from artgen.generators.kit.basin import basin, tap
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_movers import Works, cell_works
from artgen.generators.kit.cabinet_params import CabinetParams, case_of, layout
from artgen.generators.kit.carcass import back_panel, case_boards, inner_boards
from artgen.generators.kit.density import STEEL
from artgen.generators.kit.front_layout import Cell
from artgen.generators.kit.furniture_make import design_of, stocks_of
from artgen.generators.kit.stand import STANDS, Stand

PARAMS = CabinetParams
INVARIANTS = cabinet_params.INVARIANTS


def build(p: CabinetParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """A case with drawers that slide to the front and doors that turn about upright edges."""
    worktop = "worktop" if p.worktop and p.top == "overhang" else None
    design = design_of(p, case_of(p), stocks_of(p.finish, top=worktop))
    cells, separators = layout(p)
    works = Works()
    for number, cell in enumerate(cells, start=1):
        works += cell_works(design, cell, number)
    stocks = design.stocks
    case = (
        *case_boards(design.case, stocks["case"], stocks["top"]),
        *inner_boards(design.case, separators, stocks["case"]),
        back_panel(design.case, stocks["back"], _cable_holes(p, cells)),
        *_stand(p, design),
        *(_basin(p, design) if p.basin and p.kind == "vanity" else ()),
    )
    base = DraftPart(name="base", label="base", bodies=case + works.base)
    parts = (base, *works.parts)
    used = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="cabinet",
        parts=parts,
        joints=works.joints,
        surfaces=tuple(spec for role, spec in surfaces.items() if role in used),
        preconditions=works.preconditions,
    )


def _cable_holes(p: CabinetParams, cells: list[Cell]) -> tuple[tuple[float, float], ...]:
    """Media units let cables through the back of every niche."""
    if p.kind != "media":
        return ()
    niches = [cell.opening for cell in cells if cell.leaf.kind == "open"]
    return tuple((niche.middle[0], niche.z0 + 0.06) for niche in niches)


def _basin(p: CabinetParams, design: Design) -> tuple[Body, ...]:
    """A basin near the front of the top, the tap between it and the wall."""
    width, depth = min(0.55, p.width - 0.16), min(0.36, p.depth - 0.12)
    front, top = -p.depth / 2.0 + 0.03, p.height
    place = (0.0, front + depth / 2.0, top)
    bodies = basin((width, depth, 0.12), place, design.stocks["ceramic"], design.stocks["metal"])
    foot = (0.0, front + depth + 0.045, top)
    return (*bodies, tap(foot, rise=0.25, reach=0.15, metal=design.stocks["metal"]))


def _stand(p: CabinetParams, design: Design) -> tuple[Body, ...]:
    case, stocks = design.case, design.stocks
    if p.stand == "wall":
        rail = (case.opening.x0, case.back - 0.0095, case.opening.z1 - 0.05)
        end = (case.opening.x1, case.back - 0.0065, case.opening.z1 - 0.015)
        return (stocks["steel"].board(rail, end),)
    if p.stand == "panel":
        front, inner = case.front + 0.05, case.opening
        low = (inner.x0, front, 0.0)
        return (stocks["case"].board(low, (inner.x1, front + 0.016, case.outside.z0), grain="x"),)
    stand = Stand(
        width=p.width,
        front=case.front,
        back=case.back,
        height=p.stand_height,
        inset=0.045 if p.stand == "plinth" else p.stand_inset,
        splay=p.leg_splay,
        girth=p.leg_girth,
    )
    wood = stocks["case"] if p.stand == "plinth" else stocks["leg"]
    metal = Stock(surface="metal", density=STEEL, edge=0.0008)
    return STANDS[p.stand](stand, wood, metal)
