"""Finished tasks on disk, so that an interrupted study goes on: rows as JSON, faces beside them."""

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.assembly_study.near import Face
from artgen.assembly_study.rows import Chunk, Row
from artgen.core.jsonio import plain, replace_atomically, write_json

FACES = ".npz"


def save_chunk(path: Path, chunk: Chunk) -> None:
    """The JSON file is written last: where it is, the chunk is whole."""
    path.parent.mkdir(parents=True, exist_ok=True)
    arrays = {
        f"{kind}_{face.index}": getattr(face, kind)
        for face in chunk.faces
        for kind in ("points", "sizes")
    }
    replace_atomically(path.with_suffix(FACES), lambda temporary: _write(temporary, arrays))
    write_json(path, plain(dataclasses.replace(chunk, faces=())))


def _write(path: Path, arrays: Mapping[str, NDArray[Any]]) -> None:
    with path.open("wb") as stream:
        np.savez_compressed(stream, **arrays)


def read_chunk(path: Path) -> Chunk:
    """What `save_chunk` wrote."""
    stated = json.loads(path.read_text(encoding="utf-8"))
    rows = tuple(Row(**row) for row in stated.pop("rows"))
    stated.pop("faces")
    with np.load(path.with_suffix(FACES)) as arrays:
        faces = tuple(
            Face(
                index=row.index,
                template=row.template,
                points=arrays[f"points_{row.index}"],
                sizes=arrays[f"sizes_{row.index}"],
            )
            for row in rows
            if row.accepted
        )
    return Chunk(rows=rows, faces=faces, **{key: tuple(v) for key, v in stated.items()})
