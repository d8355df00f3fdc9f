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
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import inverted
from model.reconstruct.cameras import OPENCV_FROM_OPENGL, SCHEMA, Rig
from model.reconstruct.rig import read_rig, up_of

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


def in_world(folder: Path, shots: list[Camera], turn: Floats, *, mark: str = "") -> Path:
    """`transforms` in a world that is turned, with a key of a converter; for "frame." in frames."""
    path = transforms(folder, shots)
    stated = json.loads(path.read_text())
    for frame in stated["frames"]:
        frame["transform_matrix"] = (turn @ np.array(frame["transform_matrix"])).tolist()
        if mark.startswith("frame."):
            frame[mark.removeprefix("frame.")] = 7
    return written(path, {**stated, mark: 7} if mark and "." not in mark else stated)


def test_a_scene_of_nerf_states_up_and_front(tmp_path: Path, shots: list[Camera]) -> None:
    """Rounded to float32 as Blender writes it, or with what exporters for instant-ngp add."""
    path = transforms(tmp_path, shots)
    stated = json.loads(path.read_text())
    for frame in stated["frames"]:
        frame["transform_matrix"] = np.float32(frame["transform_matrix"]).tolist()
        frame["rotation"] = 0.01
    written(path, {**stated, "aabb_scale": 16, "w": SIZE[0], "h": SIZE[1]})
    rig = read_rig(path, tmp_path)
    assert rig.front_stated
    assert np.abs(rig.shots[1].camera_from_world - shots[1].camera_from_world).max() <= 1e-6


@pytest.mark.parametrize(
    ("mark", "turned"),
    [("", True), ("applied_transform", True), ("ply_file_path", False),
     ("frame.sharpness", False), ("frame.colmap_im_id", True)],
)  # fmt: skip
def test_photographs_of_nerf_are_set_upright_as_those_of_colmap(
    mark: str, turned: bool, tmp_path: Path, shots: list[Camera]
) -> None:
    """Found: their world, which lies in any way, was taken for upright with its front at -y."""
    turn = any_turn() if turned else np.eye(4)
    rig = read_rig(in_world(tmp_path, shots, turn, mark=mark), tmp_path)
    assert not rig.front_stated
    assert_first_in_front(rig)


def assert_first_in_front(rig: Rig) -> None:
    turn = math.radians(80.0)
    for shot, azimuth in zip(rig.shots, (0.0, turn, 2.5 * turn), strict=True):
        assert np.abs(shot.camera_from_world[0, 2]) <= 1e-9  # its right is level
        assert np.abs(shot.camera_from_world[:3, :3] - _looking(azimuth)).max() <= 1e-9


def any_turn() -> Floats:
    turn = np.eye(4)
    turn[:3, :3] = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn[:3, :3] *= np.linalg.det(turn[:3, :3])
    return turn


def test_a_turned_world_of_colmap_is_set_upright(tmp_path: Path, shots: list[Camera]) -> None:
    """Cameras that look down from one side hold up what leans by as much, but none is tilted
    sideways, so up is found to some roundings; the first camera looks from the front."""
    rig = read_rig(colmap(tmp_path, shots, any_turn()), tmp_path)
    assert not rig.front_stated
    assert_first_in_front(rig)


def _looking(azimuth: float) -> Floats:
    """(3, 3) of a camera of `shots`, as if the first stood in front."""
    return framed(
        CUBE, direction=orbit_direction(azimuth, 0.4), fov=0.7, size=SIZE, fill=0.9
    ).camera_from_world[:3, :3]


def test_up_of_cameras_in_a_row_is_what_they_hold_up(tmp_path: Path, shots: list[Camera]) -> None:
    """Their rights are one line, which leaves open how far they look down: they are taken to look
    straight ahead, and their rights stay level."""
    rig = read_rig(colmap(tmp_path, shots[:1], any_turn()), tmp_path)
    assert np.abs(rig.shots[0].camera_from_world[:3, :3] - _level()).max() <= 1e-9


def _level() -> Floats:
    return np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def test_up_survives_hands_that_shake(shots: list[Camera]) -> None:
    """Turned by 2 degrees about their own axes, up is off by less than that."""
    draw = np.random.default_rng(5)
    turns = np.array([inverted(shot.camera_from_world)[:3, :3] for shot in shots])
    shaken = [turn @ _small(draw.normal(size=3) * math.radians(2.0)) for turn in turns]
    assert np.abs(up_of(turns) - (0.0, 0.0, 1.0)).max() <= 1e-12
    assert math.degrees(math.acos(min(float(up_of(np.array(shaken))[2]), 1.0))) <= 3.0


