"""COLMAP's text model: `cameras.txt` and `images.txt` of a folder.

Poses are `camera_from_world` with OpenCV axes as quaternions w, x, y, z. The world is any: it is
set upright (`model/reconstruct/rig.py`) and its front looked for (`model/reconstruct/front.py`).
"""

from pathlib import Path

import numpy as np

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from model.reconstruct.cameras import Rig, Shot
from model.reconstruct.stated import lens, quoted, rigid_checked, state_of

PINHOLES = {
    "SIMPLE_PINHOLE": ("f", "cx", "cy"),
    "PINHOLE": ("fx", "fy", "cx", "cy"),
    "SIMPLE_RADIAL": ("f", "cx", "cy", "k"),
    "RADIAL": ("f", "cx", "cy", "k1", "k2"),
    "OPENCV": ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"),
}
"""Camera model to its parameters, in the file's order."""


def rig_of_colmap(folder: Path) -> Rig:
    """The rig of a folder with `cameras.txt` and `images.txt`.

    Raises:
        ModelError: a file or camera is missing, a line is damaged, or an image has distortion.
    """
    cameras = {}
    for line in _lines(folder / "cameras.txt"):
        words = line.split()
        cameras[words[0]] = _camera(folder / "cameras.txt", words)
    shots = []
    path = folder / "images.txt"
    # Every second line lists points, and is empty where there are none.
    for line in _lines(path, keep_empty=True)[::2]:
        shots.append(_shot(path, line.split(maxsplit=9), cameras))
    if not shots:
        raise ModelError(f"{path}: names no image")
    return Rig(file=path, shots=tuple(shots), front_stated=False)


def _lines(path: Path, *, keep_empty: bool = False) -> list[str]:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ModelError(f"{path}: cannot be read ({error.strerror})") from error
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    while lines and not lines[-1].strip():
        lines.pop()
    return lines if keep_empty else [line for line in lines if line.strip()]


def _camera(path: Path, words: list[str]) -> Floats:
    """(3, 3) intrinsics of a line of `cameras.txt`."""
    try:
        kind, values = words[1], [float(word) for word in words[4:]]
        named = dict(zip(PINHOLES[kind], values, strict=True))
    except KeyError as error:
        known = ", ".join(PINHOLES)
        raise ModelError(
            f"{path}: camera {words[0]} is a {error.args[0]}, read are {known}; undistort the "
            "images (colmap image_undistorter)"
        ) from error
    except (IndexError, ValueError) as error:
        raise ModelError(f"{path}: camera line {' '.join(words)!r} is damaged") from error
    if any(abs(named.get(key, 0.0)) > 1e-9 for key in ("k", "k1", "k2", "p1", "p2")):
        raise ModelError(
            f"{path}: camera {words[0]} has lens distortion; undistort the images (colmap "
            "image_undistorter)"
        )
    x = named.get("fx", named.get("f", 0.0))
    y = named.get("fy", x)
    matrix = np.array([[x, 0.0, named["cx"]], [0.0, y, named["cy"]], [0.0, 0.0, 1.0]])
    if not np.isfinite(matrix).all():
        raise ModelError(f"{path}: camera line {quoted(' '.join(words))} holds no finite numbers")
    return lens(path, f"camera {words[0]}", matrix)


def _shot(path: Path, words: list[str], cameras: dict[str, Floats]) -> Shot:
    try:
        turn, place = np.array(words[1:5], float), np.array(words[5:8], float)
        camera, image = words[8], words[9]
    except (IndexError, ValueError) as error:
        raise ModelError(f"{path}: image line {' '.join(words)!r} is damaged") from error
    if camera not in cameras:
        raise ModelError(f"{path}: {image} names camera {camera}, which cameras.txt lacks")
    if not 0.5 < float(np.linalg.norm(turn)) < 2.0:
        raise ModelError(
            f"{path}: the quaternion of {image} is {turn.tolist()}, expected one of length 1"
        )
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = _rotation(turn), place
    return Shot(
        image=image,
        state=state_of(path, image, None),
        intrinsics=cameras[camera],
        camera_from_world=rigid_checked(path, image, pose),
    )


def _rotation(quaternion: Floats) -> Floats:
    """(3, 3) of a quaternion w, x, y, z of any length but zero."""
    w, x, y, z = quaternion / float(np.linalg.norm(quaternion))
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )
