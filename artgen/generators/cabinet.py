"""Cabinets: sideboards, chests, base units, vanities, nightstands, media units, tall cupboards."""

from collections.abc import Mapping

from artgen.articulation.types import Body, Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import cabinet_params
from artgen.generators.kit.basin import basin, tap
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_movers import Works, cell_works
from artgen.generators.kit.cabinet_params import CabinetParams, case_of, layout
from artgen.generators.kit.carcass import back_panel, case_boards, inner_boards
from artgen.generators.kit.case_stand import Leg, case_stand
from artgen.generators.kit.front_layout import Cell
from artgen.generators.kit.furniture_make import design_of, stocks_of

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
    leg = Leg(height=p.stand_height, inset=p.stand_inset, splay=p.leg_splay, girth=p.leg_girth)
    case = (
        *case_boards(design.case, stocks["case"], stocks["top"]),
        *inner_boards(design.case, separators, stocks["case"]),
        back_panel(design.case, stocks["back"], _cable_holes(p, cells)),
        *case_stand(design.case, stocks, sort=p.stand, leg=leg),
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
