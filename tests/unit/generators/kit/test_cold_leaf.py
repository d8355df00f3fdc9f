"""Leaves of refrigerators clear their case and what slides out behind them."""

import math

import numpy as np
import pytest

from artgen.generators.kit.cold_case import boxes_outside
from artgen.generators.kit.cold_leaf import ColdLeaf, Hinge
from artgen.geometry.solid import slab, union


def leaf(hinge: Hinge = "left", setback: float = 0.03) -> ColdLeaf:
    return ColdLeaf(
        name="door", hinge=hinge, corner=(0.0, 0.0, 0.1), width=0.6, length=1.0, thickness=0.06,
        gap=0.011, inset=0.013, setback=setback, seal_inset=0.0145,
    )  # fmt: skip


@pytest.mark.parametrize("hinge", ["left", "right"])
@pytest.mark.parametrize("setback", [0.014, 0.019, 0.023])
def test_a_door_turns_to_its_widest_beside_its_case(hinge: Hinge, setback: float) -> None:
    """At every angle up to `widest`, but not far beyond, the leaf stays clear of the case."""
    door = leaf(hinge, setback)
    case = door.placed(slab((0.0, 0.0, -0.1), (0.6, 0.6, 1.1)))
    solid = door.placed(door.slab(front=door.front, back=door.back))
    way = -1.0 if hinge == "left" else 1.0
    pivot = door.point(*door.pin, 0.0)

    def met(angle: float) -> bool:
        return not (solid.turned("z", way * angle, about=pivot) & case).is_empty

    assert not any(met(a) for a in np.linspace(0.0, door.widest(), 60))
    assert met(door.widest() + math.radians(12.0))


def test_a_clearing_door_lies_beside_the_bin() -> None:
    door, corners = leaf(), [(0.05, 0.09), (0.55, 0.09), (0.0, -0.011)]
    angle = door.clearing_angle(corners, beside=0.06)
    assert all(door.swung(x, y, angle)[0] <= 0.06 for x, y in corners)


def test_what_turns_past_a_wall_reaches_no_further_than_it() -> None:
    door = leaf()
    x = door.free_reach(0.08, beside=0.55)
    turned = [door.swung(x, 0.08, float(a))[0] for a in np.linspace(0.0, 1.0, 50)]
    assert max(turned) <= 0.55 + 1e-12


def test_boxes_around_a_hole_fill_the_rest_of_a_cuboid() -> None:
    piece, hole = slab((0, 0, 0), (1, 1, 1)), slab((0.2, 0.3, -1.0), (0.5, 2.0, 0.6))
    rest = boxes_outside(piece, hole)
    assert math.isclose(sum(box.volume for box in rest), (piece - hole).volume, rel_tol=1e-12)
    assert (union(rest) & hole).volume < 1e-12
