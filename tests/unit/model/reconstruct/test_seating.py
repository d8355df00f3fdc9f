"""Axes run through what they turn, slides are no longer than what they slide."""

import math

import numpy as np
import pytest

from artgen.geometry.solid import slab
from model.reconstruct.seating import HELD, seated, way_to_box
from tests.unit.model.reconstruct.scenes import scene_of, stated

BASE = slab((-1.0, 0.5, 0.0), (1.0, 1.0, 1.0))
DOOR = slab((0.0, 0.0, 0.0), (0.5, 0.02, 0.8))


def test_a_hinge_beside_its_door_is_moved_to_it_without_turning() -> None:
    hinge = stated("door", "revolute", axis=(0.0, 0.0, 1.0), origin=(-0.2, 0.01, 0.3), upper=1.0)
    found = seated(scene_of(hinge, base=BASE, door=DOOR)).joint("door_joint")
    assert found.axis == hinge.axis
    assert np.abs(np.array(found.origin) - (0.0, 0.01, 0.3)).max() <= 1e-12


def test_a_barrel_that_stands_out_a_little_is_left() -> None:
    hinge = stated("door", "revolute", axis=(0.0, 0.0, 1.0), origin=(-0.01, -0.005, 0.0), upper=1.0)
    scene = scene_of(hinge, base=BASE, door=DOOR)
    assert seated(scene) is scene


def test_the_way_to_a_box_is_square_to_the_line() -> None:
    """A slanted line past a box; points lie 1 % of its diagonal apart."""
    axis = np.array([math.sqrt(0.5), 0.0, math.sqrt(0.5)])
    way = way_to_box(np.array([0.0, -0.3, 0.0]), axis, DOOR.bounds)
    assert abs(way @ axis) <= 1e-12
    assert np.abs(way - (0.0, 0.3, 0.0)).max() <= 0.02


@pytest.mark.parametrize("upper", [0.8, 0.5, 0.5 - 1e-9])
def test_a_slide_goes_less_far_than_its_part_is_long(upper: float) -> None:
    """Also where its way was just as long: rounding vertices to 1e-7 m shortens a part by 1e-7."""
    slide = stated("door", "prismatic", axis=(1.0, 0.0, 0.0), upper=upper)
    scene = seated(scene_of(slide, base=BASE, door=DOOR))
    found = scene.joint("door_joint").limit
    assert found is not None
    assert found.lower == 0.0
    assert 0.5 - 1e-7 > found.upper == pytest.approx((1.0 - HELD) * 0.5)
    assert seated(scene) is scene
