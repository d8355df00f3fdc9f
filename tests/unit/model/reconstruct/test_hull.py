"""Masks and cameras that belong together share a hull; other readings of the poses are named."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from model.reconstruct.assemble import Assembled
from model.reconstruct.cameras import OPENCV_FROM_OPENGL, Rig
from model.reconstruct.capture import Capture
from model.reconstruct.draw import Painter
from model.reconstruct.hull import check_cameras
from model.reconstruct.sight import sphere_of
from tests.unit.model.reconstruct.studio import STATES


def changed(capture: Capture, change: Callable[[Floats], Floats]) -> Capture:
    poses = np.array([[change(pose) for pose in row] for row in capture.camera_from_world])
    return dataclasses.replace(capture, camera_from_world=poses)


def test_right_cameras_cover_nearly_all_of_the_foreground(capture: Capture) -> None:
    """Silhouettes of the very object: what is missing is the grid's step at the border."""
    assert check_cameras(capture).covered >= 0.95


def test_the_hull_holds_the_object(capture: Capture, perfect: Assembled) -> None:
    """A hull is never smaller than what throws the silhouettes: in its box to two steps."""
    hull = check_cameras(capture)
    painter = Painter(perfect.object, perfect.color)
    for points, state in zip(hull.points, STATES, strict=True):
        own = painter.points(state)
        assert (points.min(axis=0) <= own.min(axis=0) + 2.0 * hull.step).all()
        assert (points.max(axis=0) >= own.max(axis=0) - 2.0 * hull.step).all()


def test_a_sphere_that_is_not_stated_is_found(capture: Capture, perfect: Assembled) -> None:
    """It holds the object in both states, and is not half as large again as need be."""
    rig = Rig(file=capture.files[0][0], shots=())
    sphere = sphere_of(rig, check_cameras(capture))
    painter = Painter(perfect.object, perfect.color)
    reach = max(
        float(np.linalg.norm(painter.points(state) - sphere.center, axis=1).max())
        for state in STATES
    )
    assert not sphere.stated
    assert reach <= sphere.radius <= 1.5 * reach


@pytest.mark.parametrize(
    ("words", "change"),
    [
        ("OpenGL axes", lambda pose: OPENCV_FROM_OPENGL @ pose),
        ("the inverse, world_from_camera", inverted),
        ("world_from_camera with OpenGL axes", lambda pose: inverted(OPENCV_FROM_OPENGL @ pose)),
    ],
)
def test_another_convention_is_named(
    words: str, change: Callable[[Floats], Floats], capture: Capture
) -> None:
    with pytest.raises(ModelError, match=f"if the poses are {words}"):
        check_cameras(changed(capture, change))


def test_cameras_of_other_images_are_refused(capture: Capture) -> None:
    """Views one place on: no reading of the poses helps."""
    poses = np.roll(capture.camera_from_world, 1, axis=1)
    with pytest.raises(ModelError, match="check that poses, intrinsics, states and masks belong"):
        check_cameras(dataclasses.replace(capture, camera_from_world=poses))
