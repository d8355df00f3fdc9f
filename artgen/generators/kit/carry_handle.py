"""Carry handles of cases: a bar whose legs rise out of two brackets against springs."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import DraftPart, Grip, Joint, Limit, Spring, Vector
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.geometry.solid import Solid, chamfered_box, hull, slab

RISE, LEG = 0.008, 0.0098
"""Stroke, and length of the legs in their brackets, m."""
BRACKET = (0.036, 0.027, 0.012)
"""Along the bar, across it, and up from the case, m."""
THICK = 0.013
"""Of the bar in its middle, m."""


@dataclass(frozen=True, kw_only=True)
class CarryHandle:
    """A handle on the top of a case (`side` False) or on its right side (True).

    Attributes:
        place: middle of its foot on the case.
        length: over the brackets, m.
        girth: width of the bar, m.
    """

    name: str
    place: Vector
    side: bool
    length: float
    girth: float
    strap: Stock
    plastic: Stock


def carry_handle(h: CarryHandle) -> Works:
    """The bar with its joint, and the brackets in the base."""
    middle = h.length / 2.0 - BRACKET[0] / 2.0
    slot = (0.0100, h.girth - 0.006)
    brackets, walls, legs = [], [], []
    for x in (-middle, middle):
        block = chamfered_box(BRACKET, 0.0034, at=(x, 0.0, 0.0))
        hole = _block(x, (slot[0] + 0.0022, slot[1] + 0.0022), 0.002, 1.0)
        brackets.append(block - hole)
        a, c = BRACKET[0] / 2.0, (slot[0] + 0.0022) / 2.0
        walls += [_between(x - a, x - c), _between(x + c, x + a)]
        legs.append(_block(x, slot, BRACKET[2] - LEG, BRACKET[2] + 0.004))
    low = BRACKET[2] + 0.0014
    bar = _bar(h, low)
    reach = slab(
        (-h.length / 2 + 0.001, -h.girth / 2, low),
        (h.length / 2 - 0.001, h.girth / 2, low + 0.7 * THICK),
    )
    up: Vector = (1.0, 0.0, 0.0) if h.side else (0.0, 0.0, 1.0)
    middle_up = low + THICK / 2.0
    hold = tuple(c + middle_up * u for c, u in zip(h.place, up, strict=True))
    part = DraftPart(
        name=h.name,
        label="handle",
        bodies=(
            h.plastic.piece(_placed(h, legs[0]), contact=(_placed(h, legs[0]),)),
            h.plastic.piece(_placed(h, legs[1]), contact=(_placed(h, legs[1]),)),
            h.strap.piece(_placed(h, bar), contact=(_placed(h, reach),)),
        ),
        grips=(
            Grip(
                name=f"{h.name}_bar",
                kind="handle",
                position=(hold[0], hold[1], hold[2]),
                outward=up,
                pull=up,
            ),
        ),
    )
    joint = Joint(
        name=f"{h.name}_lift",
        type="prismatic",
        parent="base",
        child=h.name,
        axis=up,
        limit=Limit(lower=0.0, upper=RISE),
        friction=1.5,
        damping=5.0,
        effort=250.0,
        velocity=1.0,
        spring=Spring(stiffness=350.0, reference=-0.004),
    )
    contacts = [[_placed(h, wall) for wall in walls[k : k + 2]] for k in (0, 2)]
    base = tuple(
        h.plastic.piece(_placed(h, bracket), contact=tuple(near))
        for bracket, near in zip(brackets, contacts, strict=True)
    )
    return Works(parts=(part,), joints=(joint,), base=base)


def _bar(h: CarryHandle, low: float) -> Solid:
    """Thick and round in the middle, thin at its ends."""
    end, wide = h.length / 2.0, h.girth / 2.0
    points = [
        (sx * x, sy * y, low + z)
        for x, y, z in (
            (end, wide - 0.003, 0.0),
            (end, wide - 0.001, 0.0025),
            (end - 0.002, wide - 0.004, 0.0045),
            (end - 0.034, wide, 0.006),
            (end - 0.030, wide - 0.005, THICK),
            (end - 0.030, wide - 0.001, 0.0),
        )
        for sx in (-1.0, 1.0)
        for sy in (-1.0, 1.0)
    ]
    return hull(np.asarray(points))


def _block(x: float, size: tuple[float, float], low: float, high: float) -> Solid:
    a, b = size[0] / 2.0, size[1] / 2.0
    return slab((x - a, -b, low), (x + a, b, high))


def _between(x0: float, x1: float) -> Solid:
    return slab((x0, -BRACKET[1] / 2.0, 0.0), (x1, BRACKET[1] / 2.0, BRACKET[2]))


def _placed(h: CarryHandle, solid: Solid) -> Solid:
    """What was drawn along x and upwards put on the top, or on the right side along z."""
    turned = solid.turned("y", math.pi / 2.0) if h.side else solid
    return turned.at(*h.place)
