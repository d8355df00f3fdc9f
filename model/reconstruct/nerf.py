"""NeRF's `transforms.json`: poses `world_from_camera` with OpenGL axes (x right, y up, z back).

Written by Blender's exporters, instant-ngp and nerfstudio. Keys: `frames` with `file_path` and
`transform_matrix`; `camera_angle_x`, or `fl_x`, `fl_y`, `cx`, `cy`, for all frames or for each; and
ours: `state` (or `time`) of a frame.
"""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from model.reconstruct.cameras import (
    OPENCV_FROM_OPENGL,
    Rig,
    Shot,
    numbers,
    positive,
    rigid_checked,
    state_of,
)

SUFFIXES = ("", ".png", ".jpg", ".jpeg", ".webp")
DISTORTION = ("k1", "k2", "k3", "k4", "p1", "p2")


def rig_of_transforms(path: Path, stated: Mapping[str, Any], images: Path) -> Rig:
    """The rig of a `transforms.json`; its world is z up, as Blender's.

    Raises:
        ModelError: a key is missing or an image has distortion.
    """
    frames = stated.get("frames")
    if not isinstance(frames, list) or not frames:
        raise ModelError(f"{path}: has no frames; expected a list of file_path, transform_matrix")
    times = sorted({float(f["time"]) for f in frames if isinstance(f, dict) and "time" in f})
    shots = tuple(_shot(path, stated, frame, images, times) for frame in frames)
    return Rig(file=path, shots=shots)


def _shot(
    path: Path,
    shared: Mapping[str, Any],
    frame: Mapping[str, Any],
    images: Path,
    times: list[float],
) -> Shot:
    both = {**shared, **frame}
    for key in ("file_path", "transform_matrix"):
        if key not in frame:
            raise ModelError(f"{path}: a frame has no {key!r}")
    image = _found(images, str(frame["file_path"]))
    if bent := [key for key in DISTORTION if abs(float(both.get(key, 0.0))) > 1e-9]:
        raise ModelError(
            f"{path}: {image} has lens distortion ({', '.join(bent)}); undistort the images first"
        )
    pose = numbers(path, f"transform_matrix of {image}", frame["transform_matrix"], (4, 4))
    world_from_camera = rigid_checked(path, image, pose) @ OPENCV_FROM_OPENGL
    state = times.index(float(frame["time"])) if "time" in frame else frame.get("state")
    return Shot(
        image=image,
        state=state_of(image, state),
        intrinsics=_intrinsics(path, both, images / image),
        camera_from_world=inverted(world_from_camera),
        mask=frame.get("mask_path"),
    )


def _found(images: Path, name: str) -> str:
    """The image's name with the ending that the file omits."""
    clean = name.removeprefix("./")
    for suffix in SUFFIXES:
        if (images / f"{clean}{suffix}").is_file():
            return f"{clean}{suffix}"
    return clean


def _intrinsics(path: Path, both: Mapping[str, Any], image: Path) -> Floats:
    width, height = both.get("w"), both.get("h")
    if width is None or height is None:
        try:
            with Image.open(image) as picture:
                width, height = picture.size
        except OSError as error:
            raise ModelError(f"{path}: image {image} cannot be opened ({error})") from error
    if "fl_x" in both:
        x = positive(path, "fl_x", both["fl_x"])
        y = positive(path, "fl_y", both.get("fl_y", x))
    elif "camera_angle_x" in both:
        x = y = float(width) / 2.0 / math.tan(float(both["camera_angle_x"]) / 2.0)
    else:
        raise ModelError(f"{path}: neither fl_x nor camera_angle_x is stated")
    middle = float(both.get("cx", width / 2.0)), float(both.get("cy", height / 2.0))
    return np.array([[x, 0.0, middle[0]], [0.0, y, middle[1]], [0.0, 0.0, 1.0]])
