"""Camera files: our own JSON, NeRF's `transforms.json`, COLMAP's text; all become `Shot`s.

A shot says which image is seen from where and in which state of the object. Its camera has OpenCV
axes (x right, y down, z forward), whatever the file's were.
"""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from artgen.core.errors import ModelError, did_you_mean
from artgen.core.mesh import Floats

SCHEMA = "artgen-cameras/1"
Convention = Literal["opencv", "opengl"]
OPENCV_FROM_OPENGL = np.diag([1.0, -1.0, -1.0, 1.0])
STATE_WORD = re.compile(r"(?:^|[/_-])state[_-]?(\d+)(?=[/_.-]|$)", re.IGNORECASE)


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
        upright: whether the world is the object's: z up, front -y; else it is turned so.
        center: (3,) middle of the object's sphere in the world; None where it is not stated.
        radius: of that sphere, in the file's unit; None likewise.
        meters: one unit of length in m.
    """

    file: Path
    shots: tuple[Shot, ...]
    upright: bool = True
    center: Floats | None = None
    radius: float | None = None
    meters: float = 1.0


def read_json(path: Path) -> Mapping[str, Any]:
    """The object that a JSON file holds.

    Raises:
        ModelError: it cannot be read.
    """
    try:
        stated = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ModelError(f"{path}: cannot be read as cameras ({error})") from error
    if not isinstance(stated, dict):
        raise ModelError(f"{path}: holds a {type(stated).__name__}, expected a JSON object")
    return stated


def rig_of_own_json(path: Path, stated: Mapping[str, Any]) -> Rig:
    """A rig in artgen's own format; `docs/reconstruct.md` describes it.

    Raises:
        ModelError: a key is missing, unknown, or no such matrix.
    """
    check_keys(path, stated, ("schema", "views"), OPTIONAL)
    center, radius = stated.get("center"), stated.get("radius")
    return Rig(
        file=path,
        shots=tuple(_shot(path, k, view) for k, view in enumerate(stated["views"])),
        center=None if center is None else numbers(path, "center", center, (3,)),
        radius=None if radius is None else positive(path, "radius", radius),
        meters=positive(path, "meters_per_unit", stated.get("meters_per_unit", 1.0)),
    )


OPTIONAL = ("center", "radius", "meters_per_unit")
VIEW = ("image", "intrinsics", "camera_from_world")
VIEW_OPTIONAL = ("state", "mask", "convention")


def _shot(path: Path, number: int, view: Mapping[str, Any]) -> Shot:
    where = f"views[{number}]"
    check_keys(path, view, VIEW, VIEW_OPTIONAL, where=where)
    pose = numbers(path, f"{where}.camera_from_world", view["camera_from_world"], (4, 4))
    if view.get("convention", "opencv") == "opengl":
        pose = OPENCV_FROM_OPENGL @ pose
    return Shot(
        image=str(view["image"]),
        state=state_of(str(view["image"]), view.get("state")),
        intrinsics=numbers(path, f"{where}.intrinsics", view["intrinsics"], (3, 3)),
        camera_from_world=rigid_checked(path, where, pose),
        mask=view.get("mask"),
    )


def state_of(image: str, stated: object) -> int:
    """The stated number, or that of `state_1/` or `state1_` in the image's name, or 0."""
    if isinstance(stated, int | float) and float(stated).is_integer():
        return int(stated)
    found = STATE_WORD.search(image)
    return int(found[1]) if found else 0


def check_keys(
    path: Path,
    stated: Mapping[str, Any],
    needed: Sequence[str],
    optional: Sequence[str],
    *,
    where: str = "",
) -> None:
    """Raise ModelError unless all needed keys and no unknown ones are there."""
    place = f"{path}: {where}" if where else str(path)
    if not isinstance(stated, Mapping):
        raise ModelError(f"{place} is no JSON object")
    for key in needed:
        if key not in stated:
            raise ModelError(f"{place} has no {key!r}; needed: {', '.join(needed)}")
    known = [*needed, *optional]
    for key in stated:
        if key not in known:
            raise ModelError(
                f"{place} has an unknown key {key!r}{did_you_mean(key, known)}; "
                f"known: {', '.join(known)}"
            )


def numbers(path: Path, what: str, value: object, shape: tuple[int, ...]) -> Floats:
    """An array of a shape.

    Raises:
        ModelError: it is not, or a number is not finite.
    """
    try:
        array = np.array(value, float)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != shape or not np.isfinite(array).all():
        raise ModelError(f"{path}: {what} is no {shape} array of finite numbers")
    return array


def positive(path: Path, what: str, value: object) -> float:
    """A number above zero.

    Raises:
        ModelError: it is none.
    """
    number = float(numbers(path, what, value, ()))
    if number <= 0.0:
        raise ModelError(f"{path}: {what} is {number:g}, expected more than 0")
    return number


ORTHOGONAL = 1e-3
"""How far a rotation may be off: text of four digits."""


def rigid_checked(path: Path, where: str, pose: Floats) -> Floats:
    """The pose with its rotation made exact.

    Raises:
        ModelError: it scales, shears, mirrors or projects.
    """
    turn = pose[:3, :3]
    off = float(np.abs(turn @ turn.T - np.eye(3)).max())
    mirrored = float(np.linalg.det(turn)) < 0.0
    if off > ORTHOGONAL or mirrored or np.abs(pose[3] - (0, 0, 0, 1)).max() > ORTHOGONAL:
        what = "mirrors" if mirrored else f"is off a rotation by {off:.2g}"
        raise ModelError(
            f"{path}: the pose of {where} {what}; expected a rotation and a shift, the last row "
            "0 0 0 1"
        )
    u, _, v = np.linalg.svd(turn)
    exact = np.eye(4)
    exact[:3, :3], exact[:3, 3] = u @ v, pose[:3, 3]
    return exact
