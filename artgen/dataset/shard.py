"""Shards: plain tars that appear whole, each with an index for random access and a manifest.

`train-000000.tar` comes with `train-000000.index.parquet` (offset, size and CRC-32 of every member)
and `train-000000.json` (what the shard holds, with hashes). The sidecars are renamed into place
before the tar is, so a tar that is seen is complete and has its sidecars.
"""

import hashlib
import io
import json
import os
import tarfile
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from artgen.core.errors import ShardError
from artgen.core.jsonio import canonical_json, content_hash, file_hash
from artgen.dataset.members import EncodedSample

SHARD_SCHEMA = "artgen-shard/1"
_HEADER = 512
"""Bytes of a USTAR header; a member's data follow it."""
_INDEX_TYPES = pa.schema(
    [
        ("asset_id", pa.string()),
        ("names", pa.list_(pa.string())),
        ("offsets", pa.list_(pa.int64())),
        ("sizes", pa.list_(pa.int64())),
        ("crc32", pa.list_(pa.uint32())),
    ]
)


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where one member's bytes lie in a tar."""

    name: str
    offset: int
    size: int
    crc32: int


@dataclass(frozen=True, kw_only=True)
class ShardManifest:
    """What `<shard>.json` states.

    Attributes:
        file: name of the tar.
        bytes, sha256: of the tar.
        index_sha256: of the index sidecar.
        ids: asset ids in the order of the tar, ascending.
        ids_sha256: of the canonical JSON of `ids`.
        sources_sha256: of what the shard was packed from; equal sources need no repacking.
    """

    file: str
    bytes: int
    sha256: str
    index_sha256: str
    ids: tuple[str, ...]
    ids_sha256: str
    sources_sha256: str = ""
    samples: int = field(init=False)
    schema: str = SHARD_SCHEMA

    def __post_init__(self) -> None:
        object.__setattr__(self, "samples", len(self.ids))


def index_path(shard: Path) -> Path:
    """`train-000000.tar` -> `train-000000.index.parquet`."""
    return shard.with_suffix(".index.parquet")


def manifest_path(shard: Path) -> Path:
    """`train-000000.tar` -> `train-000000.json`."""
    return shard.with_suffix(".json")


def write_shard(
    path: Path, samples: Iterable[EncodedSample], *, sources_sha256: str = ""
) -> ShardManifest:
    """Write samples, in ascending order of asset id, to a tar at `path` with its sidecars.

    Equal samples give equal bytes. An older shard at `path` stays until the new one is complete.

    Raises:
        ShardError: ids repeat or descend, no sample is given, or the disk refuses; nothing is left
            behind then.
    """
    partials = {final: final.with_name(f"{final.name}.partial") for final in _files(path)}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        rows = _write_tar(partials[path], samples)
        _write_index(partials[index_path(path)], rows)
        manifest = _manifest(path, partials, list(rows), sources_sha256)
        partials[manifest_path(path)].write_text(canonical_json(manifest) + "\n")
        for partial in partials.values():
            _flush(partial)
        path.unlink(missing_ok=True)
        for final in _files(path):
            partials[final].replace(final)
        _flush(path.parent)
    except OSError as error:
        raise ShardError(
            f"{path}: cannot be written ({error.strerror or error}); free some space or choose "
            "another folder, then run the same command: complete shards are kept"
        ) from error
    finally:
        for partial in partials.values():
            partial.unlink(missing_ok=True)
    return manifest


