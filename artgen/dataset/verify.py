"""Every byte of a shard against what was written; each damage with its shard, key and offset.

A tar holds nothing but members, whose CRC-32C the index keeps; headers, which follow from a
member's name and size; and zeros. So every byte of it has one right value, or is under a checksum.
"""

import hashlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from artgen.core.errors import ShardError
from artgen.dataset.contents import CONTENTS, read_contents
from artgen.dataset.index import Index, Place, crc32c
from artgen.dataset.shard import (
    HEADER,
    ShardManifest,
    header,
    index_name,
    manifest_name,
    read_index,
    read_manifest,
)
from artgen.dataset.store import Range, Store

_WINDOW = 64
"""Members that are read at once."""


@dataclass(frozen=True, kw_only=True)
class Damage:
    """One thing that is not as it was written.

    Attributes:
        shard: path or URL of the tar, or of `dataset.json`.
        key: the member, `<asset id>.<name>`, or the sidecar's name; empty for the tar's end.
        offset: where it lies in the tar, bytes; in a header or in zeros, the first wrong byte. 0 in
            a sidecar, which is damaged as a whole.
    """

    shard: str
    key: str
    offset: int
    reason: str

    def __str__(self) -> str:
        return f"{self.shard}: {self.key or 'end of the tar'} (offset {self.offset}): {self.reason}"


def damages(store: Store, name: str) -> Iterator[Damage]:
    """What is wrong with a shard and its sidecars; nothing if it is whole."""
    where, sidecar = store.where(name), manifest_name(name)
    try:
        manifest = read_manifest(store, name)
        sidecar = index_name(name)
        index = read_index(store, name, manifest)
    except ShardError as error:
        yield Damage(shard=where, key=sidecar, offset=0, reason=str(error))
        return
    size = store.size(name)
    if size is None:
        reason = "the tar is missing, only its sidecars are here"
        yield Damage(shard=where, key="", offset=0, reason=reason)
    else:
        yield from _tar_damages(store, name, manifest, index, size)


def folder_damages(
    store: Store, advance: Callable[[str], None] = lambda note: None
) -> Iterator[Damage]:
    """What is wrong with the shards of a folder, and with their list.

    Args:
        advance: called with a shard's name as each is done.
    """
    names = shard_names(store)
    for name in names:
        yield from damages(store, name)
        advance(name.removesuffix(".tar"))
    if store.size(CONTENTS) is None:
        return
    try:
        listed = read_contents(store).shards
    except ShardError as error:
        yield Damage(shard=store.where(CONTENTS), key=CONTENTS, offset=0, reason=str(error))
        return
    for shard in listed:
        if shard.file not in names:
            reason = f"{CONTENTS} lists it, but neither it nor a sidecar is here"
            yield Damage(shard=store.where(shard.file), key="", offset=0, reason=reason)


def shard_names(store: Store) -> list[str]:
    """Tars of a folder, those too of which only the manifest is left."""
    names = store.sizes()
    tars = {name for name in names if name.endswith(".tar")}
    indexed = {name.removesuffix(".index.parquet") for name in names if "." in name}
    tars |= {f"{stem}.tar" for stem in indexed if f"{stem}.index.parquet" in names}
    return sorted(tars)


def _tar_damages(
    store: Store, name: str, manifest: ShardManifest, index: Index, size: int
) -> Iterator[Damage]:
    where, digest, found, end = store.where(name), hashlib.sha256(), 0, 0
    places = ((asset_id, place) for asset_id in index for place in index[asset_id])
    while window := list(islice(places, _WINDOW)):
        spans = [_span(place, size) for _, place in window]
        for (asset_id, place), data in zip(window, store.ranges(name, spans), strict=True):
            digest.update(data)
            key = f"{asset_id}.{place.name}"
            for offset, reason in _member_damages(key, place, data):
                found += 1
                yield Damage(shard=where, key=key, offset=offset, reason=reason)
        end = sum(spans[-1])
    (tail,) = store.ranges(name, [(end, size - end)]) if size > end else (b"",)
    digest.update(tail)
    if tail.strip(b"\0"):
        found += 1
        yield Damage(shard=where, key="", offset=end + _first(tail), reason="is not zero")
    elif size != manifest.bytes and size >= end:
        found += 1
        reason = f"the tar is {size} bytes, its manifest says {manifest.bytes}"
        yield Damage(shard=where, key="", offset=size, reason=reason)
    if not found and digest.hexdigest() != manifest.sha256:
        reason = f"sha256 is {digest.hexdigest()[:12]}..., its manifest says another"
        yield Damage(shard=where, key="", offset=0, reason=reason)


def _span(place: Place, end: int) -> Range:
    """Of a member with its header and its padding, cut at the end of the tar."""
    start, stop = place.offset - HEADER, place.offset + place.size + _padding(place)
    return min(start, end), max(0, min(stop, end) - start)


def _padding(place: Place) -> int:
    return -place.size % HEADER


def _member_damages(key: str, place: Place, data: bytes) -> Iterator[tuple[int, str]]:
    """Offset in the tar and reason."""
    start = place.offset - HEADER
    stop = HEADER + place.size
    if len(data) < stop + _padding(place):
        yield start + len(data), "the tar ends here; it is truncated"
        return
    expected = np.frombuffer(header(key, place.size), np.uint8)
    wrong = np.flatnonzero(np.frombuffer(data[:HEADER], np.uint8) != expected)
    if wrong.size:
        yield start + int(wrong[0]), "its header is not the one that was written"
    if crc32c(data[HEADER:stop]) != place.crc32c:
        yield place.offset, f"its {place.size} bytes fail their checksum"
    if data[stop:].strip(b"\0"):
        yield start + stop + _first(data[stop:]), "the padding after it is not zero"


def _first(data: bytes) -> int:
    """Where the first byte that is not zero lies."""
    return len(data) - len(data.lstrip(b"\0"))
