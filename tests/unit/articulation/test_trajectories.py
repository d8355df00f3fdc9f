"""Trajectories start at rest, move smoothly, and hold limits, mimics and preconditions at all
times, not at frames alone."""

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.articulation.kinematics import resolved
from artgen.articulation.states import check_state, travel
from artgen.articulation.trajectories import (
    LEAST_MOVE,
    Track,
    eased,
    frame_times,
    tracks,
    trajectory_states,
)
from artgen.articulation.types import Joint, Limit, Precondition
from artgen.core.stream import Stream
from tests.made import CATEGORIES, drafted
from tests.strategies import hinge, trees

SEEDS = st.integers(0, 10**6)
FINE = frame_times(401)


@st.composite
def ruled_trees(draw: st.DrawFn) -> tuple[tuple[Joint, ...], tuple[Precondition, ...]]:
    """A tree, and preconditions among its free joints: chains, cycles, and impossible ones too."""
    tree = draw(trees(most=6))
    free = [joint for joint in tree if joint.mimic is None]
    rules = []
    for _ in range(draw(st.integers(0, 4))):
        one, other = draw(st.sampled_from(free)), draw(st.sampled_from(free))
        share = draw(st.one_of(st.just(1.0), st.floats(0.01, 1.1)))
        if one is not other:
            at_least = share * travel(other)[1]
            rules.append(Precondition(joint=one.name, requires=other.name, at_least=at_least))
    return tree, tuple(rules)


def all_times(moving: dict[str, Track]) -> list[float]:
    """Even times, and all knots with their neighbors among floats: where a rule would break."""
    knots = np.concatenate([track.times for track in moving.values()])
    near = [np.nextafter(knots, -1.0), knots, np.nextafter(knots, 2.0)]
    return [float(t) for t in np.concatenate([FINE, *near]) if 0.0 <= t <= 1.0]


def check(joints: Sequence[Joint], rules: Sequence[Precondition], seed: int) -> None:
    moving = tracks(joints, rules, Stream(seed))
    assert set(moving) == {joint.name for joint in joints if joint.mimic is None}
    for time in all_times(moving):
        state = {name: track.at(time) for name, track in moving.items()}
        check_state(joints, rules, state)
        check_state(joints, (), resolved(joints, state))


@given(ruled_trees(), SEEDS)
def test_limits_mimics_and_preconditions_hold_at_all_times(ruled, seed) -> None:
    check(*ruled, seed)


@pytest.mark.parametrize("category", CATEGORIES)
@pytest.mark.parametrize("index", range(3))
def test_every_category_moves_all_its_joints_and_obeys_them(category: str, index: int) -> None:
    draft = drafted(category, index)
    for seed in range(20):
        check(draft.joints, draft.preconditions, seed)
        states = trajectory_states(draft.joints, draft.preconditions, Stream(seed), frame_times(16))
        for joint in draft.joints:
            if joint.mimic is None:
                assert max(abs(state[joint.name]) for state in states) > 0.0


def slide(name: str) -> Joint:
    return hinge(
        name, "base", name, type="prismatic", axis=(0.0, -1.0, 0.0), limit=Limit(lower=0, upper=0.5)
    )


DOOR, RACK, BASKET = hinge("door", "base", "door"), slide("rack"), slide("basket")
RULES = (
    Precondition(joint="basket", requires="rack", at_least=0.3),
    Precondition(joint="rack", requires="door", at_least=1.4),
)


@pytest.mark.parametrize("seed", range(40))
def test_a_chain_of_doors_opens_one_after_the_other(seed: int) -> None:
    """Every joint covers at least the share of its travel that it must at the finest times."""
    joints = (DOOR, RACK, BASKET)
    check(joints, RULES, seed)
    states = trajectory_states(joints, RULES, Stream(seed), FINE)
    for joint in joints:
        farthest = max(state[joint.name] for state in states)
        assert farthest >= (LEAST_MOVE - 0.02) * travel(joint)[1]
    first = {
        joint.name: next(k for k, state in enumerate(states) if state[joint.name] > 0.0)
        for joint in joints
    }
    assert first["door"] < first["rack"] < first["basket"]


@given(ruled_trees(), SEEDS)
def test_it_starts_at_rest_and_more_frames_are_of_the_same_motion(ruled, seed) -> None:
    states = trajectory_states(*ruled, Stream(seed), frame_times(5))
    assert not any(states[0].values())
    assert trajectory_states(*ruled, Stream(seed), frame_times(9))[::2] == states


@given(trees(), SEEDS)
def test_every_joint_that_has_room_moves(tree, seed) -> None:
    """A follower may leave its leader no room at all, or less than its own travel."""
    moving = tracks(tree, (), Stream(seed))
    led = {joint.mimic.joint for joint in tree if joint.mimic is not None}
    for joint in tree:
        if joint.mimic is None and joint.name not in led:
            lower, upper = travel(joint)
            values = moving[joint.name].values
            # 1 ulp of the largest value for the sum in which the far value is drawn.
            assert np.abs(values).max() >= LEAST_MOVE * (upper - lower) * (1 - 1e-14)


def test_what_can_never_move_stays_at_rest() -> None:
    """The rack asks for more than the door's travel, the basket for the rack."""
    rules = (RULES[0], Precondition(joint="rack", requires="door", at_least=2.0))
    moving = tracks((DOOR, RACK, BASKET), rules, Stream(0))
    assert moving["door"].values.any()
    assert not moving["rack"].values.any()
    assert not moving["basket"].values.any()


def test_ease_has_no_speed_or_acceleration_at_its_ends() -> None:
    """s(u) = 10 u^3 - 15 u^4 + 6 u^5: cubic contact at both ends, so s(h) <= 10 h^3; monotone."""
    step = 1e-3
    assert eased(0.0) == 0.0
    assert eased(1.0) == 1.0
    assert 0.0 < eased(step) <= 10 * step**3
    assert 0.0 < 1.0 - eased(1.0 - step) <= 10 * step**3 + 1e-15
    assert (np.diff([eased(u) for u in np.linspace(0, 1, 1001)]) >= -1e-15).all()


@given(ruled_trees(), SEEDS)
def test_motion_is_smooth(ruled, seed) -> None:
    """The quintic's steepest slope is 15/8: between two times of one ease q changes by at most
    15/8 of its rise times their share of it, and over a knot by the sum of both sides."""
    for track in tracks(*ruled, Stream(seed)).values():
        if len(track.times) == 1:
            continue
        widths, rises = np.diff(track.times), np.abs(np.diff(track.values))
        with np.errstate(divide="ignore", invalid="ignore"):
            steepest = np.nanmax(np.where(widths > 0, 15 / 8 * rises / widths, 0.0))
        q = np.array([track.at(time) for time in FINE])
        assert np.abs(np.diff(q)).max() <= steepest / 400 * (1 + 1e-9) + 1e-12