def _small(turn: Floats) -> Floats:
    angle = float(np.linalg.norm(turn))
    return axis_angle_matrix((turn / angle).tolist(), angle)


BAD: Mapping[str, tuple[Mapping[str, Any], str]] = {
    "schema": ({"schema": "other/1"}, "schema 'other/1'"),
    "key": ({"centre": [0, 0, 0]}, "unknown key 'centre' .did you mean 'center'"),
    "radius": ({"radius": -1}, "radius is -1"),
    "radius in quotes": ({"radius": "0.5"}, "radius is no finite number, but '0.5'"),
    "unit": ({"meters_per_unit": None}, "meters_per_unit is no finite number, but None"),
    "center": ({"center": [0, 0]}, r"center is no \(3,\) array"),
    "ragged center": ({"center": [0, [1], 2]}, r"center is no \(3,\) array"),
    "views": ({"views": 5}, "views is 5, expected a list"),
    "no views": ({"views": []}, r"views is \[\], expected a list"),
    "a view": ({"views": ["a.png"]}, r"views\[0\] is 'a.png', expected a JSON object with image"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_wrong_key_is_told(case: str, tmp_path: Path, shots: list[Camera]) -> None:
    extra, told = BAD[case]
    with pytest.raises(ModelError, match=rf"cameras\.json.*{told}"):
        read_rig(own(tmp_path, shots, **extra), tmp_path)


PINHOLE = [[60.0, 0.0, 32.0], [0.0, 60.0, 24.0], [0.0, 0.0, 1.0]]
BAD_VIEW: Mapping[str, tuple[Mapping[str, Any], str]] = {
    "image": ({"image": 7}, r"views\[1\].image is 7, expected the name of a file"),
    "mask": ({"mask": 5}, r"views\[1\].mask is 5, expected the name of a file"),
    "no lens": (
        {"intrinsics": [[0.0] * 3] * 3},
        r"views\[1\].intrinsics .* no pinhole; .* above 0",
    ),
    "last row": ({"intrinsics": [*PINHOLE[:2], [0, 0, 0]]}, "no pinhole"),
    "mirror": ({"intrinsics": [[-60, 0, 32], *PINHOLE[1:]]}, "no pinhole"),
    "words": ({"intrinsics": [["60", "0", "32"], *PINHOLE[1:]]}, r"no \(3, 3\) array"),
    "convention": ({"convention": "OpenGL"}, "convention is 'OpenGL' .did you mean 'opengl'"),
    "no convention": ({"convention": None}, "convention is None, expected one of opencv, opengl"),
    "state in quotes": ({"state": "1"}, "the state of state_1/1.png is '1', expected a whole"),
    "half a state": ({"state": 0.5}, "is 0.5, expected a whole number"),
    "a true state": ({"state": True}, "is True, expected a whole number"),
    "an endless state": ({"state": math.inf}, "is inf, expected a whole number"),
}


@pytest.mark.parametrize("case", BAD_VIEW)
def test_a_wrong_value_of_a_view_is_told(case: str, tmp_path: Path, shots: list[Camera]) -> None:
    """Some were read as something else without a word, others ended in a traceback."""
    path = own(tmp_path, shots)
    stated = json.loads(path.read_text())
    changes, told = BAD_VIEW[case]
    stated["views"][1].update(changes)
    with pytest.raises(ModelError, match=rf"cameras\.json.*{told}"):
        read_rig(written(path, stated), tmp_path)


def test_a_view_may_have_opengl_axes_and_a_state_of_its_own(
    tmp_path: Path, shots: list[Camera]
) -> None:
    path = own(tmp_path, shots)
    stated = json.loads(path.read_text())
    pose = OPENCV_FROM_OPENGL @ shots[1].camera_from_world
    changes = {"convention": "opengl", "state": 3.0, "camera_from_world": pose.tolist()}
    stated["views"][1].update(changes)
    found = read_rig(written(path, stated), tmp_path).shots[1]
    assert found.state == 3
    # The rotation is made exact: a few roundings.
    assert np.abs(found.camera_from_world - shots[1].camera_from_world).max() <= 1e-14


BAD_TRANSFORMS: Mapping[str, tuple[Mapping[str, Any], str]] = {
    "no frames": ({"frames": {}}, "frames is {}, expected a list"),
    "angle as a word": ({"camera_angle_x": "x"}, "camera_angle_x of state_0/0.png is no finite"),
    "angle of zero": ({"camera_angle_x": 0}, "camera_angle_x of state_0/0.png is 0, expected more"),
    "degrees": ({"camera_angle_x": 40.0}, "is 40, expected radians, less than pi"),
    "distortion": ({"k1": None}, "k1 of state_0/0.png is no finite number, but None"),
    "width": ({"w": "64", "h": 48}, "w of state_0/0.png is no finite number, but '64'"),
    "middle": ({"cx": "32"}, "cx of state_0/0.png is no finite number"),
    "focal": ({"fl_x": -3.0}, "fl_x of state_0/0.png is -3, expected more than 0"),
}


@pytest.mark.parametrize("case", BAD_TRANSFORMS)
def test_a_wrong_value_of_transforms_is_told(
    case: str, tmp_path: Path, shots: list[Camera]
) -> None:
    path = transforms(tmp_path, shots)
    changes, told = BAD_TRANSFORMS[case]
    with pytest.raises(ModelError, match=rf"transforms\.json: .*{told}"):
        read_rig(written(path, {**json.loads(path.read_text()), **changes}), tmp_path)


BAD_FRAME: Mapping[str, tuple[Mapping[str, Any], str]] = {
    "name": ({"file_path": 3}, r"frames\[1\].file_path is 3, expected the name of a file"),
    "mask": ({"mask_path": 3}, r"frames\[1\].mask_path is 3, expected the name of a file"),
    "pose": ({"transform_matrix": "x"}, r"frames\[1\].transform_matrix is no \(4, 4\) array"),
    "some times": ({"time": 0.5}, r"1 of 3 frames have a time, frames\[0\] has none"),
    "state": ({"state": "1"}, "the state of state_1/1.png is '1', expected a whole number"),
}


@pytest.mark.parametrize("case", BAD_FRAME)
def test_a_wrong_value_of_a_frame_is_told(case: str, tmp_path: Path, shots: list[Camera]) -> None:
    path = transforms(tmp_path, shots)
    stated = json.loads(path.read_text())
    changes, told = BAD_FRAME[case]
    stated["frames"][1].update(changes)
    with pytest.raises(ModelError, match=rf"transforms\.json: .*{told}"):
        read_rig(written(path, stated), tmp_path)


def test_frames_that_are_no_objects_are_told(tmp_path: Path, shots: list[Camera]) -> None:
    path = transforms(tmp_path, shots)
    stated = json.loads(path.read_text())
    stated["frames"][2] = "state_0/2.png"
    with pytest.raises(ModelError, match=r"frames\[2\] is 'state_0/2.png', expected a JSON object"):
        read_rig(written(path, stated), tmp_path)
    stated["frames"][2] = {"file_path": "state_0/2.png"}
    with pytest.raises(ModelError, match=r"frames\[2\] has no 'transform_matrix'"):
        read_rig(written(path, stated), tmp_path)


def test_times_are_states(tmp_path: Path, shots: list[Camera]) -> None:
    path = transforms(tmp_path, shots)
    stated = json.loads(path.read_text())
    for frame, time in zip(stated["frames"], (0.7, 0.1, 0.7), strict=True):
        frame["time"] = time
    rig = read_rig(written(path, stated), tmp_path)
    assert [shot.state for shot in rig.shots] == [1, 0, 1]
    stated["frames"][1]["time"] = "later"
    with pytest.raises(ModelError, match=r"frames\[1\].time is no finite number, but 'later'"):
        read_rig(written(path, stated), tmp_path)


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


@pytest.mark.parametrize(
    ("camera", "pose", "told"),
    [
        ("64 48 0 32 24", "1 0 0 0 0 0 3", "camera 1 is .* no pinhole"),
        ("64 48 nan 32 24", "1 0 0 0 0 0 3", "holds no finite numbers"),
        ("64 48 60 32 24", "0 0 0 0 0 0 3", "quaternion of a.png is .* expected one of length 1"),
        ("64 48 60 32 24", "nan 0 0 0 0 0 3", "quaternion of a.png"),
        ("64 48 60 32 24", "1 0 0 0 0 0 nan", "the pose of a.png"),
    ],
)
def test_damaged_numbers_of_colmap_are_told(
    camera: str, pose: str, told: str, tmp_path: Path
) -> None:
    """A quaternion of zeros counted as no turn at all."""
    (tmp_path / "cameras.txt").write_text(f"1 SIMPLE_PINHOLE {camera}\n")
    (tmp_path / "images.txt").write_text(f"1 {pose} 1 a.png\n\n")
    with pytest.raises(ModelError, match=told):
        read_rig(tmp_path, tmp_path)
