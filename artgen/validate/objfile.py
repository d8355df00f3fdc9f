"""A lean OBJ reader: whole columns at once, as most of a validation's time is reading meshes."""

import warnings
from pathlib import Path

import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints, TriMesh

BODY = b"\n# body "


def read_triangles(path: Path) -> TriMesh:
    """The OBJ's vertices, triangles, texture coordinates (as `atlas`) and bodies.

    Reads what artgen writes: blocks of `v`, `vt`, `vn`, then a comment a body and its `f` lines.

    Raises:
        GeometryError: a block is missing, ragged, or holds what is not a number, or a face names a
            vertex that does not exist.
    """
    text = path.read_bytes()
    vertices = _table(path, _block(text, b"v"), b"v", 3)
    texture = _table(path, _block(text, b"vt"), b"vt", 2)
    groups = text[text.index(BODY) :].split(BODY)[1:] if BODY in text else []
    corners, counts = _faces(path, groups)
    if len(corners) and corners[..., 1].max() >= len(texture):
        raise GeometryError(f"{path.name}: a face names texture point {corners[..., 1].max() + 1}")
    body = np.repeat(np.arange(len(counts)), counts)
    try:
        return TriMesh(
            vertices=vertices, faces=corners[..., 0], atlas=texture[corners[..., 1]], body=body
        )
    except GeometryError as error:
        raise GeometryError(f"{path.name}: {error}") from error


def _block(text: bytes, keyword: bytes) -> bytes:
    """The lines from the first to the last that start with a keyword."""
    start = text.find(b"\n" + keyword + b" ")
    if start < 0:
        return b""
    end = text.rfind(b"\n" + keyword + b" ")
    return text[start : text.index(b"\n", end + 1)]


def _table(path: Path, block: bytes, keyword: bytes, columns: int) -> Floats:
    """(N, columns) numbers of a block of lines."""
    values = _numbers(block.replace(b"\n" + keyword + b" ", b" "), np.float64)
    if values is None or len(values) == 0 or len(values) % columns:
        raise GeometryError(
            f"{path.name}: its `{keyword.decode()}` lines do not hold {columns} numbers each; "
            "export the asset anew"
        )
    return np.asarray(values.reshape(-1, columns), np.float64)


def _faces(path: Path, groups: list[bytes]) -> tuple[Ints, list[int]]:
    """(F, 3, 3) zero-based v, vt, vn indices, and how many triangles each group has."""
    counts = [group.count(b"\nf ") for group in groups]
    lines = b" ".join(group.partition(b"\n")[2] for group in groups)
    plain = lines.translate(bytes.maketrans(b"f/\n", b"   "))
    values = _numbers(plain, np.int64)
    if values is None or len(values) != 9 * sum(counts) or not sum(counts):
        raise GeometryError(
            f"{path.name}: its faces are not groups of `f v/vt/vn v/vt/vn v/vt/vn`; "
            "export the asset anew"
        )
    return np.asarray(values.reshape(-1, 3, 3) - 1, np.int32), counts


def _numbers(text: bytes, kind: type[np.float64] | type[np.int64]) -> np.ndarray | None:  # type: ignore[type-arg]
    """Blank-separated numbers, or None where a word is not one."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)  # numpy's way to say "stopped early".
        try:
            return np.fromstring(text.decode("ascii"), dtype=kind, sep=" ")
        except (DeprecationWarning, UnicodeDecodeError):
            return None
