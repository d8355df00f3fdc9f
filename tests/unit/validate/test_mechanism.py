"""Hinges by their boxes: how far a pivot lies from the edge that a leaf turns about."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.mesh import Floats
from artgen.validate.mechanism import end_distance

DOOR: Floats = np.array([(0.0, -0.10, 0.0), (0.6, 0.02, 0.9)])
"""A leaf 0.6 m wide whose handle and bins make it 0.12 m thick, hung along z."""
UPRIGHT: Floats = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("pivot", "expected"),
    [
        ((0.0, 0.0, 0.4), 0.0),  # On the edge, within the thickness.
        ((0.6, -0.05, 0.0), 0.0),  # On the other one.
        ((0.03, 0.0, 0.0), 0.03),  # In from it.
        ((0.0, 0.05, 0.0), 0.03),  # Behind the leaf.
        ((-0.03, 0.06, 0.0), 0.05),  # Beside and behind: 3, 4, 5.
        ((0.3, 0.0, 0.0), 0.3),  # A revolving door is not hung on an edge.
    ],
)
def test_the_edge_lies_at_the_nearer_end_of_the_longer_side(
    pivot: tuple[float, float, float], expected: float
) -> None:
    found = end_distance(DOOR, UPRIGHT, np.array(pivot))
    assert found == pytest.approx(expected, abs=1e-15)


@given(along=st.floats(-5.0, 5.0), sign=st.sampled_from([-1.0, 1.0]))
def test_a_line_has_no_place_along_itself_and_no_sense(along: float, sign: float) -> None:
    moved = np.array([0.1, -0.3, along])
    assert end_distance(DOOR, sign * UPRIGHT, moved) == end_distance(
        DOOR, UPRIGHT, np.array([0.1, -0.3, 0.0])
    )


def test_a_slanted_axis_has_no_edge() -> None:
    assert end_distance(DOOR, np.array([0.0, 0.6, 0.8]), np.zeros(3)) is None
