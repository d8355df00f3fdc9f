"""Cameras project as OpenCV's do, and frame what they are asked to frame."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.camera import CLEARANCE, Camera, framed, orbit_direction
from artgen.core.transform import look_at

CLOUDS = st.lists(
    st.tuples(*[st.floats(-2.0, 2.0)] * 3), min_size=4, max_size=30, unique=True
).filter(lambda points: np.ptp(np.array(points), axis=0).min() > 1e-3)
ANGLES = st.tuples(st.floats(-math.pi, math.pi), st.floats(-1.2, 1.2))


@given(
    CLOUDS, ANGLES, st.floats(0.2, 1.2), st.floats(0.5, 1.0), st.sampled_from([(64, 64), (96, 48)])
)
@settings(deadline=None)
def test_a_framed_cloud_lies_within_its_share_of_the_image_and_reaches_it(
    points: list, angles: tuple, fov: float, fill: float, size: tuple
) -> None:
    """Projection of values around 1 m at 50 px a meter costs about 1e-13 px; 1e-6 is generous but
    far below what a wrong formula does."""
    camera = framed(points, direction=orbit_direction(*angles), fov=fov, size=size, fill=fill)
    pixels = camera.project(points)
    nearest = CLEARANCE * np.ptp(np.array(points), axis=0).max()
    assert pixels[:, 2].min() >= nearest - 1e-9
    reach = np.abs(pixels[:, :2] - np.array(size) / 2) / (np.array(size) / 2)
    assert reach.max() <= fill + 1e-6
    if pixels[:, 2].min() > nearest + 1e-9:
        assert reach.max() == pytest.approx(fill, abs=1e-6)


def test_axes_are_opencv() -> None:
    """Seen from the front, +x is to the right and +z is up, so pixel y falls."""
    camera = framed(
        list(itertools.product((-1, 1), repeat=3)),
        direction=orbit_direction(0.0, 0.0),
        fov=0.7,
        size=(100, 100),
        fill=0.9,
    )
    (x0, y0, near), (x1, y1, far) = camera.project([[0.5, -1, 0.25], [0, 1, 0]])
    assert x0 > x1 == pytest.approx(50)
    assert y0 < y1 == pytest.approx(50)
    assert near < far


@given(ANGLES, st.integers(8, 40), st.integers(8, 40))
@settings(deadline=None)
def test_rays_go_through_the_pixels_they_belong_to(angles: tuple, width: int, height: int) -> None:
    camera = framed(
        [[-0.3, -0.2, 0], [0.4, 0.1, 0.9]],
        direction=orbit_direction(*angles),
        fov=0.6,
        size=(width, height),
        fill=0.9,
    )
    eye, rays = camera.rays()
    pixels = camera.project(eye + 2.5 * rays)
    row, column = np.mgrid[0:height, 0:width]
    expected = np.stack([column + 0.5, row + 0.5, np.full_like(row, 2.5, float)], axis=-1)
    np.testing.assert_allclose(pixels, expected, rtol=0, atol=1e-9)


def test_intrinsics_state_the_same_projection() -> None:
    camera = framed(
        [[-1, -1, 0], [1, 1, 2]],
        direction=orbit_direction(0.4, 0.3),
        fov=0.6,
        size=(64, 48),
        fill=0.8,
    )
    point = np.array([0.2, -0.4, 1.1])
    local = camera.camera_from_world @ [*point, 1.0]
    homogeneous = camera.intrinsics @ local[:3]
    x, y, _ = camera.project(point)
    np.testing.assert_allclose(homogeneous[:2] / homogeneous[2], (x, y), rtol=0, atol=1e-11)


def test_a_stated_camera_has_the_same_numbers() -> None:
    camera = Camera(focal=80.0, size=(64, 48), camera_from_world=np.eye(4), principal=(30.0, 25.5))
    stated = camera.stated
    assert (stated.focal, stated.size, stated.principal) == (80.0, (64, 48), (30.0, 25.5))
    assert np.array_equal(stated.camera_from_world, camera.camera_from_world)


@given(CLOUDS, ANGLES, st.floats(0.2, 1.2), st.floats(-3, 3), st.floats(-3, 3))
def test_an_offset_principal_point_leaves_the_cloud_in_the_middle(points, angles, fov, x, y):
    """Even where the optical axis meets the image plane outside the image, as after cropping: the
    borders hold the cloud back equally, along the axis that decides the distance as along the
    other. 1e-6 px as above."""
    size = (96, 48)
    principal = (48 + x * 48, 24 + y * 24)
    camera = framed(
        points, direction=orbit_direction(*angles), fov=fov, size=size, fill=0.9,
        principal=principal,
    )  # fmt: skip
    pixels = camera.project(points)[:, :2]
    assert camera.center == principal
    reach = np.stack([pixels.min(axis=0), np.array(size) - pixels.max(axis=0)])
    assert reach.min() >= 0.05 * 48 / 2 - 1e-6


@pytest.mark.parametrize("height", [1.0, -1.0])
def test_a_vertical_view_is_the_front_view_raised_until_it_is_vertical(height: float) -> None:
    """An eye 1e-6 rad off the vertical, on the front's side, is turned by 1e-6 against it."""
    vertical = look_at((0.0, 0.0, height), (0.0, 0.0, 0.0))[:3, :3]
    nearly = look_at((0.0, -1e-6, height), (0.0, 0.0, 0.0))[:3, :3]
    np.testing.assert_allclose(vertical, nearly, rtol=0, atol=1.1e-6)
    np.testing.assert_array_equal(vertical[:, 0], (1, 0, 0))
    inside = look_at((1e-11, 1e-11, height), (0.0, 0.0, 0.0))[:3, :3]
    np.testing.assert_allclose(inside.T @ inside, np.eye(3), rtol=0, atol=1e-15)
    assert np.linalg.det(inside) > 0


@given(st.floats(-math.pi, math.pi), st.floats(-1.5, 1.5), st.floats(-1e-4, 1e-4))
def test_views_turn_continuously_away_from_the_pole(azimuth, elevation, change):
    """Turning about the vertical by d turns the camera by d, raising it by d too: the Frobenius
    norm of a turn by d is at most sqrt(2) d."""
    eyes = [
        orbit_direction(azimuth, elevation),
        orbit_direction(azimuth + change, elevation),
        orbit_direction(azimuth, elevation + change),
    ]
    still, turned, raised = (look_at(eye, (0.0, 0.0, 0.0))[:3, :3] for eye in eyes)
    for other in (turned, raised):
        assert np.linalg.norm(other - still) <= math.sqrt(2) * abs(change) + 1e-14
