"""Camera files: our own JSON, NeRF's `transforms.json`, COLMAP's text; all become `Shot`s.

A shot says which image is seen from where and in which state of the object. Its camera has OpenCV
axes (x right, y down, z forward), whatever the file's were.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from artgen.core.errors import ModelError, did_you_mean
from artgen.core.mesh import Floats
from model.reconstruct.stated import (
    check_keys,
    file_name,
    lens,
    listed,
    numbers,
    positive,
    quoted,
    rigid_checked,
    state_of,
)

SCHEMA = "artgen-cameras/1"
OPENCV_FROM_OPENGL = np.diag([1.0, -1.0, -1.0, 1.0])
CONVENTIONS: Mapping[str, Floats] = {"opencv": np.eye(4), "opengl": OPENCV_FROM_OPENGL}
"""Word in a file to what takes its camera axes to OpenCV's."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shot:
    """One image and the camera that took it.

    Attributes:
        image: relative to the folder of the images.
        state: number of the object's state.
        intrinsics: (3, 3) px; the middle of the first pixel is (0.5, 0.5).
        camera_from_world: (4, 4) rigid, OpenCV axes, in the file's unit of length.
        mask: of the foreground, relative to the same folder; None where alpha tells it.
    """

    image: str
    state: int
    intrinsics: Floats
    camera_from_world: Floats
    mask: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Rig:
    """All shots of one object.

    Attributes:
        front_stated: whether z of the world is up and -y the object's front; else the first camera
            stands there, and what the network says decides.
        center: (3,) middle of the object's sphere in the world; None where it is not stated.
        radius: of that sphere, in the file's unit; None likewise.
        meters: one unit of length in m.
    """

    file: Path
    shots: tuple[Shot, ...]
    front_stated: bool = True
    center: Floats | None = None
    radius: float | None = None
    meters: float = 1.0


def rig_of_own_json(path: Path, stated: Mapping[str, Any]) -> Rig:
    """A rig in artgen's own format; `docs/reconstruct.md` describes it.

    Raises:
        ModelError: a key is missing or unknown, or its value is not what it must be.
    """
    check_keys(path, stated, ("schema", "views"), OPTIONAL)
    center, radius = stated.get("center"), stated.get("radius")
    views = listed(path, "views", stated["views"])
    return Rig(
        file=path,
        shots=tuple(_shot(path, f"views[{k}]", view) for k, view in enumerate(views)),
        center=None if center is None else numbers(path, "center", center, (3,)),
        radius=None if radius is None else positive(path, "radius", radius),
        meters=positive(path, "meters_per_unit", stated.get("meters_per_unit", 1.0)),
    )


OPTIONAL = ("center", "radius", "meters_per_unit")
VIEW = ("image", "intrinsics", "camera_from_world")
VIEW_OPTIONAL = ("state", "mask", "convention")


def _shot(path: Path, where: str, view: Mapping[str, Any]) -> Shot:
    check_keys(path, view, VIEW, VIEW_OPTIONAL, where=where)
    image, mask = file_name(path, f"{where}.image", view["image"]), view.get("mask")
    pose = numbers(path, f"{where}.camera_from_world", view["camera_from_world"], (4, 4))
    matrix = numbers(path, f"{where}.intrinsics", view["intrinsics"], (3, 3))
    return Shot(
        image=image,
        state=state_of(path, image, view.get("state")),
        intrinsics=lens(path, f"{where}.intrinsics", matrix),
        camera_from_world=rigid_checked(path, where, _opencv_axes(path, where, view) @ pose),
        mask=None if mask is None else file_name(path, f"{where}.mask", mask),
    )


def _opencv_axes(path: Path, where: str, view: Mapping[str, Any]) -> Floats:
    """(4, 4) from the axes that a view states."""
    word = view.get("convention", "opencv")
    if not isinstance(word, str) or word not in CONVENTIONS:
        known = list(CONVENTIONS)
        near = did_you_mean(str(word).lower(), known)
        raise ModelError(
            f"{path}: {where}.convention is {quoted(word)}{near}, expected one of "
            f"{', '.join(known)}, in small letters"
        )
    return CONVENTIONS[word]
