"""Volumes of boxes against closed forms, polygon clipping and counting."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import apply, inverted, rigid
from model.evaluation.boxes import (
    giou_moved,
    giou_upright,
    iou,
    moved_bounds,
    shared_moved,
    shared_sampled,
    shared_upright,
    volume,
)

UNIT = np.array([(0.0, 0.0, 0.0), (1.0, 1.0, 1.0)])
CENTERED = UNIT - 0.5
coordinate = st.floats(-2.0, 2.0)
size = st.floats(0.05, 2.0)


@st.composite
def box(draw: st.DrawFn) -> np.ndarray:
    lower = np.array([draw(coordinate) for _ in range(3)])
    return np.stack([lower, lower + [draw(size) for _ in range(3)]])


def turn_z(angle: float) -> np.ndarray:
    return rigid(axis_angle_matrix((0.0, 0.0, 1.0), angle), (0.0, 0.0, 0.0))


def clipped_area(first: np.ndarray, second: np.ndarray) -> float:
    """Area that two convex counter-clockwise polygons share (Sutherland and Hodgman 1974)."""
    points = [tuple(p) for p in first]
    for a, b in zip(second, np.roll(second, -1, axis=0), strict=True):
        sides = [(b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) for p in points]
        kept = []
        for k, (p, side) in enumerate(zip(points, sides, strict=True)):
            q, other = points[k - 1], sides[k - 1]
            if side * other < 0.0:
                t = other / (other - side)
                kept.append((q[0] + t * (p[0] - q[0]), q[1] + t * (p[1] - q[1])))
            if side >= 0.0:
                kept.append(p)
        points = kept
    x, y = np.array(points).reshape(-1, 2).T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0)


def test_cubes_apart_have_the_gap_as_generalized_iou() -> None:
    """Unit cubes with a gap d along x lie in a box of 2 + d, of which d is empty."""
    for gap in (0.25, 1.0, 3.0):
        found = giou_upright(UNIT, UNIT + np.array([1.0 + gap, 0.0, 0.0]))
        assert found == pytest.approx(
            -gap / (2.0 + gap), abs=4e-16
        )  # Two roundings of numbers < 1.


def test_half_a_cube_is_half() -> None:
    half = UNIT * (0.5, 1.0, 1.0)
    assert giou_upright(UNIT, half) == 0.5
    assert iou(1.0, 0.5, shared_upright(UNIT, half)) == 0.5


def test_equal_flat_boxes_agree() -> None:
    flat = UNIT * (1.0, 1.0, 0.0)
    assert giou_upright(flat, flat) == 1.0
    assert giou_moved(flat, flat, np.eye(4), np.eye(4)) == 1.0
    assert shared_moved(flat, UNIT, turn_z(0.3)) == 0.0


def test_a_cube_turned_by_45_degrees_shares_an_octagon() -> None:
    """The octagon in a unit square has the area 2 (sqrt 2 - 1)."""
    found = shared_moved(CENTERED, CENTERED, turn_z(math.pi / 4.0))
    assert found == pytest.approx(
        2.0 * (math.sqrt(2.0) - 1.0), abs=1e-12
    )  # Boolean: ~100 roundings.


@given(box(), box(), st.floats(-math.pi, math.pi), st.tuples(coordinate, coordinate, coordinate))
def test_turned_about_z_it_is_a_clipped_polygon_times_a_height(
    first: np.ndarray, second: np.ndarray, angle: float, shift: tuple[float, float, float]
) -> None:
    pose = turn_z(angle)
    pose[:3, 3] = shift
    plan = apply(
        pose, [(*second[i, :1], second[j, 1], 0.0) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    )
    square = [(first[i, 0], first[j, 1]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    low, high = (max if k == 0 else min for k in (0, 1))
    height = high(first[1, 2], second[1, 2] + shift[2]) - low(first[0, 2], second[0, 2] + shift[2])
    expected = clipped_area(plan[:, :2], np.array(square)) * max(height, 0.0)
    # manifold3d merges vertices nearer than about 1e-12 of the size; a sliver that it drops has at
    # most that width on faces below 10 m2.
    assert shared_moved(first, second, pose) == pytest.approx(expected, abs=1e-10)


@given(box(), box(), st.floats(-math.pi, math.pi), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_counting_agrees_with_exact_volumes(
    first: np.ndarray, second: np.ndarray, angle: float, x: float, y: float
) -> None:
    """A share p of N points in a box V has the deviation V sqrt(p (1 - p) / N) <= V / 2 sqrt N; the
    mean of both directions at most half their sum; six of them are beyond chance."""
    axis = np.array([x, y, 1.0]) / math.sqrt(1.0 + x * x + y * y)
    pose = rigid(axis_angle_matrix(tuple(axis), angle), second.mean(axis=0) * 0.1)
    count = 2000
    found = shared_sampled(
        first, second, pose, np.random.Generator(np.random.PCG64(1)), count=count
    )
    bound = 6.0 * (volume(first) + volume(second)) / (4.0 * math.sqrt(count))
    assert abs(found - shared_moved(first, second, pose)) <= bound


@given(box(), box(), st.floats(-3.0, 3.0), st.tuples(coordinate, coordinate, coordinate))
def test_generalized_iou_is_bounded_symmetric_and_keeps_when_both_move(
    first: np.ndarray, second: np.ndarray, angle: float, shift: tuple[float, float, float]
) -> None:
    one, other = turn_z(angle), rigid(np.eye(3), shift)
    found = giou_moved(first, second, one, other)
    # The empty share of C is less than 1; equal boxes reach 1 up to the roundings of a boolean.
    assert -1.0 <= found <= 1.0 + 1e-9
    assert giou_moved(second, first, other, one) == pytest.approx(found, abs=1e-9)
    quarter = turn_z(math.pi / 2.0)  # Keeps upright boxes upright, so that C turns along.
    assert giou_moved(first, second, quarter @ one, quarter @ other) == pytest.approx(
        found, abs=1e-9
    )


def test_moved_bounds_hold_every_corner() -> None:
    pose = turn_z(0.7)
    lower, upper = moved_bounds(UNIT, pose)
    assert lower[0] == pytest.approx(-math.sin(0.7), abs=1e-15)
    assert upper[1] == pytest.approx(math.sin(0.7) + math.cos(0.7), abs=1e-15)
    assert np.allclose(moved_bounds(UNIT, inverted(pose) @ pose), UNIT, rtol=0.0, atol=1e-15)
