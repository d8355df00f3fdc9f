"""How furniture is made, whatever it is: fronts, grips, runners, finishes and their stock."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.articulation.types import Axis
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_design import Design
from artgen.generators.kit.cabinet_hinge import AXIS_AHEAD
from artgen.generators.kit.carcass import Case
from artgen.generators.kit.density import GLASS, MDF, OAK, PARTICLEBOARD, PLYWOOD, STEEL, ZINC
from artgen.generators.kit.front_layout import Cell, Kind
from artgen.generators.kit.front_panel import FrontMaker, Style
from artgen.generators.kit.handle import Handle

FINISHES: Mapping[str, tuple[str, str]] = {
    "wood": ("wood", "wood"),
    "paint": ("paint", "paint"),
    "wood_and_paint": ("wood", "paint"),
    "paint_and_wood": ("paint", "wood"),
    "white_and_wood": ("melamine", "wood"),
    "white_and_paint": ("melamine", "paint"),
}
"""Surfaces of the case and of the fronts."""
MILLED = ("milled", "cut_out")
"""Grips that are part of a plain front."""
MOVERS: Mapping[Kind, int] = {
    "drawer": 1,
    "door_left": 1,
    "door_right": 1,
    "pair": 2,
    "open": 0,
    "sliding": 2,
    "flap": 3,
}
"""Moving parts of a cell, inner drawers aside; a flap has two stays."""
CERAMIC = 2300.0
"""Vitreous china, kg/m3."""


@dataclass(frozen=True, kw_only=True)
class FurnitureMake:
    """What rules of furniture draw alike; lengths in m, frictions in N and N m."""

    mounting: str
    board: float
    style: Style
    front_thickness: float
    frame: float
    pitch: float
    bars: int
    grain: Axis
    gap: float
    grip: str
    handle_length: float
    handle_radius: float
    standoff: float
    grip_edge: float
    runner: str
    wall: float
    shelf_pitch: float
    travel: float
    opening_deg: float
    drawer_friction: float
    door_friction: float
    finish: str

    @property
    def inset(self) -> bool:
        """Whether fronts sit between the boards."""
        return self.mounting == "inset"


def design_of(make: FurnitureMake, case: Case, stocks: Mapping[str, Stock]) -> Design:
    """What all cells of one case share."""
    maker = FrontMaker(
        stock=stocks["front"],
        pane=stocks["pane"],
        thickness=make.front_thickness,
        frame=make.frame,
        pitch=make.pitch,
        bars=make.bars,
        grain=make.grain,
    )
    style = make.grip if make.grip not in MILLED else "bar"
    return Design(
        case=case,
        maker=maker,
        inset=make.inset,
        gap=make.gap,
        style=make.style,
        grip=make.grip,
        handle=Handle(
            style=style,
            length=make.handle_length,
            radius=make.handle_radius,
            standoff=make.standoff,
        ),
        grip_edge=make.grip_edge,
        stocks=stocks,
        runner="metal" if make.runner == "metal" else "wood",
        wall=make.wall if make.runner == "metal" else max(make.wall, 0.014),
        travel=make.travel,
        opening=math.radians(make.opening_deg),
        drawer_friction=make.drawer_friction,
        door_friction=make.door_friction,
        shelf_pitch=make.shelf_pitch,
    )


def stocks_of(finish: str, *, top: str | None = None) -> dict[str, Stock]:
    """What each role is cut from; `top` is the surface of a top that differs from the case."""
    case, front = FINISHES[finish]
    return {
        "case": Stock(surface=case, density=PARTICLEBOARD, edge=0.0012),
        "top": Stock(surface=top or case, density=PARTICLEBOARD, edge=0.002),
        "front": Stock(surface=front, density=MDF, edge=0.0015),
        "shelf": Stock(surface=case, density=PARTICLEBOARD, edge=0.0007),
        "leg": Stock(surface="wood", density=OAK, edge=0.0015),
        "box": Stock(surface="drawer_box", density=PLYWOOD, edge=0.0007),
        "bottom": Stock(surface="drawer_box", density=PLYWOOD, edge=0.0),
        "runner": Stock(surface="drawer_box", density=OAK, edge=0.0),
        "back": Stock(surface=case, density=MDF, edge=0.0),
        "metal": Stock(surface="metal", density=ZINC, edge=0.0),
        "steel": Stock(surface="steel", density=STEEL, edge=0.0),
        "ceramic": Stock(surface="ceramic", density=CERAMIC, edge=0.003),
        "pane": Stock(surface="glass", density=GLASS, edge=0.0),
    }


def clears_gaps(make: FurnitureMake, cells: Sequence[Cell]) -> bool:
    """The free rear corner of a door swings outwards by depth^2 / (2 width); gaps must allow it."""
    ahead = AXIS_AHEAD if make.inset else 0.0
    depth = make.front_thickness + ahead
    for cell in cells:
        width = (cell.opening if make.inset else cell.cover).width
        kind = cell.leaf.kind
        if kind == "pair":
            width /= 2.0
        room = make.gap - 0.0005 if make.inset and kind != "pair" else make.gap / 2.0 - 0.0003
        if kind in ("pair", "door_left", "door_right") and depth**2 / (2.0 * width) > room:
            return False
    return True
