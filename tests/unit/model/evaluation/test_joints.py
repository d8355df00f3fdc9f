"""Errors of joints in closed form, and laws of lines."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import minimize

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from model.evaluation.joints import JointErrors, angle_deg, joint_errors, line_distance
from model.evaluation.matching import by_order
from model.evaluation.reshape import taken
from tests.unit.model.evaluation.layouts import cabinet

vector = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array)


def door_of(**changes: object) -> JointErrors:
    return joint_errors(cabinet(**changes), cabinet(), by_order(3, 3))[1]


def test_the_truth_has_no_errors() -> None:
    for row in joint_errors(cabinet(), cabinet(), by_order(3, 3)):
        assert row.found
        assert row.type_right
        assert row.parent_right
        assert (row.axis_deg, row.axis_unsigned_deg, row.flipped) == (0.0, 0.0, False)
        assert row.lever == row.state_share == 0.0
        assert row.limit_iou == 1.0


@given(st.floats(0.0, 180.0))
def test_angles_keep_their_digits_everywhere(degrees: float) -> None:
    turn = math.radians(degrees)
    found = angle_deg(np.array([math.cos(turn), math.sin(turn), 0.0]), np.array([1.0, 0.0, 0.0]))
    # A component has half an ulp, 1.1e-16 rad; two of them and the tangent: 1e-13 degrees.
    assert found == pytest.approx(degrees, abs=1e-13)


def test_acos_would_lose_half_the_digits() -> None:
    small = 1e-9
    found = angle_deg(np.array([math.cos(small), math.sin(small), 0.0]), np.array([1.0, 0.0, 0.0]))
    assert found == pytest.approx(math.degrees(small), rel=1e-12)
    assert math.degrees(math.acos(min(math.cos(small), 1.0))) == 0.0


def test_parallel_lines_are_their_offset_apart() -> None:
    up = np.array([0.0, 0.0, 1.0])
    assert line_distance(np.zeros(3), up, np.array([3.0, 4.0, 7.0]), up) == 5.0
    assert line_distance(np.zeros(3), up, np.array([3.0, 4.0, 7.0]), -up) == 5.0
    assert (
        line_distance(np.zeros(3), up, np.array([0.0, 2.0, 5.0]), np.array([1.0, 0.0, 0.0])) == 2.0
    )


@given(vector, vector, vector, vector)
def test_line_distance_is_the_least_over_points_of_both(
    origin: np.ndarray, axis: np.ndarray, other: np.ndarray, direction: np.ndarray
) -> None:
    assume(min(np.linalg.norm(axis), np.linalg.norm(direction)) > 0.1)
    axis, direction = axis / np.linalg.norm(axis), direction / np.linalg.norm(direction)
    assume(np.linalg.norm(np.cross(axis, direction)) > 0.1)
    least = minimize(
        lambda t: np.sum((origin + t[0] * axis - other - t[1] * direction) ** 2), (0, 0)
    )
    found = line_distance(origin, axis, other, direction)
    # The minimizer's own tolerance on the square is 1e-10 or better for slopes above 0.1.
    assert found**2 == pytest.approx(float(least.fun), abs=1e-8)


def test_a_flipped_hinge_is_seen_with_a_sign_and_not_without() -> None:
    axes = np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)])
    row = door_of(axes=axes)
    assert (row.axis_deg, row.axis_unsigned_deg, row.flipped) == (180.0, 0.0, True)
    assert row.line == row.pivot == 0.0
    # The middle of the door goes the other way: 2 a sin(mid-range) apart.
    arm = math.hypot(0.5, 0.05)
    assert row.lever == pytest.approx(2.0 * arm * math.sin(0.75) / cabinet().radius, abs=1e-15)


def test_flips_are_undone_for_states_and_limits() -> None:
    axes = np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)])
    limits = np.array([(0.0, 0.0), (0.0, 0.5), (-1.5, 0.0)])
    states = np.array([(0.0, 0.0, 0.0), (0.0, 0.25, -1.0)])
    row = door_of(axes=axes, limits=limits, states=states)
    assert row.limit_iou == 1.0
    assert row.state_deg == 0.0
    assert row.lever == pytest.approx(0.0, abs=1e-15)


def test_an_axis_beside_the_true_one() -> None:
    origins = np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.3, 0.4, 5.0)])
    row = door_of(origins=origins)
    assert row.line == row.pivot == pytest.approx(0.5 / cabinet().radius, abs=1e-15)
    # A rotation by q about an axis beside the true one differs by the chord 2 d sin(q / 2).
    assert row.lever == pytest.approx(1.0 * math.sin(0.375) / cabinet().radius, abs=1e-15)


def test_lines_that_meet_far_away_have_no_distance_but_a_pivot() -> None:
    """Tilted by 1 degree in a plane, 0.3 beside: they meet 17 lengths away."""
    tilt = math.radians(1.0)
    axes = np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (-math.sin(tilt), 0.0, -math.cos(tilt))])
    origins = np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.3, 0.0, 0.75)])
    row = door_of(axes=axes, origins=origins)
    assert row.line == pytest.approx(0.0, abs=1e-14)
    assert row.pivot == pytest.approx(0.3 * math.cos(tilt) / cabinet().radius, abs=1e-14)


def test_states_and_limits() -> None:
    states = np.array([(0.0, 0.1, 0.0), (0.0, 0.25, 0.5)])
    limits = np.array([(0.0, 0.0), (0.25, 1.0), (0.0, 0.75)])
    drawer, door = joint_errors(cabinet(states=states, limits=limits), cabinet(), by_order(3, 3))
    assert drawer.state_radii == pytest.approx(0.05 / cabinet().radius, abs=1e-16)
    assert drawer.state_deg is None
    assert drawer.state_share == pytest.approx(0.1, abs=1e-15)
    assert drawer.limit_iou == 0.25
    assert door.state_deg == pytest.approx(math.degrees(0.25), abs=1e-13)
    assert door.limit_iou == 0.5
    assert joint_errors(cabinet(states=None), cabinet(), by_order(3, 3))[0].state_share is None


def test_ranges_apart_share_nothing() -> None:
    assert door_of(limits=np.array([(0.0, 0.0), (0.0, 0.5), (2.0, 3.0)])).limit_iou == 0.0


def test_points_for_ranges_share_nothing_unless_they_are_one() -> None:
    point = np.array([(0.0, 0.0), (0.2, 0.2), (1.0, 1.0)])
    other = np.array([(0.0, 0.0), (0.2, 0.2), (1.5, 1.5)])
    rows = joint_errors(cabinet(limits=other), cabinet(limits=point), by_order(3, 3))
    assert [row.limit_iou for row in rows] == [1.0, 0.0]
    # A share of a range that is a point cannot be asked.
    assert [row.state_share for row in rows] == [None, None]
    assert door_of(limits=point).limit_iou == 0.0


def test_an_unknown_point_of_the_axis_has_no_line() -> None:
    origins = np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (np.nan, 0.0, 0.0)])
    row = door_of(origins=origins)
    assert row.line is row.pivot is None
    assert row.axis_deg == 0.0


def test_a_wrong_type_asks_for_no_line() -> None:
    row = door_of(types=np.array([FIXED, PRISMATIC, PRISMATIC]))
    assert not row.type_right
    assert row.axis_deg == 0.0
    assert row.line is row.state_share is row.limit_iou is None


def test_a_fixed_part_has_no_axis_and_does_not_move() -> None:
    row = door_of(types=np.array([FIXED, PRISMATIC, FIXED]), axes=np.zeros((3, 3)))
    assert row.axis_deg is None
    arm = math.hypot(0.5, 0.05)
    assert row.lever == pytest.approx(2.0 * arm * math.sin(0.375) / cabinet().radius, abs=1e-15)


def test_a_missing_part_is_a_wrong_type() -> None:
    rows = joint_errors(taken(cabinet(), [0, 1]), cabinet(), by_order(2, 3))
    assert [row.found for row in rows] == [True, False]
    assert not rows[1].type_right


def test_an_unknown_axis_has_no_angle() -> None:
    axes = np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (np.nan, np.nan, np.nan)])
    assert door_of(axes=axes).axis_deg is None


def test_types_are_what_targets_say() -> None:
    assert (FIXED, REVOLUTE, PRISMATIC) == (0, 1, 2)


def test_endless_turns_are_compared_around_the_circle() -> None:
    endless = np.array([False, False, True])
    states = np.array([(0.0, 0.0, 0.0), (0.0, 0.25, 1.0 + 2.0 * math.pi)])
    row = joint_errors(
        cabinet(endless=endless, states=states), cabinet(endless=endless), by_order(3, 3)
    )[1]
    assert row.state_deg == pytest.approx(0.0, abs=1e-13)  # One rounding of a number below 8.
    assert row.limit_iou == 1.0
    assert door_of(endless=endless).limit_iou == 0.0
