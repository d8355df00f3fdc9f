"""What camera files state, checked: words, numbers, lenses, poses and states.

Every message names the file, the place in it, what is there, and what was expected.
"""

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from artgen.core.errors import ModelError, did_you_mean
from artgen.core.mesh import Floats

STATE_WORD = re.compile(r"(?:^|[/_-])state[_-]?(\d+)(?=[/_.-]|$)", re.IGNORECASE)
ORTHOGONAL = 1e-3
"""How far a rotation may be off: text of four digits."""
SHOWN = 60
"""Letters of a wrong value that a message quotes."""


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


def quoted(value: object) -> str:
    """A wrong value as a message shows it."""
    text = repr(value)
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}..."


def check_keys(
    path: Path,
    stated: object,
    needed: Sequence[str],
    optional: Sequence[str],
    *,
    where: str = "",
) -> None:
    """Raise ModelError unless all needed keys and no unknown ones are there."""
    place = f"{path}: {where}" if where else str(path)
    if not isinstance(stated, Mapping):
        raise ModelError(
            f"{place} is {quoted(stated)}, expected a JSON object with {', '.join(needed)}"
        )
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


def listed(path: Path, what: str, value: object) -> list[Any]:
    """A list that holds something.

    Raises:
        ModelError: it is none.
    """
    if not isinstance(value, list) or not value:
        raise ModelError(
            f"{path}: {what} is {quoted(value)}, expected a list with an entry for every image"
        )
    return value


def file_name(path: Path, what: str, value: object) -> str:
    """The name of a file.

    Raises:
        ModelError: it is no text, or empty.
    """
    if not isinstance(value, str) or not value:
        raise ModelError(
            f"{path}: {what} is {quoted(value)}, expected the name of a file in quotes"
        )
    return value


def numbers(path: Path, what: str, value: object, shape: tuple[int, ...]) -> Floats:
    """An array of a shape.

    Raises:
        ModelError: it is not, or a number is not finite; numbers in quotes are words.
    """
    try:
        array = np.array(value)
    except ValueError:
        array = np.array(None)
    if array.dtype.kind not in "iuf" or array.shape != shape or not np.isfinite(array).all():
        expected = f"is no {shape} array of finite numbers" if shape else "is no finite number"
        raise ModelError(
            f"{path}: {what} {expected}, but {quoted(value)}; write numbers without quotes, or "
            "leave out what is optional"
        )
    return array.astype(np.float64)


def number(path: Path, what: str, value: object) -> float:
    """A finite number.

    Raises:
        ModelError: it is none.
    """
    return float(numbers(path, what, value, ()))


def positive(path: Path, what: str, value: object) -> float:
    """A number above zero.

    Raises:
        ModelError: it is none.
    """
    found = number(path, what, value)
    if found <= 0.0:
        raise ModelError(f"{path}: {what} is {found:g}, expected more than 0")
    return found


def lens(path: Path, what: str, matrix: Floats) -> Floats:
    """(3, 3) intrinsics of a pinhole, px.

    Raises:
        ModelError: a focal length is not above zero, or the matrix is no pinhole's.
    """
    focal, below = (matrix[0, 0], matrix[1, 1]), (matrix[1, 0], *matrix[2] - (0.0, 0.0, 1.0))
    if not min(focal) > 0.0 or max(map(abs, below)) > 1e-9:
        raise ModelError(
            f"{path}: {what} is {quoted(matrix.tolist())}, no pinhole; expected [[fx, skew, cx], "
            "[0, fy, cy], [0, 0, 1]] in px with fx and fy above 0"
        )
    return matrix


def rigid_checked(path: Path, where: str, pose: Floats) -> Floats:
    """The pose with its rotation made exact.

    Raises:
        ModelError: it scales, shears, mirrors or projects, or is not finite.
    """
    if not np.isfinite(pose).all():
        raise ModelError(f"{path}: the pose of {where} holds what is no finite number; mend it")
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


def state_of(path: Path, image: str, stated: object) -> int:
    """The stated number, or, where None is stated, that of `state_1/` or `state1_` in the image's
    name, or 0.

    Raises:
        ModelError: what is stated is no whole number.
    """
    if stated is None:
        found = STATE_WORD.search(image)
        return int(found[1]) if found else 0
    if isinstance(stated, bool) or not isinstance(stated, int | float) or stated != stated // 1:
        raise ModelError(
            f"{path}: the state of {image} is {quoted(stated)}, expected a whole number without "
            "quotes: 0, 1 ..."
        )
    return int(stated)
