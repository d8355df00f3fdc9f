"""States obey limits and preconditions and have addresses; targets are the fields themselves."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from artgen.articulation.kinematics import joint_motion
from artgen.articulation.states import (
    check_state,
    motion,
    obeying,
    open_state,
    required_state,
    sample_states,
)
from artgen.articulation.targets import PRISMATIC, REVOLUTE, swept_sphere, targets
from artgen.articulation.types import Joint, Limit, Precondition
from artgen.core.errors import KinematicError
from artgen.core.rotation import axis_angle_matrix
from artgen.core.stream import Stream
from artgen.core.transform import apply
from tests.strategies import trees

PHYSICS = {"friction": 1.0, "damping": 0.1, "effort": 10.0}


def sliding(name: str, parent: str, axis: tuple, upper: float) -> Joint:
    limit = Limit(lower=0.0, upper=upper)
    return Joint(
        name=name, type="prismatic", parent=parent, child=name, axis=axis, limit=limit, **PHYSICS
    )


DOOR = Joint(
    name="door",
    type="revolute",
    parent="base",
    child="door",
    axis=(1.0, 0.0, 0.0),
    origin=(0.0, -0.3, 0.1),
    limit=Limit(lower=0.0, upper=1.5),
    **PHYSICS,
)
RACK = sliding("rack", "base", (0.0, -1.0, 0.0), 0.5)
BASKET = sliding("basket", "rack", (0.0, 0.0, 1.0), 0.2)
JOINTS = (DOOR, RACK, BASKET)
RULES = (
    Precondition(joint="basket", requires="rack", at_least=0.3),
    Precondition(joint="rack", requires="door", at_least=1.4),
)


@given(st.integers(0, 10**6), st.integers(1, 5))
def test_drawn_states_obey_limits_and_preconditions(seed, count) -> None:
    for state in sample_states(JOINTS, RULES, Stream(seed, "s"), count):
        check_state(JOINTS, RULES, state)


@given(trees(), st.integers(0, 10**6))
def test_more_states_change_no_earlier_one(tree, seed) -> None:
    stream = Stream(seed, "s")
    few, many = sample_states(tree, (), stream, 2), sample_states(tree, (), stream, 5)
    assert many[:2] == few


def test_draws_cover_the_travel_and_leave_some_joints_closed() -> None:
    q = np.array([s["door"] for s in sample_states([DOOR, RACK], (), Stream(1), 2000)])
    # At rest with 15 %, less the 2.25 % where both would be: binomial sd 0.75 %, so 5 sd is 4 %.
    assert abs(np.mean(q == 0.0) - 0.1275) < 0.04
    moved = q[q > 0.0] / 1.5
    # Mean of 1700 uniform draws: sd 0.7 %.
    assert abs(moved.mean() - 0.5) < 0.035


def test_what_a_precondition_bars_moves_in_a_fair_share_of_states() -> None:
    """The rack draws open in 85 %, and half of the barred ways are cleared: at least 0.425 less 5
    binomial standard deviations of 1.1 %; left to chance it would be 0.85 * 0.85 * 0.1 / 1.5."""
    drawn = sample_states(JOINTS, RULES, Stream(2), 2000)
    assert np.mean([state["rack"] > 0.0 for state in drawn]) > 0.425 - 0.055


def test_a_lone_joint_moves_in_every_drawn_state() -> None:
    assert all(state["door"] > 0.0 for state in sample_states([DOOR], (), Stream(3), 500))


def test_a_barred_joint_goes_back_to_rest_along_the_whole_chain() -> None:
    wanted = {"door": 1.0, "rack": 0.4, "basket": 0.1}
    assert obeying(RULES, wanted) == {"door": 1.0, "rack": 0.0, "basket": 0.0}
    assert open_state(JOINTS, RULES) == {"door": 1.5, "rack": 0.5, "basket": 0.2}
    assert required_state("basket", RULES) == {"rack": 0.3, "door": 1.4}


def test_states_outside_limits_or_barred_are_named() -> None:
    with pytest.raises(KinematicError, match="joint door: q = 2"):
        check_state(JOINTS, RULES, {"door": 2.0})
    with pytest.raises(KinematicError, match=r"rack: q = 0.1 needs door >= 1.4, found 0.2"):
        check_state(JOINTS, RULES, {"door": 0.2, "rack": 0.1})


@given(st.floats(0, 1.5), st.floats(0, 0.5), st.floats(0.1, 3.0))
def test_targets_move_points_as_the_paper_says(turn, slide, radius) -> None:
    """Supplement S4, S5: x' = x + 2 r S D, and x' = O + R(D, 2 pi S)(x - O), about the center."""
    bounds = [np.array([[-0.3, -0.3, 0.0], [0.3, 0.3, 0.8]])] * 3
    center = np.array([0.0, 0.0, 0.4])
    made = targets(
        ["base", "door", "rack"], bounds, (DOOR, RACK), [{"door": turn, "rack": slide}],
        center=center, radius=max(radius, slide / 2),
    )  # fmt: skip
    assert made.type.tolist() == [0, REVOLUTE, PRISMATIC]
    assert made.parent.tolist() == [-1, 0, 0]
    point = np.array([0.1, -0.2, 0.3])
    s = made.motion[0]
    slid = point - center + 2 * max(radius, slide / 2) * s[2] * made.axis[2]
    assert_allclose(slid + center, apply(joint_motion(RACK, slide), point), atol=1e-14)
    origin = made.origin[1]
    turned = origin + axis_angle_matrix(made.axis[1], 2 * math.pi * s[1]) @ (
        point - center - origin
    )
    assert_allclose(turned + center, apply(joint_motion(DOOR, turn), point), atol=1e-14)


def test_motion_is_signed_and_bounded() -> None:
    assert motion(DOOR, math.pi / 2, 1.0) == 0.25
    assert motion(RACK, 0.5, 1.0) == 0.25
    assert motion(DOOR, -math.pi / 2, 1.0) == -0.25


def test_the_sphere_holds_the_open_object() -> None:
    bounds = [np.array([[-0.3, -0.3, 0.0], [0.3, 0.3, 0.8]])] * 3
    center, radius = swept_sphere(["base", "door", "rack"], bounds, (DOOR, RACK))
    assert_allclose(center, (0, 0, 0.4))
    corner = np.array([0.3, -0.3, 0.8])
    for joint, q in ((DOOR, 1.5), (DOOR, 0.75), (RACK, 0.5)):
        assert np.linalg.norm(apply(joint_motion(joint, q), corner) - center) <= radius + 1e-12
