"""The index of a shard: where every member's bytes lie, as Parquet that any tool opens.

One row per member, in the order of the tar: `asset_id`, `name` (without the asset id), `offset` (of
the data, past the header), `size`, `crc32c`.
"""

import hashlib
import io
from collections.abc import Iterator, Mapping
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
        table = table.unify_dictionaries().combine_chunks()
        ids = table["asset_id"].combine_chunks()
        code, words = np.asarray(ids.indices), ids.dictionary.to_pylist()
        ends = [0, *(np.flatnonzero(np.diff(code)) + 1).tolist(), len(code)]
        self._rows = {str(words[code[a]]): slice(a, b) for a, b in pairwise(ends)}
        self._table = table.drop_columns(["asset_id"])

    def __getitem__(self, asset_id: str) -> tuple[Place, ...]:
        rows = self._rows[asset_id]
        part = self._table.slice(rows.start, rows.stop - rows.start)
        columns = (part[name].to_pylist() for name in Place._fields)
        return tuple(map(Place, *columns))

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)


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
