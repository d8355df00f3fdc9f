"""PARIS, DTA and ArtGS: the parallel case of both, motions, Chamfer units."""

import math

import numpy as np
import pytest

from model.evaluation.matching import by_order
from model.evaluation.paris import ParisScores, paris
from model.evaluation.reshape import placed
from tests.unit.model.evaluation.layouts import cabinet, with_box_meshes


def scores(**changes: object) -> ParisScores:
    return paris(cabinet(**changes), cabinet(), by_order(3, 3))


def test_a_parallel_axis_counts_as_equal_in_paris_alone() -> None:
    found = scores(origins=np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.3, 0.4, 0.0)]))
    assert found.position == pytest.approx(5.0, abs=1e-14)
    assert found.position_paris == 0.0


def test_motions_from_first_to_last_state() -> None:
    states = np.array([(0.0, 0.1, 0.2), (0.0, 0.25, 1.0)])
    found = scores(states=states)
    assert found.motion_deg == pytest.approx(math.degrees(0.2), abs=1e-13)
    assert found.motion_length == pytest.approx(0.1, abs=1e-15)


def test_a_turn_of_pi_is_the_farthest() -> None:
    found = scores(states=np.array([(0.0, 0.0, 0.0), (0.0, 0.25, 1.0 + math.pi)]))
    # asin near 1 turns a rounding of 1e-16 into sqrt(2e-16) rad, twice.
    assert found.motion_deg == pytest.approx(180.0, abs=2e-6)


def test_the_sign_of_an_axis_does_not_matter() -> None:
    found = scores(axes=np.array([(0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]))
    assert found.axis_deg == 0.0


def test_chamfer_distances_are_in_thousandths_and_nothing_is_aligned() -> None:
    truth = with_box_meshes(cabinet())
    found = paris(placed(truth, shift=(0.0, 0.0, 10.0)), truth, by_order(3, 3))
    # Far away every nearest point is at about 10: squared, both ways, in thousandths. The object
    # is 1 high, so between 9 and 11.
    assert found.cd_whole is not None
    assert 2e3 * 81.0 < found.cd_whole < 2e3 * 121.0
    assert paris(truth, truth, by_order(3, 3)).cd_static == pytest.approx(
        1000.0 * 2.0 * 6.0 / (math.pi * 10_000.0), rel=0.1
    )  # Mean squared neighbor distance A / (pi N) of 10,000 samples on an area of 6, twice.
    assert scores().cd_whole is None


def test_a_line_without_a_point_leaves_the_others() -> None:
    hinges = cabinet(types=np.array([0, 1, 1]), states=None)
    origins = np.array([(0.0, 0.0, 0.0), (np.nan, 0.0, 0.0), (0.0, 0.3, 0.0)])
    guess = cabinet(types=hinges.types, origins=origins, states=None)
    assert paris(guess, hinges, by_order(3, 3)).position == pytest.approx(3.0, abs=1e-14)
