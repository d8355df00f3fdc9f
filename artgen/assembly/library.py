"""The library's index: what each source can give and take, told without reading a mesh."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from artgen import __version__
from artgen.articulation.roles import ROLES
from artgen.assembly.handles import lie_of, turns_over
from artgen.assembly.looks import stuff_of
from artgen.assembly.piece import Piece
from artgen.assembly.shape_hash import shape_hash
from artgen.assembly.source import THINNEST, Member, Source
from artgen.assembly.store import read_source, write_source
from artgen.core.errors import UsageError
from artgen.core.jsonio import content_hash, file_hash, replace_atomically, write_json
from artgen.dataset.split import split_of

SCHEMA = "artgen-library/1"
MOST_PARTS = 8
"""Templates have at most so many parts, base included: what an ART sample holds."""
PER_PROCESS = 64
"""Sources that a process keeps in memory."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A row of the index: a base, a moving part, or nothing but its handle's measures with it.

    Attributes:
        number: place among the members of its source; -1 for the base.
        split: train, val or test; donors and templates of one object are of one split.
        parts: of its source, base included.
        width, depth, height: of the body's box, m.
        handle: along what its handle lies: x, z, round; empty where there is none.
        handle_x, handle_z: size of the handle, m.
        turns: the handle may be turned by 90 degrees.
        edge: the front itself is gripped: milled or cut out.
        stuffs: what its surfaces are, sorted and joined by blanks.
        shape, handle_shape: hashes of shapes in their own boxes.
        follows: its joint mimics another.
        needs: its joint waits for another to be open.
        on_base: its parent is the base.
    """

    source: str
    category: str
    dataset: str
    family: str
    split: str
    licence: str
    distributable: bool
    parts: int
    number: int
    name: str
    label: str
    kind: str
    side: str
    joint: str
    width: float
    depth: float
    height: float
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    handle: str
    handle_x: float
    handle_z: float
    turns: bool
    edge: bool
    stuffs: str
    shape: str
    handle_shape: str
    follows: bool
    needs: bool
    on_base: bool

    @property
    def is_base(self) -> bool:
        """Whether it is a source's fixed part."""
        return self.number < 0


TYPES = {
    str: pa.string(),
    bool: pa.bool_(),
    int: pa.int32(),
    float: pa.float64(),
    tuple[float, ...]: pa.list_(pa.float64()),
}
COLUMNS = pa.schema([(field.name, TYPES[field.type]) for field in fields(Entry)])  # type: ignore[index]


def entries_of(source: Source) -> Iterator[Entry]:
    """The rows of a source, base first."""
    waits = {rule.joint for rule in source.preconditions}
    yield _entry(source, source.base, number=-1, name=source.base_name, label="base")
    for number, member in enumerate(source.members):
        yield _entry(
            source,
            member.body,
            number=number,
            name=member.name,
            label=member.label,
            member=member,
            needs=member.joint.name in waits,
        )


def _entry(
    source: Source,
    body: Piece,
    *,
    number: int,
    name: str,
    label: str,
    member: Member | None = None,
    needs: bool = False,
) -> Entry:
    lower, upper = body.bounds
    width, depth, height = (float(side) for side in upper - lower)
    handle = member.handle if member else None
    size = np.zeros(3) if handle is None else np.diff(handle.bounds, axis=0)[0]
    return Entry(
        source=source.id,
        category=source.category,
        dataset=source.dataset,
        family=source.family,
        split=str(split_of(source.family)),
        licence=source.licence.id,
        distributable=source.licence.distributable,
        parts=1 + len(source.members),
        number=number,
        name=name,
        label=label,
        kind=member.kind if member else "base",
        side=member.side if member else "",
        joint=member.joint.type if member else "",
        width=width,
        depth=depth,
        height=height,
        lower=tuple(lower.tolist()),
        upper=tuple(upper.tolist()),
        handle="" if handle is None else lie_of(handle.bounds),
        handle_x=float(size[0]),
        handle_z=float(size[2]),
        turns=handle is not None and turns_over(handle),
        edge=any(grip.kind == "edge" for grip in body.grips),
        stuffs=" ".join(sorted({stuff_of(source.surfaces[k]) for k in body.slots})),
        shape=shape_hash(body.mesh),
        handle_shape="" if handle is None else shape_hash(handle.mesh),
        follows=member is not None and member.joint.mimic is not None,
        needs=needs,
        on_base=member is not None and member.joint.parent == source.base_name,
    )


