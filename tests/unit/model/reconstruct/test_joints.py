"""Joints as they are stated keep what was seen and hold the house's promises."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from model.reconstruct.joints import LEAST_TURN, clean_joint, parents_first
from tests.unit.model.reconstruct.perfect import joint

ANGLES = st.floats(-2.0 * math.pi, 2.0 * math.pi)


@given(lower=ANGLES, upper=ANGLES, seen=st.tuples(ANGLES, ANGLES))
def test_rest_is_an_end_or_the_middle_and_positive_motion_opens(
    lower: float, upper: float, seen: tuple[float, float]
) -> None:
    found = clean_joint(
        joint(1, "revolute", axis=(0.0, 0.0, 1.0), lower=lower, upper=upper, observed=seen)
    )
    assert found.lower == 0.0 or found.lower == -found.upper
    assert LEAST_TURN <= found.upper <= 2.0 * math.pi
    assert found.upper - found.lower <= 2.0 * math.pi
    assert (found.lower <= found.observed).all()
    assert (found.observed <= found.upper).all()


def test_an_axis_that_opens_by_negative_motion_is_turned_around() -> None:
    found = clean_joint(
        joint(1, "revolute", axis=(0.0, 0.0, 1.0), lower=-1.2, upper=0.0, observed=(-0.4, -1.0))
    )
    assert found.axis.tolist() == [0.0, 0.0, -1.0]
    assert (found.lower, found.upper) == (0.0, 1.2)
    assert found.observed.tolist() == [0.4, 1.0]


def test_limits_that_are_not_predicted_come_from_the_states() -> None:
    found = clean_joint(
        joint(1, "prismatic", axis=(0.0, -1.0, 0.0), upper=0.0, observed=(0.1, 0.3))
    )
    assert (found.lower, found.upper) == (0.0, 0.3)
    assert any("no limits were predicted" in change for change in found.changes)


@pytest.mark.parametrize(("seen", "told"), [(1.5, True), (1.005, False), (0.4, False)])
def test_a_way_that_is_widened_is_told(seen: float, told: bool) -> None:
    """A hundredth beyond its end is rounding; half as far again is not."""
    found = clean_joint(
        joint(1, "revolute", axis=(0.0, 0.0, 1.0), lower=0.0, upper=1.0, observed=(0.0, seen))
    )
    assert found.upper == max(seen, 1.0)
    assert any("was widened" in change for change in found.changes) == told


@pytest.mark.parametrize(("off", "kept"), [(16.0, False), (24.0, False), (26.0, True)])
def test_slides_are_put_on_an_axis_from_farther_off(off: float, kept: bool) -> None:
    angle = math.radians(off)
    axis = (0.0, -math.cos(angle), math.sin(angle))
    found = clean_joint(joint(1, "prismatic", axis=axis, upper=0.3)).axis
    assert (abs(found[2]) > 0.1) == kept


@pytest.mark.parametrize(("off", "kept"), [(3.0, False), (14.0, False), (16.0, True)])
def test_an_axis_near_a_coordinate_axis_is_put_on_it(off: float, kept: bool) -> None:
    angle = math.radians(off)
    axis = (2.0 * math.sin(angle), 0.0, -2.0 * math.cos(angle))
    found = clean_joint(joint(1, "revolute", axis=axis, upper=1.0)).axis
    expected = np.array(axis) / 2.0 if kept else np.array([0.0, 0.0, -1.0])
    assert np.abs(found - expected).max() <= 2.0**-52
    assert abs(float(np.linalg.norm(found)) - 1.0) <= 1e-15


@pytest.mark.parametrize(("upper", "endless"), [(6.2, True), (5.9, False)])
def test_a_full_turn_has_no_ends(upper: float, endless: bool) -> None:
    assert clean_joint(joint(1, "revolute", axis=(0.0, 0.0, 1.0), upper=upper)).endless == endless
    assert not clean_joint(joint(1, "prismatic", axis=(0.0, 0.0, 1.0), upper=upper)).endless


def test_an_axis_without_direction_is_told() -> None:
    found = clean_joint(joint(1, "revolute", axis=(0.0, 0.0, 0.0), upper=1.0))
    assert any("no direction" in change for change in found.changes)


def test_parents_that_move_with_each_other_in_a_circle_hang_on_the_base() -> None:
    one = clean_joint(joint(1, "revolute", axis=(0.0, 0.0, 1.0), upper=1.0, parent=2))
    two = clean_joint(joint(2, "revolute", axis=(0.0, 0.0, 1.0), upper=1.0, parent=1))
    first, second = parents_first([one, two])
    assert (first.guess.slot, first.guess.parent) == (1, 0)
    assert (second.guess.slot, second.guess.parent) == (2, 1)
