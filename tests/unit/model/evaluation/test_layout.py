"""Layouts: poses, shares of the way, and what is refused."""

import math

import numpy as np
import pytest

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from artgen.core.errors import ModelError
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import apply
from model.evaluation.layout import unit_axes
from model.evaluation.reshape import placed, rebased, stretched, taken, turned, without
from tests.unit.model.evaluation.layouts import cabinet


def test_poses_follow_the_tree_whatever_its_order() -> None:
    """A knob on the door turns with it, though it is listed before the door."""
    chain = cabinet(parents=np.array([-1, 2, 0]))
    knob = chain.poses((0.0, 0.2, math.pi / 2.0))[1]
    moved = apply(knob, (0.0, -1.0, 0.0))
    # Out by 0.2 to (0, -1.2, 0), then a quarter turn about -z: (x, y) to (y, -x).
    assert np.allclose(moved, (-1.2, 0.0, 0.0), rtol=0.0, atol=1e-15)


def test_the_far_end_is_the_farther_one() -> None:
    limits = np.array([(0.0, 0.0), (-0.7, 0.5), (0.0, 1.5)])
    assert cabinet(limits=limits).opened(0.5).tolist() == [0.0, -0.35, 0.75]
    endless = cabinet(endless=np.array([False, False, True]))
    assert endless.opened(1.0)[2] == 2.0 * math.pi


def test_an_unknown_axis_does_not_move() -> None:
    axes = unit_axes(
        [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 2.0)], [FIXED, PRISMATIC, REVOLUTE]
    )
    assert np.isnan(axes[1]).all()
    assert axes[2].tolist() == [0.0, 0.0, 1.0]
    assert np.array_equal(cabinet(axes=axes).poses((0.0, 0.3, 0.0))[1], np.eye(4))


@pytest.mark.parametrize("key", ["boxes", "origins", "limits", "states"])
@pytest.mark.parametrize("value", [2e12, -2e12, math.inf])
def test_numbers_beyond_all_objects_are_refused(key: str, value: float) -> None:
    """Their squares and cubes would overflow into metrics that are left out."""
    values = getattr(cabinet(), key).copy()
    values[-1, -1] = value
    with pytest.raises(ModelError, match=r"not finite|at most 1e\+12"):
        cabinet(**{key: values})


def test_placed_moves_as_before() -> None:
    """To scale and then to move is to move by scaled travels and then to scale."""
    layout, q = cabinet(), np.array([0.0, 0.3, 0.9])
    grown = placed(layout, scale=2.0, shift=(1.0, 2.0, 3.0))
    point = np.array([0.2, 0.3, 0.4])
    for part, factor in ((1, 2.0), (2, 1.0)):
        before = 2.0 * apply(layout.poses(q)[part], point) + (1.0, 2.0, 3.0)
        after = apply(grown.poses(q * factor)[part], 2.0 * point + (1.0, 2.0, 3.0))
        assert np.allclose(before, after, rtol=0.0, atol=4e-15)  # Ten roundings of numbers below 8.
    assert grown.limits.tolist() == [[0.0, 0.0], [0.0, 1.0], [0.0, 1.5]]
    assert grown.states is not None
    assert grown.states[1].tolist() == [0.0, 0.5, 1.0]


def test_stretching_keeps_ranges_and_directions() -> None:
    wide = stretched(cabinet(), (2.0, 1.0, 1.0))
    assert wide.bounds[1, 0] == 2.0
    assert np.array_equal(wide.limits, cabinet().limits)
    assert np.array_equal(wide.axes, cabinet().axes)


def test_turning_turns_what_poses_do() -> None:
    quarter = np.round(axis_angle_matrix((0.0, 0.0, 1.0), math.pi / 2.0))
    layout, q = cabinet(), np.array([0.0, 0.3, 0.9])
    other = turned(layout, quarter)
    point = np.array([0.2, 0.3, 0.4])
    for part in (1, 2):
        moved = quarter @ apply(layout.poses(q)[part], point)
        assert np.allclose(
            moved, apply(other.poses(q)[part], quarter @ point), rtol=0.0, atol=1e-15
        )
    assert (other.boxes[:, 1] >= other.boxes[:, 0]).all()


def test_what_hung_on_a_dropped_part_hangs_above_it() -> None:
    layout = cabinet(labels=("base", "handle", "door"), parents=np.array([-1, 0, 1]))
    left = without(layout, lambda label: label == "handle")
    assert left.labels == ("base", "door")
    assert left.parents.tolist() == [-1, 0]
    assert taken(layout, [0, 2]).limits.tolist() == [[0.0, 0.0], [0.0, 1.5]]


@pytest.mark.parametrize("parents", [(-1, 0, 0), (-1, 2, 0)])
def test_another_rest_is_the_same_object(parents: tuple[int, ...]) -> None:
    """What moves a point from rest to a state, moves it by way of the new rest."""
    layout = cabinet(parents=np.array(parents), states=np.array([(0.0, 0.2, 0.7), (0.0, 0.4, 1.1)]))
    assert layout.states is not None
    other = rebased(layout, 0)
    assert other.states is not None
    point = np.array([0.2, 0.3, 0.4])
    for part in range(3):
        at_new_rest = apply(layout.poses(layout.states[0])[part], point)
        by_way = apply(other.poses(other.states[1])[part], at_new_rest)
        straight = apply(layout.poses(layout.states[1])[part], point)
        assert np.allclose(by_way, straight, rtol=0.0, atol=4e-16 * 10)  # Ten roundings below 2.
    assert other.limits[2].tolist() == pytest.approx([-0.7, 0.8], abs=1e-15)
    with pytest.raises(ModelError, match="no state 2"):
        rebased(layout, 2)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"parents": np.array([-1, 2, 1])}, "circle"),
        ({"parents": np.array([0, 0, 0])}, "expected -1"),
        ({"boxes": np.zeros((2, 2, 3))}, "shape"),
        ({"boxes": np.full((3, 2, 3), np.nan)}, "not finite"),
        ({"states": np.zeros((0, 3))}, "states has shape"),
    ],
)
def test_what_cannot_be_is_refused(changes: dict[str, object], said: str) -> None:
    with pytest.raises(ModelError, match=said):
        cabinet(**changes)
