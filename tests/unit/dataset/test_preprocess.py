"""The square crop moves pixels and cameras alike."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from artgen.core.camera import framed, orbit_direction
from artgen.core.errors import ShardError
from artgen.dataset.preprocess import (
    Window,
    foreground_window,
    resampled,
    square_view,
    window_intrinsics,
)

WINDOWS = st.builds(
    Window, left=st.floats(-40, 80), top=st.floats(-40, 80), side=st.floats(1.0, 200.0)
)
INTRINSICS = np.array([[140.0, 0.3, 61.0], [0.0, 150.0, 66.5], [0.0, 0.0, 1.0]])


def _projected(intrinsics, point):
    u, v, w = intrinsics @ point
    return np.array([u / w, v / w])


@given(
    WINDOWS,
    st.integers(1, 512),
    st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.5, 5)),
)
def test_a_point_projects_to_the_same_place_of_the_window_before_and_after(window, size, point):
    """Places are in units of the window. Each pixel coordinate is a sum of terms below 1000 with
    about five roundings (1e-15 each, relative), divided by a side of 1 px at least: 1e-12 * 10."""
    before = (_projected(INTRINSICS, point) - (window.left, window.top)) / window.side
    after = _projected(window_intrinsics(INTRINSICS, window, size=size), point) / size
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-11)


def test_a_dot_is_found_where_its_projection_says():
    """The centroid of a blurred dot: the filter is symmetric, so shrinking moves it by rounding to
    the pixel grid alone, which cancels for a dot of 9 px under a scale of 1/2."""
    image = np.zeros((96, 128, 4), np.uint8)
    image[40:49, 71:80] = 255
    window = Window(left=30.0, top=10.0, side=64.0)
    small = resampled(image, window, size=32)[..., 3]
    grid = np.arange(32) + 0.5
    centroid = np.array([(small * grid).sum(), (small * grid[:, None]).sum()]) / small.sum()
    expected = (np.array([75.5, 44.5]) - (30, 10)) / 2
    # Float32 weights of 25 px: 25 * 6e-8 * 32 px = 5e-5.
    np.testing.assert_allclose(centroid, expected, rtol=0, atol=5e-5)


def test_the_window_is_square_about_the_middle_of_the_foreground():
    mask = np.zeros((50, 60), bool)
    mask[10:20, 5:45] = True
    assert foreground_window(mask) == Window(left=5.0, top=-5.0, side=40.0)


@pytest.mark.parametrize("size", [7, 32, 50])
def test_an_opaque_image_is_resized_as_pillow_does(size):
    """Pillow's bilinear filter is the same triangle; it rounds to 8 bits after each of two passes,
    each by at most half a level."""
    image = np.random.default_rng(0).integers(0, 256, (32, 32, 4), dtype=np.uint8)
    image[..., 3] = 255
    ours = resampled(image, Window(left=0.0, top=0.0, side=32.0), size=size)
    # Pillow drops weights outside the image, we count them as transparent: compare the inside.
    pillow = Image.fromarray(image[..., :3]).resize((size, size), Image.Resampling.BILINEAR)
    inner = slice(size // 16 + 1, -(size // 16) - 1)
    difference = 255 * ours[inner, inner, :3] - np.asarray(pillow, float)[inner, inner]
    assert np.abs(difference).max() <= 1.01


@given(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))
def test_nothing_of_transparent_pixels_bleeds_in(dx, dy):
    """Hidden green under alpha 0 never shows."""
    image = np.zeros((8, 8, 4), np.uint8)
    image[..., 1] = 255
    image[2:6, 2:6] = (200, 0, 0, 255)
    view = resampled(image, Window(left=1 + dx, top=1 + dy, side=6.0), size=5)
    assert not view[..., 1].any()


def test_a_view_at_its_own_size_is_the_image():
    image = np.zeros((8, 8, 4), np.uint8)
    image[2:6, 2:6] = (200, 100, 0, 255)
    view = square_view(image, INTRINSICS, size=4)
    np.testing.assert_array_equal(np.rint(255 * view.rgba), image[2:6, 2:6])
    np.testing.assert_array_equal(view.intrinsics[:2, 2], INTRINSICS[:2, 2] - 2)


def test_an_empty_image_is_refused():
    with pytest.raises(ShardError, match="no foreground"):
        square_view(np.zeros((4, 4, 4), np.uint8), INTRINSICS, size=4)


@given(
    st.floats(-0.8, 0.8), st.floats(-0.8, 0.8), st.floats(-3, 3), st.sampled_from([32, 100, 300])
)
def test_of_a_camera_with_an_offset_principal_point_the_whole_object_is_kept(x, y, azimuth, size):
    """Every point lands in the square, and the farthest along the longer side at its borders: the
    mask knows whole pixels only, so up to one pixel of the source, which is `size / side` of the
    square. 1e-9 px for the roundings."""
    points = np.random.default_rng(3).uniform(-1, 1, (50, 3))
    camera = framed(
        points, direction=orbit_direction(azimuth, 0.3), fov=0.7, size=(96, 64), fill=0.9,
        principal=(48 + 96 * x, 32 + 64 * y),
    )  # fmt: skip
    column, row = np.floor(camera.project(points)[:, :2]).astype(int).T
    image = np.zeros((64, 96, 4), np.uint8)
    image[row, column] = 255
    view = square_view(image, camera.intrinsics, size=size)
    local = points @ camera.camera_from_world[:3, :3].T + camera.camera_from_world[:3, 3]
    pixels = (local / local[:, 2:]) @ view.intrinsics.T[:, :2]
    step = size / max(np.ptp(column) + 1, np.ptp(row) + 1)
    assert pixels.min() >= -1e-9
    assert pixels.max() <= size + 1e-9
    assert np.ptp(pixels, axis=0).max() >= size - 2 * step


def test_a_mask_tells_the_object_where_alpha_does_not():
    """A shadow on the floor has alpha but is no part of the object; a photograph is opaque."""
    image = np.zeros((8, 8, 4), np.uint8)
    image[2:4, 2:4] = (200, 100, 0, 255)
    view = square_view(image, INTRINSICS, size=4)
    shadow = image.copy()
    shadow[4:, :, 3] = 90
    photograph = np.full((8, 8, 4), 255, np.uint8)
    photograph[2:4, 2:4] = (200, 100, 0, 255)
    for other in (shadow, photograph):
        masked = square_view(other, INTRINSICS, size=4, mask=image[..., 3] > 0)
        np.testing.assert_array_equal(masked.rgba, view.rgba)
        np.testing.assert_array_equal(masked.intrinsics, view.intrinsics)
