"""Three formats state the same cameras; what is wrong in a file is told with its place."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from model.reconstruct.cameras import OPENCV_FROM_OPENGL, SCHEMA
from model.reconstruct.rig import read_rig

SIZE = (64, 48)
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@pytest.fixture
def shots() -> list[Camera]:
    return [
        framed(
            CUBE,
            direction=orbit_direction(math.radians(azimuth), 0.4),
            fov=0.7,
            size=SIZE,
            fill=0.9,
        )
        for azimuth in (0.0, 80.0, 200.0)
    ]


def own(folder: Path, shots: list[Camera], **extra: object) -> Path:
    views = [
        {
            "image": f"state_{k % 2}/{k}.png",
            "intrinsics": shot.intrinsics.tolist(),
            "camera_from_world": shot.camera_from_world.tolist(),
        }
        for k, shot in enumerate(shots)
    ]
    return written(folder / "cameras.json", {"schema": SCHEMA, "views": views, **extra})


def transforms(folder: Path, shots: list[Camera]) -> Path:
    frames = []
    for k, shot in enumerate(shots):
        path = folder / f"state_{k % 2}" / f"{k}.png"
        path.parent.mkdir(exist_ok=True)
        Image.new("RGB", SIZE).save(path)
        pose = inverted(shot.camera_from_world) @ OPENCV_FROM_OPENGL
        frames.append({"file_path": f"./state_{k % 2}/{k}", "transform_matrix": pose.tolist()})
    angle = 2.0 * math.atan(SIZE[0] / 2.0 / shots[0].focal)
    return written(folder / "transforms.json", {"camera_angle_x": angle, "frames": frames})


def colmap(folder: Path, shots: list[Camera], turn: Floats) -> Path:
    """In a world that is turned, as COLMAP's is."""
    lines, cameras = [], []
    for k, shot in enumerate(shots):
        pose = shot.camera_from_world @ inverted(turn)
        w, x, y, z = quaternion_of(pose[:3, :3])
        place = " ".join(repr(float(v)) for v in pose[:3, 3])
        lines += [f"{k + 1} {w!r} {x!r} {y!r} {z!r} {place} {k + 1} state_{k % 2}/{k}.png", ""]
        numbers = f"{shot.focal!r} {SIZE[0] / 2} {SIZE[1] / 2}"
        cameras.append(f"{k + 1} SIMPLE_PINHOLE {SIZE[0]} {SIZE[1]} {numbers}")
    (folder / "cameras.txt").write_text("# cameras\n" + "\n".join(cameras) + "\n")
    (folder / "images.txt").write_text("# images\n" + "\n".join(lines) + "\n")
    return folder


def quaternion_of(turn: Floats) -> tuple[float, float, float, float]:
    """w, x, y, z by the eigenvector of Bar-Itzhack's matrix (2000)."""
    m = turn
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], 0, 0, 0],
            [m[1, 0] + m[0, 1], m[1, 1] - m[0, 0] - m[2, 2], 0, 0],
            [m[2, 0] + m[0, 2], m[2, 1] + m[1, 2], m[2, 2] - m[0, 0] - m[1, 1], 0],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m.trace()],
        ]
    )
    x, y, z, w = np.linalg.eigh(k)[1][:, -1].tolist()
    return w, x, y, z


def written(path: Path, stated: Mapping[str, Any]) -> Path:
    path.write_text(json.dumps(stated))
    return path


def test_our_own_format_is_read_exactly(tmp_path: Path, shots: list[Camera]) -> None:
    rig = read_rig(own(tmp_path, shots, center=[0, 0, 1], radius=2, meters_per_unit=0.1), tmp_path)
    assert [shot.state for shot in rig.shots] == [0, 1, 0]
    assert rig.center is not None
    assert (rig.center.tolist(), rig.radius, rig.meters) == ([0.0, 0.0, 1.0], 2.0, 0.1)
    for shot, camera in zip(rig.shots, shots, strict=True):
        assert np.array_equal(shot.intrinsics, camera.intrinsics)
        # The rotation is made exact: a few roundings.
        assert np.abs(shot.camera_from_world - camera.camera_from_world).max() <= 1e-14


