"""SINGAPO's dCD: zero up to samples for the truth, closed form for a shift, null without meshes."""

import math

import numpy as np
import pytest

from model.evaluation.reshape import stretched
from model.evaluation.singapo_surfaces import POINTS, published_chamfers
from tests.unit.model.evaluation.layouts import cabinet, with_box_meshes


def floor() -> float:
    """Two samples of areas 6, 3 and 4 at most: A / (pi N) both ways, mean over three parts."""
    return 2.0 * 13.0 / 3.0 / (math.pi * POINTS)


def test_the_truth_and_its_stretched_copy_are_as_near_as_samples() -> None:
    truth = with_box_meshes(cabinet())
    for guess in (truth, stretched(truth, (2.0, 1.0, 1.0))):
        rest, states = published_chamfers(guess, truth)
        assert rest is not None
        assert states is not None
        assert 0.0 < rest < 1.5 * floor()
        assert 0.0 < states < 1.5 * floor()


def test_a_drawer_that_comes_out_half_as_far() -> None:
    """A shift by s of a closed box along its depth d: front and back faces of area f are s away,
    the sides are partly covered; so the distance is between 2 s^2 2 f / A and 2 s^2."""
    truth = with_box_meshes(cabinet())
    half = with_box_meshes(cabinet(limits=np.array([(0.0, 0.0), (0.0, 0.25), (0.0, 1.5)])))
    rest, states = published_chamfers(half, truth)
    assert rest == pytest.approx(published_chamfers(truth, truth)[0], rel=0.2)
    shifts = 0.25 * np.linspace(0.0, 1.0, 5)
    sides = np.array([0.8, 0.9, 0.4])
    front = 2.0 * sides[0] * sides[2]
    area = front + 2.0 * sides[1] * (sides[0] + sides[2])
    most = float(np.mean(2.0 * shifts**2)) / 3.0
    assert states is not None
    assert 0.5 * most * front / area < states < most + 1.5 * floor()


def test_without_surfaces_there_is_none() -> None:
    assert published_chamfers(cabinet(), cabinet()) == (None, None)
