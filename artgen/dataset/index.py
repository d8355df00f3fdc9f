"""The index of a shard: where every member's bytes lie, as Parquet that any tool opens.

One row per member, in the order of the tar: `asset_id`, `name` (without the asset id), `offset` (of
the data, past the header), `size`, `crc32c`.
"""

import hashlib
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import google_crc32c
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from artgen.core.errors import ShardError

COLUMNS = pa.schema(
    [
        ("asset_id", pa.string()),
        ("name", pa.string()),
        ("offset", pa.int64()),
        ("size", pa.int64()),
        ("crc32c", pa.uint32()),
    ]
)


_IMAGE = re.compile(r"s(\d+)v(\d+)\.")
"""How an image's name begins: its state and its view."""


class Place(NamedTuple):
    """Where one member's bytes lie in a tar, and their CRC-32C (Castagnoli)."""

    name: str
    offset: int
    size: int
    crc32c: int


class Index(Mapping[str, tuple[Place, ...]]):
    """Asset id to the places of its members; 24 bytes a member, unpacked when asked for."""

    def __init__(self, table: pa.Table) -> None:
        """Of a table with COLUMNS, its strings as dictionaries, the rows of an asset together."""
        table = table.unify_dictionaries()
        ids, names = (table[column].combine_chunks() for column in ("asset_id", "name"))
        code, words = np.asarray(ids.indices), ids.dictionary.to_pylist()
        ends = [0, *(np.flatnonzero(np.diff(code)) + 1).tolist(), len(code)]
        self._rows = {str(words[code[a]]): slice(a, b) for a, b in pairwise(ends)}
        self._name, self._names = np.asarray(names.indices), names.dictionary.to_pylist()
        self._numbers = tuple(table[column].to_numpy() for column in Place._fields[1:])
        found = [_IMAGE.match(name) for name in self._names]
        self._shot = np.array([(int(m[1]), int(m[2])) if m else (-1, -1) for m in found])

    def __getitem__(self, asset_id: str) -> tuple[Place, ...]:
        return self.chosen(asset_id)

    def __contains__(self, asset_id: object) -> bool:
        return asset_id in self._rows

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def chosen(
        self,
        asset_id: str,
        *,
        states: Sequence[int] | None = None,
        views: Sequence[int] | None = None,
    ) -> tuple[Place, ...]:
        """The members that these states and views need: the facts, and their own images."""
        rows = self._rows[asset_id]
        name, *numbers = (array[rows] for array in (self._name, *self._numbers))
        needed = np.ones(len(name), bool)
        for axis, wanted in enumerate((states, views)):
            if wanted is not None:
                needed &= np.isin(self._shot[name, axis], [-1, *wanted])
        names = [self._names[code] for code in name[needed].tolist()]
        columns = (array[needed].tolist() for array in numbers)
        return tuple(map(Place, names, *columns))


def crc32c(data: bytes) -> int:
    """CRC-32C of some bytes."""
    return int(google_crc32c.value(data))


def write_index(path: Path, rows: Mapping[str, tuple[Place, ...]]) -> None:
    """Parquet with a checksum on every page; equal rows give equal bytes."""
    flat = [(asset_id, *place) for asset_id, places in rows.items() for place in places]
    columns = zip(*flat, strict=True)
    table = pa.table(dict(zip(COLUMNS.names, map(list, columns), strict=True)), schema=COLUMNS)
    pq.write_table(
        table,
        path,
        compression="zstd",
        use_dictionary=["asset_id", "name"],
        column_encoding={"offset": "DELTA_BINARY_PACKED", "size": "DELTA_BINARY_PACKED"},
        write_page_checksum=True,
    )


def parsed_index(data: bytes, *, where: str, sha256: str) -> Index:
    """The index whose file holds `data`.

    Raises:
        ShardError: it is not the one with that sha256, or no index at all.
    """
    if hashlib.sha256(data).hexdigest() != sha256:
        raise ShardError(
            f"{where}: its sha256 is not the one in the manifest beside it; one of the two is "
            "corrupt or from another packing: copy both again, or pack again"
        )
    table = pq.read_table(
        io.BytesIO(data),
        read_dictionary=["asset_id", "name"],
        page_checksum_verification=True,
    )
    if table.column_names != COLUMNS.names or not len(table):
        raise ShardError(
            f"{where}: has columns {table.column_names}, expected {COLUMNS.names}; pack again"
        )
    return Index(table)
