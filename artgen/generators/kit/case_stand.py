"""What a case stands on: a plinth, its own sides with a toe board, legs, or a rail on the wall."""

from collections.abc import Mapping
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.carcass import Case
from artgen.generators.kit.density import STEEL
from artgen.generators.kit.stand import STANDS, Stand


@dataclass(frozen=True, kw_only=True)
class Leg:
    """Measures of legs, m: what `Stand` needs beside the case."""

    height: float
    inset: float
    splay: float
    girth: float


def case_stand(case: Case, stocks: Mapping[str, Stock], *, sort: str, leg: Leg) -> tuple[Body, ...]:
    """`sort` is `wall`, `panel` or a key of STANDS."""
    if sort == "wall":
        rail = (case.opening.x0, case.back - 0.0095, case.opening.z1 - 0.05)
        end = (case.opening.x1, case.back - 0.0065, case.opening.z1 - 0.015)
        return (stocks["steel"].board(rail, end),)
    if sort == "panel":
        front, inner = case.front + 0.05, case.opening
        low = (inner.x0, front, 0.0)
        return (stocks["case"].board(low, (inner.x1, front + 0.016, case.outside.z0), grain="x"),)
    stand = Stand(
        width=case.outside.width,
        front=case.front,
        back=case.back,
        height=leg.height,
        inset=0.045 if sort == "plinth" else leg.inset,
        splay=leg.splay,
        girth=leg.girth,
    )
    wood = stocks["case"] if sort == "plinth" else stocks["leg"]
    metal = Stock(surface="metal", density=STEEL, edge=0.0008)
    return STANDS[sort](stand, wood, metal)