def test_transforms_of_nerf_state_the_same(tmp_path: Path, shots: list[Camera]) -> None:
    """The angle of view goes through tan and atan: some 1e-15 of 64 px."""
    rig = read_rig(transforms(tmp_path, shots), tmp_path)
    assert [shot.image for shot in rig.shots] == ["state_0/0.png", "state_1/1.png", "state_0/2.png"]
    for shot, camera in zip(rig.shots, shots, strict=True):
        assert np.abs(shot.intrinsics - camera.intrinsics).max() <= 1e-12
        assert np.abs(shot.camera_from_world - camera.camera_from_world).max() <= 1e-13


def test_a_turned_world_of_colmap_is_set_upright(tmp_path: Path, shots: list[Camera]) -> None:
    """Turned about z alone, up is kept by cameras evenly above the horizon only in the mean; the
    relative poses are exact, and the first camera looks from the front."""
    turn = np.eye(4)
    turn[:3, :3] = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn[:3, :3] *= np.linalg.det(turn[:3, :3])
    rig = read_rig(colmap(tmp_path, shots, turn), tmp_path)
    first = rig.shots[0].camera_from_world
    for shot, camera in zip(rig.shots, shots, strict=True):
        relative = shot.camera_from_world @ inverted(first)
        expected = camera.camera_from_world @ inverted(shots[0].camera_from_world)
        assert np.abs(relative - expected).max() <= 1e-9
    poses = [inverted(shot.camera_from_world) for shot in rig.shots]
    up = -np.sum([pose[:3, 1] for pose in poses], axis=0)
    assert np.abs(up / np.linalg.norm(up) - (0.0, 0.0, 1.0)).max() <= 1e-9
    assert abs(poses[0][0, 2]) <= 1e-9
    assert poses[0][1, 2] > 0.0


BAD: Mapping[str, tuple[Mapping[str, Any], str]] = {
    "schema": ({"schema": "other/1"}, "schema 'other/1'"),
    "key": ({"centre": [0, 0, 0]}, "unknown key 'centre' .did you mean 'center'"),
    "radius": ({"radius": -1}, "radius is -1"),
    "center": ({"center": [0, 0]}, r"center is no \(3,\) array"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_wrong_key_is_told(name: str, tmp_path: Path, shots: list[Camera]) -> None:
    extra, told = BAD[name]
    with pytest.raises(ModelError, match=told):
        read_rig(own(tmp_path, shots, **extra), tmp_path)


def test_a_pose_that_scales_or_mirrors_is_refused(tmp_path: Path, shots: list[Camera]) -> None:
    path = own(tmp_path, shots)
    stated = json.loads(path.read_text())
    for row in (0, 1, 2):
        stated["views"][1]["camera_from_world"][row][0] *= -1.0
    with pytest.raises(ModelError, match=r"views\[1\] mirrors"):
        read_rig(written(path, stated), tmp_path)
    stated["views"][1]["camera_from_world"][0] = [2.0, 0.0, 0.0, 0.0]
    with pytest.raises(ModelError, match=r"views\[1\] is off a rotation"):
        read_rig(written(path, stated), tmp_path)


def test_lens_distortion_is_refused(tmp_path: Path, shots: list[Camera]) -> None:
    folder = colmap(tmp_path, shots, np.eye(4))
    (folder / "cameras.txt").write_text("1 SIMPLE_RADIAL 64 48 60 32 24 0.1\n")
    with pytest.raises(ModelError, match="lens distortion; undistort"):
        read_rig(folder, tmp_path)
    (folder / "cameras.txt").write_text("1 FISHEYE 64 48 60 32 24 0.1\n")
    with pytest.raises(ModelError, match="camera 1 is a FISHEYE"):
        read_rig(folder, tmp_path)


def test_a_file_that_is_no_json_is_told(tmp_path: Path) -> None:
    path = tmp_path / "cameras.json"
    path.write_text("{")
    with pytest.raises(ModelError, match="cannot be read as cameras"):
        read_rig(path, tmp_path)
