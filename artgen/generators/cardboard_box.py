"""Cardboard boxes: slotted cartons of corrugated board whose four upper flaps fold in order."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.articulation.types import Draft, DraftPart, Grip
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.board import Stock
from artgen.generators.kit.carton import (
    CORNER,
    Carton,
    Flaps,
    bottom,
    flaps,
    hole_height,
    partition,
    walls,
)

FLUTES: Mapping[str, tuple[float, float, float, int]] = {
    "E": (0.0016, 0.0033, 0.44, 1),
    "B": (0.0030, 0.0062, 0.48, 1),
    "C": (0.0040, 0.0077, 0.54, 1),
    "BC": (0.0068, 0.0077, 0.90, 2),
}
"""Thickness and length of a wave (m), mass of the board (kg/m2), walls: FEFCO, ISO 3034."""


@dataclass(frozen=True, kw_only=True)
class CardboardBoxParams:
    """Lengths in m; ratios multiply the length."""

    style: str
    length: float
    width_ratio: float
    height_ratio: float
    flute: str
    overlap: float
    hand_holes: bool
    holds: str
    cells_x: int
    cells_y: int
    partition_share: float
    taped: bool
    design: str
    ink: str
    maker: int
    label_seed: int
    mottle: float
    fold_deg: float
    crease: float
    grammage: float

    @property
    def width(self) -> float:
        """Along y; never the longer side."""
        return self.length * self.width_ratio

    @property
    def height(self) -> float:
        """Of the short walls."""
        return self.length * self.height_ratio


PARAMS = CardboardBoxParams


def build(p: CardboardBoxParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Walls and a closed bottom; minor flaps lie under major ones and wait for them to open."""
    carton, specs = carton_of(p), _printed(p, surfaces)
    base = [*walls(carton), *bottom(carton)]
    if p.holds == "partition":
        height = p.partition_share * (p.height - 2.0 * carton.board)
        base += partition(carton, (p.cells_x, p.cells_y), height)
    parts, joints, order = flaps(carton, Flaps(reach=math.radians(p.fold_deg), friction=p.crease))
    body = DraftPart(name="base", label="base", bodies=tuple(base), grips=_hand_holds(p))
    return Draft(
        category="cardboard_box",
        parts=(body, *parts),
        joints=joints,
        surfaces=specs,
        preconditions=order,
    )


def carton_of(p: CardboardBoxParams) -> Carton:
    """Flaps meet in the middle, overlap, or cover the whole top, as the style says."""
    t, wave, mass, _ = FLUTES[p.flute]
    half = p.width / 2.0
    major = {
        "0202": half + p.overlap / 2.0,
        "0203": p.width - t - 0.0012,
    }.get(p.style, half - 0.0006)
    furthest = p.length / 2.0 - 0.0008
    minor = furthest if p.style == "0204" else min(half, furthest)
    density = p.grammage * mass / t
    edges = {"board": 0.0005}
    return Carton(
        length=p.length,
        width=p.width,
        height=p.height,
        board=t,
        major=major,
        minor=minor,
        overlapped=p.style in ("0202", "0203"),
        hand_holes=p.hand_holes,
        stocks={
            name: Stock(surface=name, density=density, edge=edges.get(name, 0.0))
            for name in ("board", "edge", "front", "side", "top")
        },
        wave=2.0 * wave,
    )


def _printed(p: CardboardBoxParams, surfaces: Mapping[str, SurfaceSpec]) -> tuple[SurfaceSpec, ...]:
    """The board's surface, its cut edge, and one print for each face that differs."""
    board = surfaces["board"]
    c, (_, wave, _, thick) = carton_of(p), FLUTES[p.flute]
    print_of: dict[str, float | str] = {
        "design": p.design,
        "ink": p.ink,
        "maker": p.maker,
        "tape": int(p.taped),
        "mottle": p.mottle,
        "seed": p.label_seed,
    }
    sizes = {
        "front": (p.length - 2.0 * CORNER, c.long_wall - 0.002),
        "side": (p.width - 2.0 * CORNER, c.height - 0.002),
        "top": (p.length - 0.0044, c.major - 0.001),
    }
    prints = [
        dataclasses.replace(
            board, name=face, recipe="carton_print", tile=size, detail=print_of | {"face": face}
        )
        for face, size in sizes.items()
    ]
    edge = dataclasses.replace(
        board, name="edge", recipe="flutes", tile=(2.0 * wave, c.board), detail={"walls": thick}
    )
    plain = dataclasses.replace(
        board, tile=(10.0 * wave, 10.0 * wave), detail={"mottle": p.mottle, "flutes": 10}
    )
    return (plain, edge, *prints)


def _hand_holds(p: CardboardBoxParams) -> tuple[Grip, ...]:
    if not p.hand_holes:
        return ()
    z = hole_height(carton_of(p))
    return tuple(
        Grip(
            name=f"hand_hole_{side}",
            kind="handle",
            position=(sign * p.length / 2.0, 0.0, z),
            outward=(sign, 0.0, 0.0),
            pull=(0.0, 0.0, 1.0),
        )
        for side, sign in (("left", -1.0), ("right", 1.0))
    )


def holes_have_room(p: CardboardBoxParams) -> bool:
    """Hands need 0.09 m of a wall that is high enough; thin board tears."""
    return not p.hand_holes or (p.width > 0.2 and p.height > 0.15 and p.flute != "E")


def board_suits_size(p: CardboardBoxParams) -> bool:
    """Fine flutes for small boxes, double walls for large ones."""
    if p.flute == "E":
        return p.length < 0.32
    return p.flute != "BC" or p.length > 0.34


INVARIANTS: Mapping[str, Callable[[CardboardBoxParams], bool]] = {
    "holes_have_room": holes_have_room,
    "board_suits_size": board_suits_size,
}