def read_manifest(path: Path) -> ShardManifest:
    """The manifest beside a shard.

    Raises:
        ShardError: it is missing, unreadable, or of another schema.
    """
    place = manifest_path(path)
    try:
        facts: Mapping[str, Any] = json.loads(place.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise ShardError(
            f"{path}: {place.name} is missing beside it; copy the sidecars together with the tar, "
            "or pack again"
        ) from error
    except ValueError as error:
        raise ShardError(f"{place}: is not JSON ({error}); pack again") from error
    if facts.get("schema") != SHARD_SCHEMA:
        raise ShardError(
            f"{place}: shard schema is {facts.get('schema')!r}, this release reads "
            f"{SHARD_SCHEMA!r}; pack again from the samples, or use the release that wrote it"
        )
    try:
        return ShardManifest(
            file=facts["file"],
            bytes=facts["bytes"],
            sha256=facts["sha256"],
            index_sha256=facts["index_sha256"],
            ids=tuple(facts["ids"]),
            ids_sha256=facts["ids_sha256"],
            sources_sha256=facts["sources_sha256"],
        )
    except (KeyError, TypeError) as error:
        raise ShardError(f"{place}: lacks or misspells {error}; pack again") from error


def read_index(path: Path, manifest: ShardManifest) -> dict[str, tuple[Place, ...]]:
    """Asset id to the places of its members.

    Raises:
        ShardError: the index is missing or not the one that the manifest describes.
    """
    place = index_path(path)
    try:
        data = place.read_bytes()
    except FileNotFoundError as error:
        raise ShardError(
            f"{path}: {place.name} is missing beside it; copy the sidecars together with the tar, "
            "or pack again"
        ) from error
    if hashlib.sha256(data).hexdigest() != manifest.index_sha256:
        raise ShardError(
            f"{place}: its sha256 is not the one in {manifest_path(path).name}; one of the two is "
            "corrupt or from another packing: copy both again, or pack again"
        )
    return {row["asset_id"]: _places(row) for row in pq.read_table(io.BytesIO(data)).to_pylist()}


def verify_shard(path: Path) -> ShardManifest:
    """The manifest, after hashing every byte of the tar and its index.

    Raises:
        ShardError: any byte differs from what was written.
    """
    manifest = read_manifest(path)
    check_size(path, manifest)
    read_index(path, manifest)
    if (found := file_hash(path)) != manifest.sha256:
        raise ShardError(
            f"{path}: sha256 is {found[:12]}..., its manifest says {manifest.sha256[:12]}...; "
            "the tar is corrupt: copy it again, or pack again"
        )
    return manifest


def check_size(path: Path, manifest: ShardManifest) -> None:
    """Raise ShardError unless the tar is there with the manifest's size."""
    try:
        found = path.stat().st_size
    except FileNotFoundError as error:
        raise ShardError(
            f"{path}: is missing, only its sidecars are here; copy it again"
        ) from error
    if found != manifest.bytes:
        raise ShardError(
            f"{path}: is {found} bytes, its manifest says {manifest.bytes}; the copy is truncated "
            "or from another packing: copy it again, or pack again"
        )


def _files(path: Path) -> tuple[Path, Path, Path]:
    """In the order of their renaming; the tar comes last."""
    return index_path(path), manifest_path(path), path


def _write_tar(partial: Path, samples: Iterable[EncodedSample]) -> dict[str, tuple[Place, ...]]:
    rows: dict[str, tuple[Place, ...]] = {}
    last = ""
    with (
        partial.open("wb") as stream,
        tarfile.open(fileobj=stream, mode="w", format=tarfile.USTAR_FORMAT) as tar,
    ):
        for sample in samples:
            if sample.asset_id <= last:
                raise ShardError(
                    f"{partial.stem}: {sample.asset_id} comes after {last}; give every asset once, "
                    "in ascending order"
                )
            last = sample.asset_id
            rows[last] = tuple(_append(tar, sample.asset_id, *member) for member in sample.members)
    if not rows:
        raise ShardError(f"{partial.stem}: a shard needs at least one sample")
    return rows


def _append(tar: tarfile.TarFile, asset_id: str, name: str, data: bytes) -> Place:
    """One member; TarInfo's own defaults are mode 0644, no owner, and the epoch as its time."""
    info = tarfile.TarInfo(f"{asset_id}.{name}")
    info.size = len(data)
    place = Place(name=name, offset=tar.offset + _HEADER, size=len(data), crc32=zlib.crc32(data))
    tar.addfile(info, io.BytesIO(data))
    return place


def _write_index(partial: Path, rows: Mapping[str, Sequence[Place]]) -> None:
    table = pa.table(
        {
            "asset_id": list(rows),
            "names": [[place.name for place in places] for places in rows.values()],
            "offsets": [[place.offset for place in places] for places in rows.values()],
            "sizes": [[place.size for place in places] for places in rows.values()],
            "crc32": [[place.crc32 for place in places] for places in rows.values()],
        },
        schema=_INDEX_TYPES,
    )
    pq.write_table(table, partial, compression="zstd")


def _manifest(
    path: Path, partials: Mapping[Path, Path], ids: list[str], sources_sha256: str
) -> ShardManifest:
    return ShardManifest(
        file=path.name,
        bytes=partials[path].stat().st_size,
        sha256=file_hash(partials[path]),
        index_sha256=file_hash(partials[index_path(path)]),
        ids=tuple(ids),
        ids_sha256=content_hash(ids),
        sources_sha256=sources_sha256,
    )


def _places(row: Mapping[str, Any]) -> tuple[Place, ...]:
    columns = zip(row["names"], row["offsets"], row["sizes"], row["crc32"], strict=True)
    return tuple(
        Place(name=name, offset=offset, size=size, crc32=crc) for name, offset, size, crc in columns
    )


def _flush(path: Path) -> None:
    """Ask the disk to keep a file's bytes, or a folder's entries."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
