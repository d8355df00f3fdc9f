import dataclasses

import numpy as np

from artgen.core.stream import Stream
from model.data.config import DataConfig
from model.data.views import Views, drawn_views, stated_views

CONFIG = DataConfig(fov_deg=(20.0, 50.0), elevation_deg=(-10.0, 60.0), fill=0.9)
CLOUD = np.random.default_rng(0).uniform(-0.6, 0.6, (2, 50, 3))


def _eyes(views: Views) -> np.ndarray:
    pose = views.camera_from_world
    return -np.einsum("tvji,tvj->tvi", pose[..., :3, :3], pose[..., :3, 3])


def test_every_point_is_seen_and_fills_its_share():
    for seed in range(5):
        views = drawn_views(CLOUD, CONFIG, Stream(seed), count=3, size=64)
        for t, v in np.ndindex(2, 3):
            pose, matrix = views.camera_from_world[t, v], views.intrinsics[t, v]
            local = CLOUD.reshape(-1, 3) @ pose[:3, :3].T + pose[:3, 3]
            assert (local[:, 2] > 0).all()
            pixels = (local @ matrix.T)[:, :2] / local[:, 2:]
            reach = np.abs(pixels - 32.0).max()
            # `framed` touches the share exactly; 1e-9 px is rounding.
            assert reach <= 0.9 * 32.0 + 1e-9


def test_cameras_lie_in_the_ranges_that_were_asked_for():
    config = dataclasses.replace(CONFIG, azimuth_deg=60.0)
    views = drawn_views(CLOUD, config, Stream(3), count=40, size=64)
    forward = views.camera_from_world[0, :, 2, :3]
    elevation = np.degrees(np.arcsin(-forward[:, 2]))
    azimuth = np.degrees(np.arctan2(-forward[:, 0], forward[:, 1]))
    assert elevation.min() >= -10.0 - 1e-9
    assert elevation.max() <= 60.0 + 1e-9
    assert np.abs(azimuth).max() <= 60.0 + 1e-9
    fov = 2 * np.degrees(np.arctan(32.0 / views.intrinsics[0, :, 0, 0]))
    assert fov.min() >= 20.0 - 1e-9
    assert fov.max() <= 50.0 + 1e-9


def test_four_views_lie_all_around():
    """One in each quarter, so no two neighbors are farther apart than 162 degrees."""
    for seed in range(20):
        eyes = _eyes(drawn_views(CLOUD, CONFIG, Stream(seed), count=4, size=64))[0]
        angles = np.sort(np.arctan2(eyes[:, 0], eyes[:, 1]))
        gaps = np.diff(angles, append=angles[0] + 2 * np.pi)
        # Shares of a quarter, each jittered by 0.4 of it to either side: 1.8 quarters at most, and
        # a few degrees because eyes are seen from the cloud's middle here.
        assert np.degrees(gaps.max()) < 162.0 + 12.0


def test_all_states_share_their_cameras_if_asked():
    same = drawn_views(CLOUD, CONFIG, Stream(0), count=2, size=64)
    assert np.array_equal(same.camera_from_world[0], same.camera_from_world[1])
    config = dataclasses.replace(CONFIG, same_cameras=False)
    own = drawn_views(CLOUD, config, Stream(0), count=2, size=64)
    assert not np.array_equal(own.camera_from_world[0], own.camera_from_world[1])


def test_noise_turns_and_shifts_what_the_network_is_told():
    views = drawn_views(CLOUD, CONFIG, Stream(0), count=200, size=64)
    assert stated_views(views, CONFIG, Stream(1)) is views
    config = dataclasses.replace(CONFIG, pose_noise_deg=2.0, pose_noise=0.1)
    told = stated_views(views, config, Stream(1))
    true_pose, pose = views.camera_from_world, told.camera_from_world
    change = pose @ np.linalg.inv(true_pose)
    skew = change[..., :3, :3] - np.swapaxes(change[..., :3, :3], -1, -2)
    turns = np.degrees(np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]]) / 2)
    # 1,200 draws: the deviation of a deviation is 2 %.
    assert abs(turns.std() / 2.0 - 1.0) < 0.08
    assert abs(change[..., :3, 3].std() / 0.1 - 1.0) < 0.08
    gram = pose[..., :3, :3] @ np.swapaxes(pose[..., :3, :3], -1, -2)
    np.testing.assert_allclose(gram, np.broadcast_to(np.eye(3), gram.shape), atol=1e-12)
