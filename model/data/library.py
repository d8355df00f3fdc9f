"""A library: many soups in one npz file, some kB each."""

import io
import json
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any, overload
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.types import Joint, Precondition
from artgen.core.errors import ModelError
from artgen.core.jsonio import canonical_json, plain, write_bytes
from artgen.core.mesh import Floats
from artgen.export.bundle import read_joint
from model.data.soup import LOOK, Soup

SCHEMA = "artgen-soups/1"
STEPS = 65535
"""Positions are whole steps of the box around an object: 15 micrometres a meter."""
_COUNTS = ("parts", "vertices", "faces", "bodies", "looks", "facts")
_COLUMNS = {
    "bounds": (np.float64, (2, 3)),
    "box": (np.float64, (2, 3)),
    "sphere": (np.float64, (4,)),
    "place": (np.uint16, (3,)),
    "corner": (np.uint16, (3,)),
    "body_faces": (np.uint16, ()),
    "body_part": (np.uint8, ()),
    "body_surface": (np.uint8, ()),
    "look": (np.float32, (LOOK,)),
    "fact": (np.uint8, ()),
}
"""What every row holds; `place` and `corner` lie in the file as differences, which pack well."""
_ROW = {
    "bounds": "parts",
    "place": "vertices",
    "corner": "faces",
    "body_faces": "bodies",
    "body_part": "bodies",
    "body_surface": "bodies",
    "look": "looks",
    "fact": "facts",
}
"""What a column has a row for each of; the others have one for each soup."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Library(Sequence[Soup]):
    """Soups by position, unpacked when asked for.

    Attributes:
        columns: arrays of all soups one after another, as `_COLUMNS` says.
        starts: (N + 1, 6) first row of each soup among parts, vertices, faces, bodies, looks and
            bytes of facts.
        ids: asset id of every position.
        categories: of every position.
        made: what it was asked for, as JSON has it; empty where it was put together by hand.
    """

    columns: dict[str, NDArray[Any]]
    starts: NDArray[np.int64]
    ids: tuple[str, ...]
    categories: tuple[str, ...]
    made: Mapping[str, object] = field(default_factory=dict)

    @property
    def part_counts(self) -> NDArray[np.int64]:
        """(N,) parts of every soup."""
        return np.diff(self.starts[:, 0])

    def __len__(self) -> int:
        return len(self.ids)

    @overload
    def __getitem__(self, position: int) -> Soup: ...
    @overload
    def __getitem__(self, position: slice) -> list[Soup]: ...
    def __getitem__(self, position: int | slice) -> Soup | list[Soup]:
        """One soup, or some."""
        if isinstance(position, slice):
            return [self[k] for k in range(*position.indices(len(self)))]
        return self._soup(range(len(self))[position])

    def donors(self, k: int) -> tuple[str, ...]:
        """Ids of the assets whose parts a soup borrows."""
        return tuple(self._facts(k)["donors"])

    def _facts(self, k: int) -> dict[str, Any]:
        first, last = self.starts[k : k + 2, _COUNTS.index("facts")]
        facts = json.loads(self.columns["fact"][first:last].tobytes())
        return {"donors": (), **facts}

    def _soup(self, k: int) -> Soup:
        def rows(kind: str, column: str) -> NDArray[Any]:
            place = _COUNTS.index(kind)
            return self.columns[column][self.starts[k, place] : self.starts[k + 1, place]]

        facts = self._facts(k)
        lower, upper = self.columns["box"][k]
        sphere = self.columns["sphere"][k]
        places = rows("vertices", "place").astype(np.float64) / STEPS
        counts = rows("bodies", "body_faces")
        return Soup(
            asset_id=self.ids[k],
            category=self.categories[k],
            parts=tuple(facts["parts"]),
            joints=tuple(read_joint(joint) for joint in facts["joints"]),
            preconditions=tuple(Precondition(**rule) for rule in facts["preconditions"]),
            donors=tuple(facts["donors"]),
            bounds=rows("parts", "bounds"),
            center=sphere[:3],
            radius=float(sphere[3]),
            vertices=(lower + places * (upper - lower)).astype(np.float32),
            faces=rows("faces", "corner").astype(np.int32),
            part=np.repeat(rows("bodies", "body_part"), counts),
            body=np.repeat(np.arange(len(counts)), counts).astype(np.uint16),
            surface=np.repeat(rows("bodies", "body_surface"), counts),
            looks=rows("looks", "look"),
        )


def packed(soups: Sequence[Soup]) -> Library:
    """The soups as a library, positions rounded to its steps.

    Raises:
        ModelError: a soup has more vertices than 16 bits can name, or there is none.
    """
    if not soups:
        raise ModelError("a library of no soup; name a category and a count")
    pieces = [_pieces(soup) for soup in soups]
    counts = [[0] * len(_COUNTS), *(count for _, count in pieces)]
    return Library(
        columns={name: np.concatenate([piece[name] for piece, _ in pieces]) for name in _COLUMNS},
        starts=np.cumsum(np.array(counts, np.int64), axis=0),
        ids=tuple(soup.asset_id for soup in soups),
        categories=tuple(soup.category for soup in soups),
    )


def _pieces(soup: Soup) -> tuple[dict[str, NDArray[Any]], list[int]]:
    if len(soup.vertices) > STEPS:
        raise ModelError(
            f"{soup.asset_id}: {len(soup.vertices)} vertices, at most {STEPS} fit; simplify it "
            "with a larger tolerance"
        )
    box = np.stack([soup.vertices.min(axis=0), soup.vertices.max(axis=0)]).astype(np.float64)
    first = np.flatnonzero(np.diff(soup.body.astype(np.int64), prepend=-1))
    facts = {
        "parts": soup.parts,
        "joints": [_stated(joint) for joint in soup.joints],
        "preconditions": soup.preconditions,
        **({"donors": soup.donors} if soup.donors else {}),
    }
    pieces: dict[str, NDArray[Any]] = {
        "bounds": soup.bounds,
        "box": box[None],
        "sphere": np.array([[*soup.center, soup.radius]]),
        "place": _steps(soup.vertices, box),
        "corner": soup.faces.astype(np.uint16),
        "body_faces": np.diff(first, append=len(soup.faces)).astype(np.uint16),
        "body_part": soup.part[first],
        "body_surface": soup.surface[first],
        "look": soup.looks,
        "fact": np.frombuffer(canonical_json(facts).encode(), np.uint8),
    }
    counts = [
        *(len(soup.parts), len(soup.vertices), len(soup.faces)),
        *(len(first), len(soup.looks), len(pieces["fact"])),
    ]
    return pieces, counts


def _stated(joint: Joint) -> dict[str, Any]:
    """A joint as a manifest states it."""
    limit = joint.limit
    ends = {"lower": limit and limit.lower, "upper": limit and limit.upper}
    return {**{key: value for key, value in plain(joint).items() if key != "limit"}, **ends}


def _steps(vertices: NDArray[np.float32], box: Floats) -> NDArray[np.uint16]:
    extent = box[1] - box[0]
    share = (vertices - box[0]) / np.where(extent > 0.0, extent, 1.0)
    steps: NDArray[np.uint16] = np.rint(STEPS * share).astype(np.uint16)
    return steps


def write_library(path: Path, library: Library) -> None:
    """Write one npz file, atomically; equal libraries give equal bytes."""
    names = {
        "schema": SCHEMA,
        "ids": library.ids,
        "categories": library.categories,
        "made": library.made,
    }
    stored = dict(library.columns)
    for name in ("place", "corner"):
        # Differences between neighbors, column by column, take 40 % fewer bytes; 16 bits wrap.
        stored[name] = np.diff(library.columns[name].T, prepend=np.uint16(0))
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        names=np.frombuffer(canonical_json(names).encode(), np.uint8),
        starts=library.starts,
        **stored,
    )
    write_bytes(path, buffer.getvalue())


def read_library(path: Path) -> Library:
    """The library in a file.

    Raises:
        ModelError: there is no such file, it is truncated, or of another schema.
    """
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
        names = json.loads(arrays.pop("names").tobytes())
        starts = arrays.pop("starts")
        for name in ("place", "corner"):
            arrays[name] = np.cumsum(arrays[name], axis=1, dtype=np.uint16).T.copy()
    except FileNotFoundError as error:
        raise ModelError(
            f"{path}: no such library; make one with `artgen train-data --out {path}`"
        ) from error
    except (OSError, ValueError, KeyError, EOFError, BadZipFile, zlib.error) as error:
        raise ModelError(
            f"{path}: is no library of training objects ({error}); name a file that `artgen "
            "train-data` wrote, or have it made again if it is truncated"
        ) from error
    if names.get("schema") != SCHEMA or arrays.keys() != _COLUMNS.keys():
        raise ModelError(
            f"{path}: schema {names.get('schema')!r}, expected {SCHEMA!r}; make it again with "
            "`artgen train-data`"
        )
    return Library(
        columns={name: arrays[name].astype(kind) for name, (kind, _) in _COLUMNS.items()},
        starts=starts,
        ids=tuple(names["ids"]),
        categories=tuple(names["categories"]),
        made=names["made"],
    )


def library_made(path: Path) -> Mapping[str, object]:
    """What a library in a file was asked for; its objects are not read.

    Raises:
        ModelError: there is no such file, or it is none of ours.
    """
    try:
        with np.load(path, allow_pickle=False) as stored:
            made: Mapping[str, object] = json.loads(stored["names"].tobytes())["made"]
    except (OSError, ValueError, KeyError, EOFError, BadZipFile, zlib.error) as error:
        raise ModelError(f"{path}: is no library of training objects ({error})") from error
    return made


def taken(library: Library, positions: Sequence[int]) -> Library:
    """Some of its soups, bit for bit, in the order of the positions."""
    return joined([_alone(library, k) for k in positions])


def _alone(library: Library, k: int) -> Library:
    first, last = library.starts[k], library.starts[k + 1]
    columns = {}
    for name, column in library.columns.items():
        kind = _ROW.get(name)
        place = slice(k, k + 1) if kind is None else _rows(kind, first, last)
        columns[name] = column[place]
    return Library(
        columns=columns,
        starts=np.stack([np.zeros_like(first), last - first]),
        ids=library.ids[k : k + 1],
        categories=library.categories[k : k + 1],
    )


def _rows(kind: str, first: NDArray[np.int64], last: NDArray[np.int64]) -> slice:
    place = _COUNTS.index(kind)
    return slice(int(first[place]), int(last[place]))


def joined(libraries: Sequence[Library], *, made: Mapping[str, object] | None = None) -> Library:
    """One library of all, in order."""
    first = np.cumsum(
        [np.zeros(len(_COUNTS), np.int64), *(part.starts[-1] for part in libraries)], 0
    )
    return Library(
        columns={
            name: np.concatenate([part.columns[name] for part in libraries]) for name in _COLUMNS
        },
        starts=np.concatenate(
            [first[:1], *(part.starts[1:] + at for part, at in zip(libraries, first, strict=False))]
        ),
        ids=tuple(chain.from_iterable(part.ids for part in libraries)),
        categories=tuple(chain.from_iterable(part.categories for part in libraries)),
        made=made or {},
    )
