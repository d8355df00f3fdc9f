"""Canonical JSON, content hashes and atomic writes: a file appears whole or not at all."""

import dataclasses
import hashlib
import json
import os
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from artgen.core.errors import ExportError


def plain(value: Any) -> Any:
    """Dataclasses, arrays, paths and tuples as JSON's own types."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {f.name: plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Path):
        return value.as_posix()
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value


def canonical_json(value: Any) -> str:
    """Sorted keys, no spaces, shortest exact floats; not-a-number is refused."""
    return json.dumps(plain(value), sort_keys=True, separators=(",", ":"), allow_nan=False)


def content_hash(value: Any) -> str:
    """sha256 of the canonical JSON, as 64 hex digits."""
    return hashlib.sha256(canonical_json(value).encode()).hexdigest()


def file_hash(path: Path) -> str:
    """sha256 of a file's bytes, as 64 hex digits."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def read_object(path: Path, *, remedy: str) -> dict[str, Any]:
    """The JSON object that a file of ours holds, such as the manifest of a bundle.

    Args:
        remedy: what to do where it cannot be read, for the message.

    Raises:
        ExportError: it is missing, damaged, or holds something else.
    """
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise ExportError(f"{path} cannot be read ({error}); {remedy}") from error
    if not isinstance(found, dict):
        raise ExportError(f"{path} cannot be read (it holds no JSON object); {remedy}")
    return found


def write_json(path: Path, value: Any) -> None:
    """Readable JSON (sorted, indented), atomically."""
    text = json.dumps(plain(value), sort_keys=True, indent=1, allow_nan=False) + "\n"
    write_bytes(path, text.encode())


def write_bytes(path: Path, data: bytes) -> None:
    """Write beside the place, flush to disk, rename."""

    def fill(partial: Path) -> None:
        with partial.open("wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())

    replace_atomically(path, fill)


def replace_atomically(path: Path, fill: Callable[[Path], None]) -> None:
    """Let `fill` write `PATH.partial`, then rename it to `path`; nothing half-written is ever
    seen."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f"{path.name}.partial")
    try:
        fill(partial)
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def fill_folder_atomically(folder: Path, fill: Callable[[Path], None]) -> None:
    """Let `fill` populate `FOLDER.partial`, flush every file, then rename it to `folder`.

    A stale partial folder of a killed run is removed first; an existing `folder` is replaced.
    """
    folder.parent.mkdir(parents=True, exist_ok=True)
    partial = folder.with_name(f"{folder.name}.partial")
    if partial.exists():
        shutil.rmtree(partial)
    partial.mkdir()
    try:
        fill(partial)
        for path in sorted(partial.rglob("*")):
            if path.is_file():
                with path.open("rb") as stream:
                    os.fsync(stream.fileno())
        if folder.exists():
            shutil.rmtree(folder)
        partial.rename(folder)
    finally:
        if partial.exists():
            shutil.rmtree(partial)
