"""Films show every joint at work; silhouettes are compared as sets of pixels."""

import io

import numpy as np
from PIL import Image

from artgen.articulation.states import check_state, travel
from model.reconstruct.assemble import Assembled
from model.reconstruct.draw import Painter, over
from model.reconstruct.films import STROKE, Reprojection, articulation, straight, strokes, thumbnail


def test_each_joint_opens_alone_and_then_all_together(perfect: Assembled) -> None:
    states = strokes(perfect.object)
    assert len(states) == 3 * STROKE
    for state in states:
        check_state(perfect.object.joints, perfect.object.preconditions, state)
    for k, joint in enumerate(perfect.object.joints):
        own = [state.get(joint.name, 0.0) for state in states[k * STROKE : (k + 1) * STROKE]]
        assert own[0] == 0.0
        assert max(own) == travel(joint)[1]
    widest = states[2 * STROKE + STROKE // 2]
    assert widest == {joint.name: travel(joint)[1] for joint in perfect.object.joints}


def test_the_film_is_a_gif_of_those_states(perfect: Assembled) -> None:
    painter = Painter(perfect.object, perfect.color)
    with Image.open(io.BytesIO(articulation(perfect.object, painter))) as film:
        frames = getattr(film, "n_frames", 1)
        # Equal frames in a row are one frame that stays longer.
        assert 3 * (STROKE - 2) <= frames <= 3 * STROKE
        assert film.size == (256, 256)


def test_the_thumbnail_is_of_the_size_of_all_bundles(perfect: Assembled) -> None:
    painter = Painter(perfect.object, perfect.color)
    with Image.open(io.BytesIO(thumbnail(perfect.object, painter))) as picture:
        assert (picture.size, picture.mode) == ((256, 256), "RGBA")


def test_silhouettes_are_compared_by_pixels() -> None:
    seen, shown = np.zeros((4, 4, 4), np.uint8), np.zeros((4, 4, 4), np.uint8)
    seen[:2, :, 3] = 255
    shown[1:3, :, 3] = 255
    assert Reprojection(state=0, view=0, seen=seen, shown=shown).iou == 4 / 12


def test_a_picture_over_white_is_taken_apart_again() -> None:
    """Straight color, coverage and back; a byte each."""
    rgba = np.array([[[10, 200, 90, 255], [10, 200, 90, 128], [0, 0, 0, 0]]], np.uint8)
    alpha = rgba[..., 3:].astype(np.float32) / 255.0
    white = (rgba[..., :3].astype(np.float32) / 255.0) * alpha + (1.0 - alpha)
    found = straight(white, alpha)
    assert np.abs(found.astype(int) - rgba).max() <= 1
    assert over(rgba, (255, 255, 255))[0, 2].tolist() == [255, 255, 255]
