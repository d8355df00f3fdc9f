"""Distances between surfaces against closed forms and a plain double loop."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.geometry.solid import slab
from model.evaluation.surfaces import (
    THRESHOLDS,
    Cloud,
    chamfer_squared,
    compared,
    sampled,
)

clouds = st.lists(st.tuples(*[st.floats(-1.0, 1.0)] * 3), min_size=1, max_size=12).map(np.array)


def rng(seed: int = 0) -> np.random.Generator:
    return np.random.Generator(np.random.PCG64(seed))


def square(z: float) -> np.ndarray:
    a, b, c, d = (0.0, 0.0, z), (1.0, 0.0, z), (1.0, 1.0, z), (0.0, 1.0, z)
    return np.array([(a, b, c), (a, c, d)])


@given(clouds, clouds)
def test_chamfer_is_what_a_double_loop_says(first: np.ndarray, second: np.ndarray) -> None:
    gaps = [[math.dist(p, q) for q in second] for p in first]
    there = [min(row) for row in gaps]
    back = [min(column) for column in zip(*gaps, strict=True)]
    squares = sum(g * g for g in there) / len(there) + sum(g * g for g in back) / len(back)
    # Sums of 12 numbers below 12 in another order.
    assert chamfer_squared(first, second) == pytest.approx(squares, abs=1e-13)
    normals = np.tile((0.0, 0.0, 1.0), (12, 1))
    found = compared(Cloud(first, normals[: len(first)]), Cloud(second, normals[: len(second)]))
    assert found.chamfer_squared == pytest.approx(squares, abs=1e-13)
    assert found.accuracy == pytest.approx(sum(there) / len(there), abs=1e-13)
    assert found.completeness == pytest.approx(sum(back) / len(back), abs=1e-13)
    assert found.chamfer_l1 == pytest.approx(found.accuracy + found.completeness, abs=1e-13)
    for limit, score in zip(THRESHOLDS, found.f_scores, strict=True):
        p = sum(g < limit for g in there) / len(there)
        r = sum(g < limit for g in back) / len(back)
        assert score == pytest.approx(2 * p * r / (p + r) if p + r else 0.0, abs=1e-15)


def test_parallel_squares_are_their_gap_apart() -> None:
    """A gap of 0.03 is beyond the thresholds 0.01 and 0.02 and within 0.05; nearest points lie
    aside by the spacing of samples, 0.5 / sqrt(N) on average."""
    count, gap = 20_000, 0.03
    found = compared(sampled(square(0.0), count, rng(1)), sampled(square(gap), count, rng(2)))
    aside = 1.0 / (math.pi * count)  # Mean squared distance to the nearest of N in a unit square.
    expected = 2.0 * (gap * gap + aside)
    # Borders see half as many neighbors: on 2 / sqrt(N) of the area up to four times the square.
    assert found.chamfer_squared == pytest.approx(expected, abs=2.0 * aside)
    assert 2.0 * gap <= found.chamfer_l1 <= 2.0 * math.sqrt(gap * gap + 2.0 * aside)
    assert found.f_scores == (0.0, 0.0, 1.0)
    assert found.normals == pytest.approx(1.0, abs=1e-15)
    assert found.accuracy == pytest.approx(found.completeness, rel=0.05)


def test_samples_fall_by_area() -> None:
    """Of a 1 x 2 x 3 box 2 (2 + 3 + 6) = 22, the top has 2; deviations sqrt(p (1 - p) / N), six."""
    box = slab(np.zeros(3), np.array([1.0, 2.0, 3.0])).trimesh()
    count = 10_000
    cloud = sampled(box.triangles, count, rng())
    share = float((cloud.points[:, 2] > 3.0 - 1e-12).mean())
    assert share == pytest.approx(2.0 / 22.0, abs=6.0 * math.sqrt(0.09 * 0.91 / count))
    on_top = cloud.points[:, 2] > 3.0 - 1e-12
    assert np.array_equal(cloud.normals[on_top], np.tile((0.0, 0.0, 1.0), (on_top.sum(), 1)))
    spread = cloud.points[on_top][:, 0]
    assert float(spread.mean()) == pytest.approx(0.5, abs=6.0 / math.sqrt(12.0 * on_top.sum()))


def test_right_angles_between_normals_count_nothing() -> None:
    points = rng().random((10, 3))
    up, aside = np.tile((0.0, 0.0, 1.0), (10, 1)), np.tile((1.0, 0.0, 0.0), (10, 1))
    assert compared(Cloud(points, up), Cloud(points, aside)).normals == 0.0
    assert compared(Cloud(points, up), Cloud(points, -up)).normals == 1.0
