"""Particulate's scores: punishment in closed form, distances against a plain implementation."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.core.mesh import TriMesh
from model.evaluation.particulate import in_cube, part_points, particulate
from model.evaluation.reshape import placed, taken
from tests.unit.model.evaluation.layouts import cabinet, with_box_meshes

POINTS = 600


def test_the_truth_is_perfect_up_to_its_own_samples() -> None:
    truth = with_box_meshes(cabinet())
    found = particulate(truth, truth, points=POINTS)
    assert found.rest_giou.punished == found.rest_giou.pairs == 1.0
    assert found.full_giou.punished == pytest.approx(1.0, abs=1e-9)  # Booleans of turned boxes.
    assert found.rest_pc is not None
    # Two samples of one surface: N points on an area A have neighbors within A / (pi N) in the
    # square, twice; parts have at most 6 in area and 600 / 3 points; ten times for the borders.
    assert 0.0 < found.rest_pc.punished < 10.0 * 2.0 * 6.0 / (np.pi * POINTS / 3)


def test_without_surfaces_there_are_no_distances() -> None:
    found = particulate(cabinet(), cabinet(), points=POINTS)
    assert found.rest_pc is found.rest_oc is None
    assert found.full_miou.punished == pytest.approx(1.0, abs=1e-12)


def test_surfaces_without_area_have_points_all_the_same() -> None:
    """Lines are what is left of a part that a system did not find."""
    line = TriMesh(vertices=np.eye(3)[:1] * [[0.0], [0.5], [1.0]], faces=[[0, 1, 2]])
    truth = with_box_meshes(cabinet())
    found = particulate(replace(truth, meshes=(line,) * 3), truth, points=POINTS)
    assert found.rest_pc is not None
    assert found.rest_pc.punished > 0.1


def test_a_missing_part_is_punished_in_one_direction() -> None:
    """Two of three parts: pred to GT has 1, 1; GT to pred has 1, 1, -1; the mean is 2/3."""
    truth = with_box_meshes(cabinet())
    fewer = taken(truth, [0, 1])
    found = particulate(fewer, truth, points=POINTS)
    assert found.rest_giou.punished == pytest.approx((1.0 + 1.0 / 3.0) / 2.0, abs=1e-12)
    assert found.rest_giou.pairs == 1.0
    assert found.rest_pc is not None
    assert found.rest_pc.pairs is not None
    cube, _ = in_cube(fewer, truth)
    back = (2.0 * found.rest_pc.pairs + cube.radius) / 3.0
    assert found.rest_pc.punished == pytest.approx((found.rest_pc.pairs + back) / 2.0, abs=1e-12)


def test_the_cube_is_that_of_the_truth() -> None:
    truth = cabinet()
    moved, cube = in_cube(placed(truth, shift=(0.11, 0.0, 0.0)), truth)
    assert np.abs(cube.bounds).max() == pytest.approx(0.5, abs=1e-15)
    # The longest side of the truth is 1.1: a shift of 0.11 becomes 0.1.
    assert (moved.bounds - cube.bounds)[:, 0].tolist() == pytest.approx([0.1, 0.1], abs=1e-15)


def test_distances_against_a_plain_implementation() -> None:
    truth = with_box_meshes(cabinet())
    guess = placed(truth, shift=(0.05, 0.02, -0.03))
    found = particulate(guess, truth, points=POINTS)
    rng = np.random.Generator(np.random.PCG64(9))
    mine, theirs = in_cube(guess, truth)
    clouds = [part_points(own, 4 * POINTS, rng) for own in (mine, theirs)]
    assert clouds[0] is not None
    assert clouds[1] is not None
    values = []
    for a, b in zip(*clouds, strict=True):
        squares = ((a[:, None] - b[None]) ** 2).sum(axis=2)
        values.append(squares.min(axis=1).mean() + squares.min(axis=0).mean())
    assert found.rest_pc is not None
    # Both carry sampling noise of A / (pi N): 6 / (3.14 * 200) = 0.01 for the coarser one at most.
    assert found.rest_pc.punished == pytest.approx(np.mean(values), abs=0.01)
    shift = np.array([0.05, 0.02, 0.03]) / 1.1
    sides = np.array([1.0, 1.0, 1.0]) / 1.1
    shared, both = np.prod(sides - shift), 2.0 * np.prod(sides)
    around = np.prod(sides + shift)
    base = shared / (both - shared) - (around - (both - shared)) / around
    assert found.rest_giou.pairs is not None
    assert found.rest_giou.pairs < base + 1e-12  # Smaller parts lose more by the same shift.