def write_library(folder: Path, sources: Iterable[Source], *, recipe: object) -> str:
    """Write every source, then the index, then library.json; the digest of the whole."""
    added = []
    for source in sources:
        write_source(folder, source)
        added.append(source.id)
    return seal_library(folder, added, recipe=recipe)


def seal_library(folder: Path, ids: Iterable[str], *, recipe: object) -> str:
    """The index of sources that lie in the folder, then library.json; the digest of the whole.

    Of sources of one shape in two splits the later one's rows are left out, so that no shape is
    seen in both.

    Args:
        recipe: what the library is built from, as JSON; told in library.json.
    """
    rows: list[Entry] = []
    digests: dict[str, str] = {}
    for id in sorted(ids):
        rows += entries_of(read_source(folder, id))
        digests[id] = file_hash(folder / "sources" / f"{id}.json")
    rows = _without_shared(rows)
    table = pa.Table.from_pylist([asdict(row) for row in rows], schema=COLUMNS)
    replace_atomically(
        folder / "index.parquet", lambda path: pq.write_table(table, path, compression="zstd")
    )
    digest = content_hash({"schema": SCHEMA, "sources": digests})
    write_json(
        folder / "library.json",
        {"schema": SCHEMA, "artgen": __version__, "digest": digest, "recipe": recipe},
    )
    return digest


def _without_shared(rows: Sequence[Entry]) -> list[Entry]:
    """Rows of bodies whose shape has not been met in another split before."""
    owner = _first_splits((row.shape, row.split) for row in rows)
    return [row for row in rows if owner[row.shape] == row.split]


def _first_splits(met: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Shape to the first split that it is met in."""
    owner: dict[str, str] = {}
    for shape, split in met:
        owner.setdefault(shape, split)
    return owner


class Library:
    """A library opened for reading; sources are read when first asked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.digest = _digest(folder)
        table = pq.read_table(folder / "index.parquet")
        if table.schema.names != COLUMNS.names:
            raise UsageError(f"{folder}: its index has other columns; build the library anew")
        self.entries = tuple(_from_row(row) for row in table.to_pylist())
        self.source = lru_cache(maxsize=PER_PROCESS)(self._read)

    @cached_property
    def body_splits(self) -> Mapping[str, str]:
        """Shape of a body to the one split that offers it."""
        return _first_splits((e.shape, e.split) for e in self.entries)

    @cached_property
    def handle_splits(self) -> Mapping[str, str]:
        """Shape of a handle to the one split that offers it: that of its first source."""
        return _first_splits((e.handle_shape, e.split) for e in self.entries if e.handle)

    def _read(self, id: str) -> Source:
        return read_source(self.folder, id)

    def templates(self, categories: Iterable[str]) -> list[str]:
        """Ids of sources of some categories that can be templates: few parts, a front to change."""
        wanted = frozenset(categories)
        fronts = {e.source for e in self.entries if is_slot(e)}
        return [
            e.source
            for e in self.entries
            if e.is_base and e.category in wanted and e.parts <= MOST_PARTS and e.source in fronts
        ]

    def members(self, source: str) -> list[Entry]:
        """Rows of a source's moving parts, in canonical order."""
        return [e for e in self.entries if e.source == source and not e.is_base]


def is_slot(entry: Entry) -> bool:
    """Whether a donor may take the place of a template's part: it hangs on the base and moves by
    itself, a front can be told from what lies behind it or all of it goes, and it is no mere
    sheet."""
    solid = min(entry.width, entry.depth, entry.height) >= THINNEST
    opens = entry.side in ("out", "along", "left", "right", "bottom", "top", "rear")
    closes = entry.label in ROLES and ROLES[entry.label].closes
    own = solid and entry.on_base and not entry.follows
    return not entry.is_base and own and opens and closes


def _from_row(row: dict[str, object]) -> Entry:
    row["lower"], row["upper"] = tuple(row["lower"]), tuple(row["upper"])  # type: ignore[arg-type]
    return Entry(**row)  # type: ignore[arg-type]


def _digest(folder: Path) -> str:
    path = folder / "library.json"
    try:
        stated = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UsageError(
            f"{path} cannot be read ({error}); build it with artgen library build --out {folder}"
        ) from error
    if stated.get("schema") != SCHEMA:
        raise UsageError(f"{path} has schema {stated.get('schema')!r}, this artgen reads {SCHEMA}")
    return str(stated["digest"])
