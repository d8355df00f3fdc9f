"""Centers in the observed states, by closed form and against another rest."""

import math

import numpy as np
import pytest

from model.evaluation.matching import by_order
from model.evaluation.observed import state_centers
from model.evaluation.reshape import rebased, taken
from tests.unit.model.evaluation.layouts import cabinet

ORDER = by_order(3, 3)


def test_a_wrong_angle_moves_the_center_along_its_chord() -> None:
    """The door's middle lies at (0.5, -0.05) about its hinge; the drawer is right, as is rest."""
    truth = cabinet()
    guess = cabinet(states=np.array([(0.0, 0.0, 0.0), (0.0, 0.25, 1.2)]))
    chord = 2.0 * math.hypot(0.5, 0.05) * math.sin(0.1)
    assert state_centers(guess, truth, ORDER) == pytest.approx(chord / 4.0, abs=1e-12)


def test_what_is_taken_for_rest_does_not_matter() -> None:
    """Boxes around turned boxes have the same middles, whatever their size."""
    truth = cabinet()
    guess = cabinet(states=np.array([(0.0, 0.0, 0.3), (0.0, 0.2, 1.2)]))
    found = state_centers(guess, truth, ORDER)
    assert found is not None
    for state in (0, 1):
        again = state_centers(rebased(guess, state), rebased(truth, state), ORDER)
        assert again == pytest.approx(found, abs=1e-12)


def test_a_missing_part_counts_a_radius() -> None:
    truth = cabinet()
    found = state_centers(taken(truth, [0, 1]), truth, by_order(2, 3))
    assert found == pytest.approx(truth.radius / 2.0, abs=1e-12)


def test_without_states_or_joints_there_is_nothing_to_ask() -> None:
    truth = cabinet()
    assert state_centers(cabinet(states=None), truth, ORDER) is None
    assert state_centers(cabinet(states=np.zeros((1, 3))), truth, ORDER) is None
    assert state_centers(truth, taken(truth, [0]), by_order(3, 1)) is None
