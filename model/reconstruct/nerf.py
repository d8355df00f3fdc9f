"""NeRF's `transforms.json`: poses `world_from_camera` with OpenGL axes (x right, y up, z back).

Written by Blender's exporters, instant-ngp and nerfstudio. The world of a scene is upright; that of
photographs is any, as COLMAP's, from which it was converted. Keys: `frames` with `file_path` and
`transform_matrix`; `camera_angle_x`, or `fl_x`, `fl_y`, `cx`, `cy`, for all frames or for each; and
ours: `state` (or `time`) of a frame.
"""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from model.reconstruct.cameras import OPENCV_FROM_OPENGL, Rig, Shot
from model.reconstruct.stated import (
    check_keys,
    file_name,
    lens,
    listed,
    number,
    numbers,
    positive,
    rigid_checked,
    state_of,
)

SUFFIXES = ("", ".png", ".jpg", ".jpeg", ".webp")
LEVEL = 1e-3
"""Height of a camera's right of length one, above which the camera is tilted sideways: scenes are
written to float32's 1e-6, and nobody holds all cameras to a twentieth of a degree."""
PHOTOGRAPHED = frozenset({"applied_transform", "orientation_override", "ply_file_path"})
"""Keys of nerfstudio, where it converts what COLMAP found of photographs."""
FRAME_PHOTOGRAPHED = frozenset({"colmap_im_id", "sharpness"})
"""Keys of a frame of nerfstudio and of instant-ngp there."""
DISTORTION = ("k1", "k2", "k3", "k4", "p1", "p2")


def rig_of_transforms(path: Path, stated: Mapping[str, Any], images: Path) -> Rig:
    """The rig of a `transforms.json`. Its world is z up and its front -y, as Blender's, unless it
    was made of photographs.

    Raises:
        ModelError: a key is missing or its value is not what it must be, an image has distortion,
            or only some frames have a time.
    """
    frames = listed(path, "frames", stated["frames"])
    for k, frame in enumerate(frames):
        if not isinstance(frame, Mapping):
            check_keys(path, frame, NEEDED, (), where=f"frames[{k}]")
    times = _times(path, frames)
    shots = tuple(
        _shot(path, stated, frame, f"frames[{k}]", images, times) for k, frame in enumerate(frames)
    )
    return Rig(file=path, shots=shots, front_stated=not _photographed(stated, shots))


def _photographed(stated: Mapping[str, Any], shots: Sequence[Shot]) -> bool:
    """Whether the cameras were found from photographs, in a world that may lie in any way: keys of
    converters tell, and cameras that are tilted sideways, as those of scenes are not."""
    tilted = any(abs(shot.camera_from_world[0, 2]) > LEVEL for shot in shots)
    marked = any(FRAME_PHOTOGRAPHED & frame.keys() for frame in stated["frames"])
    return tilted or marked or bool(PHOTOGRAPHED & stated.keys())


NEEDED = ("file_path", "transform_matrix")


def _times(path: Path, frames: Sequence[Mapping[str, Any]]) -> list[float]:
    """All different times, ascending; each is a state."""
    timed = [k for k, frame in enumerate(frames) if "time" in frame]
    if 0 < len(timed) < len(frames):
        first = next(k for k, frame in enumerate(frames) if "time" not in frame)
        raise ModelError(
            f"{path}: {len(timed)} of {len(frames)} frames have a time, frames[{first}] has none; "
            "give each a time, or none, and each a state instead"
        )
    return sorted({number(path, f"frames[{k}].time", frames[k]["time"]) for k in timed})


def _shot(
    path: Path,
    shared: Mapping[str, Any],
    frame: Mapping[str, Any],
    where: str,
    images: Path,
    times: list[float],
) -> Shot:
    for key in NEEDED:
        if key not in frame:
            raise ModelError(f"{path}: {where} has no {key!r}; needed: {', '.join(NEEDED)}")
    both = {**shared, **frame}
    image = _found(images, file_name(path, f"{where}.file_path", frame["file_path"]))
    bent = [
        key
        for key in DISTORTION
        if abs(number(path, f"{key} of {image}", both.get(key, 0.0))) > 1e-9
    ]
    if bent:
        raise ModelError(
            f"{path}: {image} has lens distortion ({', '.join(bent)}); undistort the images first"
        )
    pose = numbers(path, f"{where}.transform_matrix", frame["transform_matrix"], (4, 4))
    world_from_camera = rigid_checked(path, image, pose) @ OPENCV_FROM_OPENGL
    state = times.index(float(frame["time"])) if times else frame.get("state")
    mask = frame.get("mask_path")
    return Shot(
        image=image,
        state=state_of(path, image, state),
        intrinsics=lens(path, f"the lens of {image}", _intrinsics(path, both, images, image)),
        camera_from_world=inverted(world_from_camera),
        mask=None if mask is None else file_name(path, f"{where}.mask_path", mask),
    )


def _found(images: Path, name: str) -> str:
    """The image's name with the ending that the file omits."""
    clean = name.removeprefix("./")
    for suffix in SUFFIXES:
        if (images / f"{clean}{suffix}").is_file():
            return f"{clean}{suffix}"
    return clean


def _intrinsics(path: Path, both: Mapping[str, Any], images: Path, image: str) -> Floats:
    width, height = _size(path, both, images, image)
    if "fl_x" in both:
        x = positive(path, f"fl_x of {image}", both["fl_x"])
        y = positive(path, f"fl_y of {image}", both.get("fl_y", x))
    elif "camera_angle_x" in both:
        angle = positive(path, f"camera_angle_x of {image}", both["camera_angle_x"])
        if angle >= math.pi:
            raise ModelError(
                f"{path}: camera_angle_x of {image} is {angle:g}, expected radians, less than pi; "
                "a degree is pi / 180"
            )
        x = y = width / 2.0 / math.tan(angle / 2.0)
    else:
        raise ModelError(f"{path}: {image} has neither fl_x nor camera_angle_x; state one")
    middle = [
        number(path, f"{key} of {image}", both.get(key, side / 2.0))
        for key, side in (("cx", width), ("cy", height))
    ]
    return np.array([[x, 0.0, middle[0]], [0.0, y, middle[1]], [0.0, 0.0, 1.0]])


def _size(path: Path, both: Mapping[str, Any], images: Path, image: str) -> tuple[float, float]:
    """Width and height, px, as the file states them, or of the image."""
    if "w" in both and "h" in both:
        width = positive(path, f"w of {image}", both["w"])
        return width, positive(path, f"h of {image}", both["h"])
    try:
        with Image.open(images / image) as picture:
            return float(picture.width), float(picture.height)
    except OSError as error:
        raise ModelError(f"{path}: image {images / image} cannot be opened ({error})") from error
