"""Shards: plain tars that appear whole, each with an index for random access and a manifest.

`train-000000.tar` comes with `train-000000.index.parquet` (offset, size and CRC-32C of every
member) and `train-000000.json` (what the shard holds, with hashes). The sidecars are renamed into
place before the tar is, so a tar that is seen is complete and has its sidecars.
"""

import io
import os
import tarfile
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.core.jsonio import canonical_json, file_hash
from artgen.dataset.index import Index, Place, crc32c, parsed_index, write_index
from artgen.dataset.members import EncodedSample
from artgen.dataset.sealed import sealed, unsealed
from artgen.dataset.store import LocalStore, Store

SHARD_SCHEMA = "artgen-shard/2"
HEADER = 512
"""Bytes of a USTAR header; a member's data follow it."""


@dataclass(frozen=True, kw_only=True)
class ShardManifest:
    """What `<shard>.json` states.

    Attributes:
        file: name of the tar.
        bytes, sha256: of the tar.
        index_sha256: of the index sidecar.
        ids: asset ids in the order of the tar, ascending.
        sources_sha256: of what the shard was packed from; equal sources need no repacking.
    """

    file: str
    bytes: int
    sha256: str
    index_sha256: str
    ids: tuple[str, ...]
    sources_sha256: str = ""
    samples: int = field(init=False)
    schema: str = SHARD_SCHEMA

    def __post_init__(self) -> None:
        object.__setattr__(self, "samples", len(self.ids))


def manifest_text(manifest: ShardManifest) -> str:
    """The content of `<shard>.json`."""
    return canonical_json(sealed(asdict(manifest))) + "\n"


def index_name(shard: str) -> str:
    """`train-000000.tar` -> `train-000000.index.parquet`."""
    return shard.removesuffix(".tar") + ".index.parquet"


def manifest_name(shard: str) -> str:
    """`train-000000.tar` -> `train-000000.json`."""
    return shard.removesuffix(".tar") + ".json"


def index_path(shard: Path) -> Path:
    """The index beside a local shard."""
    return shard.with_name(index_name(shard.name))


def manifest_path(shard: Path) -> Path:
    """The manifest beside a local shard."""
    return shard.with_name(manifest_name(shard.name))


def header(member: str, size: int) -> bytes:
    """The 512 bytes before a member, which follow from its name and size alone."""
    return _info(member, size).tobuf(tarfile.USTAR_FORMAT)


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
        write_index(partials[index_path(path)], rows)
        manifest = _manifest(path, partials, list(rows), sources_sha256)
        partials[manifest_path(path)].write_text(manifest_text(manifest))
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


def read_manifest(store: Store, name: str) -> ShardManifest:
    """The manifest beside a shard.

    Raises:
        ShardError: it is missing, corrupt, or of another schema.
    """
    place = store.where(manifest_name(name))
    data = _sidecar(store, name, manifest_name(name))
    facts = unsealed(data, where=place, schema=SHARD_SCHEMA)
    return ShardManifest(
        file=facts["file"],
        bytes=facts["bytes"],
        sha256=facts["sha256"],
        index_sha256=facts["index_sha256"],
        ids=tuple(facts["ids"]),
        sources_sha256=facts["sources_sha256"],
    )


def read_index(store: Store, name: str, manifest: ShardManifest) -> Index:
    """Asset id to the places of its members.

    Raises:
        ShardError: the index is missing or not the one that the manifest describes.
    """
    data = _sidecar(store, name, index_name(name))
    where = store.where(index_name(name))
    index = parsed_index(data, where=where, sha256=manifest.index_sha256)
    if tuple(index) != manifest.ids:
        raise ShardError(f"{where}: lists other assets than the manifest; pack again")
    return index


def check_size(where: str, found: int | None, manifest: ShardManifest) -> None:
    """Raise ShardError unless a tar is there with the manifest's size."""
    if found is None:
        raise ShardError(f"{where}: is missing, only its sidecars are here; copy it again")
    if found != manifest.bytes:
        raise ShardError(
            f"{where}: is {found} bytes, its manifest says {manifest.bytes}; the copy is truncated "
            "or from another packing: copy it again, or pack again"
        )


def is_whole(path: Path) -> ShardManifest | None:
    """The manifest of a local shard all of whose bytes are what was written, else None."""
    store = LocalStore(path.parent)
    try:
        manifest = read_manifest(store, path.name)
        read_index(store, path.name, manifest)
    except ShardError:
        return None
    return manifest if path.exists() and file_hash(path) == manifest.sha256 else None


def _sidecar(store: Store, name: str, sidecar: str) -> bytes:
    try:
        return store.read(sidecar)
    except FileNotFoundError as error:
        raise ShardError(
            f"{store.where(name)}: {sidecar} is missing beside it; copy the sidecars together with "
            "the tar, or pack again"
        ) from error


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
    place = Place(name=name, offset=tar.offset + HEADER, size=len(data), crc32c=crc32c(data))
    tar.addfile(_info(f"{asset_id}.{name}", len(data)), io.BytesIO(data))
    return place


def _info(member: str, size: int) -> tarfile.TarInfo:
    """TarInfo's own defaults are mode 0644, no owner, and the epoch as its time."""
    info = tarfile.TarInfo(member)
    info.size = size
    return info


def _manifest(
    path: Path, partials: Mapping[Path, Path], ids: list[str], sources_sha256: str
) -> ShardManifest:
    return ShardManifest(
        file=path.name,
        bytes=partials[path].stat().st_size,
        sha256=file_hash(partials[path]),
        index_sha256=file_hash(partials[index_path(path)]),
        ids=tuple(ids),
        sources_sha256=sources_sha256,
    )


def _flush(path: Path) -> None:
    """Ask the disk to keep a file's bytes, or a folder's entries."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
