"""Photographs color what they show, and only that."""

import dataclasses

import numpy as np

from artgen.geometry.normals import face_vectors
from model.reconstruct.assemble import Assembled
from model.reconstruct.capture import Capture
from model.reconstruct.draw import Painter
from model.reconstruct.photo import BESIDE, DOUBT, TURNED, PhotoColors, shifted, spread
from model.reconstruct.run import photos
from model.reconstruct.skin import colored
from tests.unit.model.reconstruct.perfect import COLORS, sphere

GRAY = 0.25


def gray(points: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
    return np.full((len(points), 3), GRAY)


def painted(perfect: Assembled, capture: Capture) -> Assembled:
    """The cabinet, predicted gray, in the colors of its photographs."""
    shown = photos(capture, sphere(perfect), perfect.shift, perfect.states)
    over = PhotoColors(perfect.object, shown)
    whole, images = colored(perfect.object, {name: gray for name in perfect.colors}, over=over)
    return dataclasses.replace(perfect, object=whole, images=images)


def test_faces_that_a_camera_sees_take_its_color(perfect: Assembled, capture: Capture) -> None:
    """The door's front is seen squarely twice in each state: gray keeps a share of DOUBT over
    DOUBT + 2 x 0.3, some 0.08 of a difference of 0.5 at most, and bytes are rounded twice."""
    found = painted(perfect, capture)
    door = found.object.parts[1]
    normals = face_vectors(door.mesh)
    front = normals[:, 1] < -0.99 * np.linalg.norm(normals, axis=1)
    middles = np.asarray(door.mesh.atlas)[front].mean(axis=1)
    side = len(found.color)
    column, row = (middles[:, 0] * side).astype(int), ((1 - middles[:, 1]) * side).astype(int)
    expected = 255.0 * np.array(COLORS[1])
    assert np.abs(found.color[row, column] - expected).max() <= 255.0 * 0.5 * DOUBT / 0.6 + 2.0


def test_what_no_camera_sees_keeps_the_predicted_color(
    perfect: Assembled, capture: Capture
) -> None:
    """The bottom of the base looks down, and all cameras stand above."""
    paint = PhotoColors(
        perfect.object, photos(capture, sphere(perfect), perfect.shift, perfect.states)
    )
    points = np.array([[0.0, 0.0, 0.0], [0.1, 0.1, 0.0]])
    normals = np.tile([0.0, 0.0, -1.0], (2, 1))
    assert np.array_equal(paint("base", points, normals, gray(points)), gray(points))


def test_hidden_faces_are_not_painted_through(perfect: Assembled, capture: Capture) -> None:
    """The inner face of the base's back wall, behind the drawer, faces the front cameras."""
    paint = PhotoColors(
        perfect.object, photos(capture, sphere(perfect), perfect.shift, perfect.states)
    )
    low, high = perfect.object.parts[2].mesh.bounds
    hidden = np.array([[0.0, high[1] + 0.02, (low[2] + high[2]) / 2.0 - 0.06]])
    found = paint("base", hidden, np.array([[0.0, -1.0, 0.0]]), gray(hidden))
    assert np.array_equal(found, gray(hidden))


def test_a_field_that_is_too_dark_is_brightened_where_nobody_looks() -> None:
    """Dark by the same everywhere: mended entirely. Nothing seen: the field's word. Never beyond
    what a color can be."""
    true = np.linspace(0.3, 0.9, 60).reshape(20, 3)
    seen = np.arange(20) % 2 == 0
    dark = true - [0.3, 0.2, 0.1]
    shown = np.where(seen[:, None], true, dark)
    # Some ten sums of numbers below 1.
    assert np.abs(shifted(dark, shown, seen) - true).max() <= 20 * 2.0**-52
    assert np.array_equal(shifted(dark, dark, np.zeros(20, bool)), dark)
    white = shifted(true, np.where(seen[:, None], 1.0, true), seen)
    assert white.max() == 1.0
    assert np.array_equal(white[seen], np.ones((10, 3)))


def test_color_spreads_around_an_edge_and_no_farther() -> None:
    """A strip 1 m long whose left half is seen, white: beside it points are white, at half of the
    reach a quarter their own gray, beyond the reach gray; so are those that look elsewhere."""
    x = np.linspace(0.0, 1.0, 201)
    points = np.stack([x, 0.0 * x, 0.0 * x], axis=1)
    up, down = np.tile([0.0, 0.0, 1.0], (201, 1)), np.tile([0.0, 0.0, -1.0], (201, 1))
    seen = x <= 0.5
    rgb = np.where(seen[:, None], np.ones((201, 3)), GRAY)
    found = spread(points, up, rgb, seen)
    assert np.array_equal(found[seen], rgb[seen])
    assert np.abs(found[101] - 1.0).max() <= (1.0 - GRAY) * 0.05**2 + 1e-12  # 5 mm of 100
    half = int(np.argmin(np.abs(x - 0.5 - BESIDE / 2.0)))
    assert np.abs(found[half] - (1.0 - 0.25 * (1.0 - GRAY))).max() <= 1e-9
    assert np.array_equal(found[x > 0.5 + BESIDE + 1e-9], rgb[x > 0.5 + BESIDE + 1e-9])
    assert TURNED * 2.0 > 1.0
    away = spread(points, np.where(seen[:, None], up, down), rgb, seen)
    assert np.array_equal(away, rgb)


def test_pixels_beside_the_background_do_not_bleed(perfect: Assembled, capture: Capture) -> None:
    """A red rim one pixel wide, as blurred edges have, leaves the door's colors as they were."""
    edge = capture.rgba[..., 3] > 200
    inner = edge.copy()
    for axis in (2, 3):
        for step in (-1, 1):
            inner &= np.roll(edge, step, axis=axis)
    red = capture.rgba.copy()
    red[edge & ~inner] = (255, 0, 0, 255)
    clean, bled = (
        painted(perfect, dataclasses.replace(capture, rgba=rgba)).color.astype(float)
        for rgba in (capture.rgba, red)
    )
    changed = np.abs(clean - bled).max(axis=-1) > 40.0
    assert changed.mean() <= 0.01


def test_a_painter_without_its_lamp_shows_the_image(perfect: Assembled) -> None:
    """Every pixel is one of the three colors, to a step of a byte."""
    painter = Painter(perfect.object, perfect.color, dim=1.0)
    pose = np.eye(4)
    pose[:3, :3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
    pose[:3, 3] = [0.0, 0.4, 2.0]
    matrix = np.array([[60.0, 0.0, 32.0], [0.0, 60.0, 32.0], [0.0, 0.0, 1.0]])
    picture = painter.paint({}, matrix, pose, (64, 64))
    seen = picture[picture[..., 3] > 0][:, :3].astype(float)
    table = 255.0 * np.array(list(COLORS.values()))
    assert len(seen) > 300
    assert np.abs(seen[:, None] - table).max(axis=2).min(axis=1).max() <= 1.5
