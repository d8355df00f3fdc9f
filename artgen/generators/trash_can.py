"""Trash cans: pedal bins and touch bins with an inner bucket, alone or in twos; wheeled bins."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.articulation.types import Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.bin_plan import Plan
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.density import ABS, POLYPROPYLENE, RUBBER, STAINLESS, STEEL
from artgen.generators.kit.pedal_bin import PedalBin, pedal_bin
from artgen.generators.kit.wheelie_bin import WheelieBin, wheelie_bin

LITERS: Mapping[int, tuple[float, float]] = {
    3: (0.170, 0.26), 5: (0.205, 0.285), 12: (0.250, 0.40), 20: (0.293, 0.455), 30: (0.293, 0.645),
    45: (0.340, 0.66),
}  # fmt: skip
"""Diameter and height of pedal bins by volume, m, as makers print it on them."""
WHEELED: Mapping[int, tuple[float, float, float]] = {
    80: (0.445, 0.515, 0.94),
    120: (0.480, 0.550, 0.935),
    240: (0.580, 0.730, 1.065),
}
"""Width, depth and height of two-wheeled bins by volume, m (EN 840-1)."""


@dataclass(frozen=True, kw_only=True)
class TrashCanParams:
    """Factors multiply usual sizes; lengths in m, angles in degrees."""

    kind: str
    plan: str
    liters: int
    wheeled_liters: int
    width_factor: float
    height_factor: float
    flatness: float
    corner: float
    dome: float
    step: float
    press_deg: float
    lid_deg: float
    lid_friction: float
    bag: bool
    lid_in_plastic: bool
    narrow: float
    slope: float
    wheel: float
    tread: float
    ribs: int
    swing_deg: float


PARAMS = TrashCanParams


def build(p: TrashCanParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """The pedal lifts the lid by a coupling; buckets come out once the lid stands open."""
    works = Works()
    if p.kind == "wheelie":
        works = wheelie_bin(_wheeled(p))
    else:
        for one in _bins(p):
            works += pedal_bin(one)
    parts = (DraftPart(name="base", label="base", bodies=works.base), *works.parts)
    used = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="trash_can",
        parts=parts,
        joints=works.joints,
        surfaces=tuple(spec for role, spec in surfaces.items() if role in used),
        preconditions=works.preconditions,
    )


def _bins(p: TrashCanParams) -> tuple[PedalBin, ...]:
    """One bin, or two side by side on pedals of their own."""
    wide, high = LITERS[p.liters]
    radius, height = 0.5 * wide * p.width_factor, high * p.height_factor
    round_one = p.plan == "round" and p.kind != "twin"
    half = (radius, radius) if round_one else (radius * p.flatness, radius / p.flatness**0.5)
    plan = Plan(half=half, corner=None if round_one else min(p.corner, 0.8 * min(half)))
    names = ("left_", "right_") if p.kind == "twin" else ("",)
    gap = 2.0 * half[0] + 0.0075
    dome = p.dome if round_one else min(p.dome, 0.026)
    plastic = Stock(surface="plastic", density=0.45 * ABS, edge=0.0)
    sheet = Stock(surface="shell", density=0.42 * STAINLESS, edge=0.0)
    dished = Stock(surface="shell", density=0.10 * STAINLESS, edge=0.0)  # 0.7 mm over a thick dome.
    return tuple(
        PedalBin(
            name=name,
            at=(k - (len(names) - 1) / 2.0) * gap,
            plan=plan,
            height=height - dome,
            dome=dome,
            step=None if p.kind == "touch" else min(p.step, 0.62 * half[0]),
            press=math.radians(p.press_deg),
            opens=math.radians(p.lid_deg),
            friction=p.lid_friction,
            bag=p.bag,
            shell=sheet,
            lid=plastic if p.lid_in_plastic else dished,
            plastic=plastic,
            bucket=Stock(surface="bucket", density=0.7 * POLYPROPYLENE, edge=0.0),
            liner=Stock(surface="liner", density=60.0, edge=0.0),
        )
        for k, name in enumerate(names)
    )


def _wheeled(p: TrashCanParams) -> WheelieBin:
    width, depth, height = WHEELED[p.wheeled_liters]
    body = Stock(surface="body", density=POLYPROPYLENE, edge=0.0)
    return WheelieBin(
        half=(0.5 * width * p.width_factor - 0.02, 0.5 * depth * p.width_factor - 0.05),
        height=height * p.height_factor - 0.06,
        narrow=p.narrow,
        slope=p.slope,
        corner=0.04,
        wheel=p.wheel,
        tread=p.tread,
        opens=math.radians(p.swing_deg),
        friction=1.5 * p.lid_friction,
        ribs=p.ribs,
        body=body,
        lid=Stock(surface="lid", density=POLYPROPYLENE, edge=0.0),
        plastic=Stock(surface="plastic", density=ABS, edge=0.0),
        rubber=Stock(surface="rubber", density=RUBBER, edge=0.0),
        steel=Stock(surface="steel", density=STEEL, edge=0.0),
    )


def twins_are_for_kitchens(p: TrashCanParams) -> bool:
    """Two compartments come in middle sizes."""
    return p.kind != "twin" or 12 <= p.liters <= 30


def buckets_hold_something(p: TrashCanParams) -> bool:
    """Flat plans need width."""
    return p.plan == "round" or LITERS[p.liters][0] / p.flatness**0.5 > 0.15


INVARIANTS: Mapping[str, Callable[[TrashCanParams], bool]] = {
    "twins_are_for_kitchens": twins_are_for_kitchens,
    "buckets_hold_something": buckets_hold_something,
}
