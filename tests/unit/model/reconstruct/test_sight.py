"""What the network sees is the capture, and the object is found again where it was."""

import numpy as np
import torch

from model.reconstruct.assemble import Assembled
from model.reconstruct.capture import Capture
from model.reconstruct.run import reprojections
from model.reconstruct.sight import in_object, in_radii, network_images
from tests.unit.model.reconstruct.perfect import RADIUS, sphere


def test_the_object_reprojects_onto_its_photographs(perfect: Assembled, capture: Capture) -> None:
    """The painter drew the photographs, so silhouettes differ by the crop's resampling alone: a
    border of half a px around shapes of some 90 px."""
    for own in reprojections(capture, sphere(perfect), perfect, size=96):
        assert own.iou >= 0.96
        both = (own.seen[..., 3] > 250) & (own.shown[..., 3] > 250)
        off = np.abs(own.seen[both].astype(int) - own.shown[both])[:, :3]
        assert float(np.median(off)) <= 2.0


def test_poses_in_radii_and_in_meters_show_points_at_the_same_pixels(
    perfect: Assembled, capture: Capture
) -> None:
    """A point of the object frame by three ways; float64 throughout, a few roundings of 100 px."""
    pose, matrix = capture.camera_from_world[1, 2], capture.intrinsics[1, 2]
    own = sphere(perfect)
    point = np.array([0.1, -0.2, 0.5])

    def pixel(camera_from_a: np.ndarray, at: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
        local = matrix @ (camera_from_a[:3, :3] @ at + camera_from_a[:3, 3])
        return local[:2] / local[2]

    expected = pixel(pose, point)
    assert (
        np.abs(pixel(in_radii(pose, own), (point - own.center) / RADIUS) - expected).max() < 1e-10
    )
    assert np.abs(pixel(in_object(pose, own, perfect.shift), point) - expected).max() < 1e-10


def test_the_unit_of_the_camera_file_does_not_matter(perfect: Assembled, capture: Capture) -> None:
    """The same photographs with cameras in millimeters."""
    poses = capture.camera_from_world.copy()
    poses[..., :3, 3] *= 1000.0
    for t in range(2):
        own = in_object(capture.camera_from_world[t, 0], sphere(perfect), perfect.shift)
        other = in_object(poses[t, 0], sphere(perfect, unit=1e-3), perfect.shift)
        assert np.abs(own - other).max() <= 1e-12


def test_the_network_sees_squares_over_its_background(perfect: Assembled, capture: Capture) -> None:
    images = network_images(capture, sphere(perfect), size=32, background="black")
    assert images.rgb_BTV3HW.shape == (1, 2, 4, 3, 32, 32)
    empty = images.alpha_BTVHW == 0.0
    assert bool(empty.any())
    for channel in range(3):
        assert float(images.rgb_BTV3HW[:, :, :, channel][empty].abs().max()) == 0.0
    turn = images.camera_from_world_BTV44[0, 0, 0, :3, :3]
    assert torch.allclose(turn @ turn.T, torch.eye(3), atol=1e-6)
