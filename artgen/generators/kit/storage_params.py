"""Params of storage furniture: the numbers that all kinds share, and usual sizes by kind."""

from collections.abc import Mapping
from dataclasses import dataclass

from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_design import BUMPER, Design
from artgen.generators.kit.carcass import Case
from artgen.generators.kit.case_stand import Leg
from artgen.generators.kit.density import ALUMINIUM, GLASS, OAK
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.furniture_make import FurnitureMake, design_of, stocks_of

Span = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Usual:
    """Middle and half range of width, depth and height, m; whether fronts lie between boards."""

    width: Span
    depth: Span
    height: Span
    inset: bool | None = None


USUAL: Mapping[str, Usual] = {
    "wardrobe": Usual(width=(1.25, 0.45), depth=(0.58, 0.03), height=(2.04, 0.16)),
    "sliding_wardrobe": Usual(
        width=(1.85, 0.38), depth=(0.63, 0.03), height=(2.08, 0.16), inset=True
    ),
    "desk": Usual(width=(1.40, 0.22), depth=(0.68, 0.08), height=(0.742, 0.014), inset=False),
    "dresser": Usual(width=(1.05, 0.32), depth=(0.46, 0.05), height=(0.83, 0.10)),
    "sideboard": Usual(width=(1.60, 0.32), depth=(0.43, 0.04), height=(0.74, 0.12), inset=True),
    "hutch": Usual(width=(1.08, 0.26), depth=(0.46, 0.04), height=(1.94, 0.12)),
    "bookcase": Usual(width=(0.92, 0.16), depth=(0.37, 0.04), height=(1.94, 0.16)),
    "secretary": Usual(width=(0.84, 0.12), depth=(0.43, 0.025), height=(1.22, 0.12), inset=True),
}


@dataclass(frozen=True, kw_only=True)
class StorageParams(FurnitureMake):
    """Shares in [-1, 1] place a size within the kind's usual range; the rest is in m, N, N m."""

    kind: str
    width_share: float
    depth_share: float
    height_share: float
    columns: int
    column_weight: tuple[float, ...]
    fit_out: tuple[str, ...]
    rows: int
    growth: float
    hinge_left: bool
    base_drawers: int
    inner_drawers: int
    stand: str
    plinth_height: float
    leg_height: float
    leg_girth: float
    leg_splay: float
    stand_inset: float
    top_thickness: float
    overhang: float
    hangers: int
    door_fill: str
    fields: int
    framed: bool
    profile: float
    mirrored: bool
    slide_friction: float
    pedestals: str
    pedestal_width: float
    under_top: str
    desk_end: str
    mirror: str
    mirror_shape: str
    mirror_height: float
    mirror_border: float
    upper_share: float
    upper_gap: float
    niche: bool
    flap_arm: float
    flap_friction: float
    pigeonholes: int
    leather: bool

    @property
    def width(self) -> float:
        """Of the case."""
        return _within(USUAL[self.kind].width, self.width_share)

    @property
    def depth(self) -> float:
        """From the fronts' faces to the back."""
        return _within(USUAL[self.kind].depth, self.depth_share)

    @property
    def height(self) -> float:
        """From the floor to the top, a mirror aside."""
        return _within(USUAL[self.kind].height, self.height_share)

    @property
    def inset(self) -> bool:
        """Whether fronts sit between the boards; some kinds know one way only."""
        usual = USUAL[self.kind].inset
        return self.mounting == "inset" if usual is None else usual

    @property
    def stand_height(self) -> float:
        """Under the case."""
        return self.plinth_height if self.stand in ("plinth", "panel") else self.leg_height

    @property
    def leg(self) -> Leg:
        """What the case stands on."""
        return Leg(
            height=self.stand_height,
            inset=self.stand_inset,
            splay=self.leg_splay,
            girth=self.leg_girth,
        )


def _within(span: Span, share: float) -> float:
    return span[0] + span[1] * share


def case_of(p: StorageParams, outside: Rect, *, top: str, foot: float, depth: float) -> Case:
    """A case within a rectangle, its back in the plane of the piece's back."""
    face = p.depth / 2.0 - depth
    return Case(
        outside=outside,
        front=face if p.inset else face + p.front_thickness + BUMPER,
        back=p.depth / 2.0,
        board=p.board,
        panel=0.006,
        top_thickness=p.top_thickness if top == "overhang" else p.board,
        top=top,
        overhang=p.overhang,
        overhang_from=face,
        foot=foot,
    )


def whole_case(p: StorageParams, *, top: str, high: float | None = None) -> Case:
    """The case that stands on the floor over the full width, up to `high` m."""
    outside = Rect(x0=-p.width / 2.0, x1=p.width / 2.0, z0=p.stand_height, z1=high or p.height)
    foot = 0.0 if p.stand == "panel" else p.stand_height
    return case_of(p, outside, top=top, foot=foot, depth=p.depth)


def storage_stocks(p: StorageParams) -> dict[str, Stock]:
    """What each role is cut from."""
    wooden = p.finish == "wood"
    return stocks_of(p.finish) | {
        "profile": Stock(
            surface="wood" if wooden else "aluminium",
            density=OAK if wooden else 0.45 * ALUMINIUM,  # Chambers in the profile.
            edge=0.0006,
        ),
        "track": Stock(surface="aluminium", density=ALUMINIUM, edge=0.0),
        "mirror": Stock(surface="mirror", density=GLASS, edge=0.0),
        "hanger": Stock(surface="hanger", density=OAK, edge=0.0),
        "leather": Stock(surface="leather", density=900.0, edge=0.0),
    }


def design(p: StorageParams, case: Case) -> Design:
    """What all cells of a case share."""
    return design_of(p, case, storage_stocks(p))
