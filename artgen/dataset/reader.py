"""Reading shards: samples in order, or any one by position or asset id; every byte is checked."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from artgen.core.errors import ShardError
from artgen.dataset.contents import check_contents
from artgen.dataset.index import Index, Place, crc32c
from artgen.dataset.members import EncodedSample, decoded, sample_facts
from artgen.dataset.sample import Sample
from artgen.dataset.shard import (
    ShardManifest,
    check_size,
    read_index,
    read_manifest,
)
from artgen.dataset.store import Store, opened_store, split_place

OPEN_SHARDS = 16
"""Indexes that a dataset keeps in memory; each takes 24 bytes a member."""
_THREADS = 16
"""Manifests that are fetched side by side; matters for object stores."""


@dataclass(frozen=True)
class OpenShard:
    """A shard whose sidecars were read and found to fit; holds no file handle, so it pickles."""

    store: Store
    manifest: ShardManifest
    index: Index

    @property
    def place(self) -> str:
        """Path or URL of the tar."""
        return self.store.where(self.manifest.file)

    def read(
        self,
        asset_id: str,
        *,
        states: Sequence[int] | None = None,
        views: Sequence[int] | None = None,
    ) -> Sample:
        """The sample of an asset; only the bytes of the states and views asked for are read."""
        members = self.members(asset_id, states=states, views=views)
        return decoded(
            partial(self._named, asset_id, members),
            where=f"{self.place}: {asset_id}",
            states=states,
            views=views,
        )

    def members(
        self,
        asset_id: str,
        *,
        states: Sequence[int] | None = None,
        views: Sequence[int] | None = None,
    ) -> dict[str, bytes]:
        """Member name to its checked bytes: the facts, and the images asked for.

        Members that lie side by side are read at once.
        """
        return self._read(asset_id, self._places(asset_id, states, views))

    def facts(self, asset_id: str) -> Mapping[str, Any]:
        """What `meta.json` of an asset says, without touching its images."""
        places = [place for place in self._places(asset_id, [], []) if place.name == "meta.json"]
        read = partial(self._named, asset_id, self._read(asset_id, places))
        return sample_facts(read, where=f"{self.place}: {asset_id}")

    def raw(self, asset_id: str) -> EncodedSample:
        """The members as they are, checksums checked; packing needs no decoding."""
        return EncodedSample(asset_id=asset_id, members=tuple(self.members(asset_id).items()))

    def _places(
        self, asset_id: str, states: Sequence[int] | None, views: Sequence[int] | None
    ) -> tuple[Place, ...]:
        if asset_id not in self.index:
            first, last = self.manifest.ids[0], self.manifest.ids[-1]
            raise ShardError(f"{self.place}: holds no {asset_id}; it runs from {first} to {last}")
        return self.index.chosen(asset_id, states=states, views=views)

    def _read(self, asset_id: str, places: Sequence[Place]) -> dict[str, bytes]:
        ranges = [(place.offset, place.size) for place in places]
        try:
            found = self.store.ranges(self.manifest.file, ranges)
        except FileNotFoundError as error:
            raise ShardError(f"{self.place}: is gone since it was opened; copy it again") from error
        for place, data in zip(places, found, strict=True):
            self._check(asset_id, place, data)
        return {place.name: data for place, data in zip(places, found, strict=True)}

    def _check(self, asset_id: str, place: Place, data: bytes) -> None:
        if len(data) != place.size:
            raise ShardError(
                f"{self.place}: ends inside {asset_id}.{place.name} (offset {place.offset}, "
                f"{len(data)} of {place.size} bytes); the tar is truncated: copy it again"
            )
        if crc32c(data) != place.crc32c:
            raise ShardError(
                f"{self.place}: {asset_id}.{place.name} (offset {place.offset}, {place.size} bytes)"
                " fails its checksum; the tar is corrupt: copy it again, or `artgen shard repack`"
            )

    def _named(self, asset_id: str, members: Mapping[str, bytes], name: str) -> bytes:
        if name not in members:
            raise ShardError(f"{self.place}: {asset_id} has no member {name}; pack again")
        return members[name]


def open_shard(path: Path | str) -> OpenShard:
    """The shard at a path or URL, ready for random access.

    Raises:
        ShardError: a sidecar is missing, of another schema or of another packing, or the tar's size
            differs from the manifest's.
    """
    store, name = split_place(path)
    manifest = read_manifest(store, name)
    check_size(store.where(name), store.size(name), manifest)
    return OpenShard(store, manifest, read_index(store, name, manifest))


def read_shard(path: Path | str) -> Iterator[Sample]:
    """Samples of one shard, by ascending asset id.

    Raises:
        ShardError: the shard is truncated, corrupt, incomplete, or of another schema.
    """
    shard = open_shard(path)
    for asset_id in shard.manifest.ids:
        yield shard.read(asset_id)


class ShardDataset:
    """All samples of the shards in a folder or under a URL, as a sequence.

    `dataset[i]` is a whole Sample; `dataset.load(i, states=[0], views=[0, 2])` reads those bytes
    alone. Order: by shard name, then by asset id. It pickles, so worker processes may share it.
    Manifests are read at once; an index when a sample of its shard is first asked for.
    """

    def __init__(self, folder: Path | str, *, split: str | None = None) -> None:
        """Open `<split>-*.tar`, or every `*.tar`, of a folder or of `s3://bucket/prefix`.

        Raises:
            ShardError: there is none, a manifest is missing or corrupt, a tar is truncated, a shard
                that `dataset.json` lists is not here, or two shards hold one asset.
        """
        self._store = opened_store(folder)
        sizes = self._store.sizes()
        prefix = f"{split}-" if split else ""
        names = [name for name in sizes if name.startswith(prefix) and name.endswith(".tar")]
        with ThreadPoolExecutor(_THREADS) as pool:
            manifests = list(pool.map(partial(read_manifest, self._store), names))
        for name, manifest in zip(names, manifests, strict=True):
            check_size(self._store.where(name), sizes[name], manifest)
        if "dataset.json" in sizes:
            check_contents(self._store, manifests, prefix)
        if not names:
            raise ShardError(_nothing_to_read(folder, sorted(sizes), split))
        self._items = tuple((shard, name) for shard in manifests for name in shard.ids)
        self._position = {name: i for i, (_, name) in enumerate(self._items)}
        self._open: dict[str, OpenShard] = {}
        if len(self._position) < len(self._items):
            raise ShardError(
                f"{self._store.where()}: some assets lie in two shards; remove shards of an older "
                "packing, or pack again"
            )

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_open": {}}

    @property
    def ids(self) -> tuple[str, ...]:
        """Asset id of every position."""
        return tuple(name for _, name in self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __getitem__(self, position: int) -> Sample:
        return self.load(position)

    def load(
        self,
        position: int,
        *,
        states: Sequence[int] | None = None,
        views: Sequence[int] | None = None,
    ) -> Sample:
        """The sample at a position, restricted to some states and views where given."""
        shard, asset_id = self.shard(position)
        return shard.read(asset_id, states=states, views=views)

    def shard(self, position: int) -> tuple[OpenShard, str]:
        """The shard of a position, and the asset id."""
        manifest, asset_id = self._items[position]
        found = self._open.pop(manifest.file, None)
        if found is None:
            index = read_index(self._store, manifest.file, manifest)
            found = OpenShard(self._store, manifest, index)
        self._open[manifest.file] = found
        while len(self._open) > OPEN_SHARDS:
            self._open.pop(next(iter(self._open)), None)
        return found, asset_id

    def position(self, asset_id: str) -> int:
        """Where an asset's sample is.

        Raises:
            ShardError: no shard here holds it.
        """
        if asset_id not in self._position:
            raise ShardError(f"no shard holds {asset_id}; see the catalog for what is packed")
        return self._position[asset_id]


def _nothing_to_read(folder: Path | str, files: Sequence[str], split: str | None) -> str:
    """Why a place offers no sample, and what would help there."""
    inner = None if "://" in str(folder) else Path(folder) / "shards"
    kinds = Counter(name.partition("-")[0] for name in files if name.endswith(".tar"))
    wanted = f"{folder}: holds no {split or 'complete'} shard"
    if kinds:
        held = " and ".join(f"{count} of {kind}" for kind, count in sorted(kinds.items()))
        return (
            f"{wanted}, but {held}; each asset's name decides its split (8 of 10 are train, 1 val, "
            "1 test), so a few assets may all miss one: make more of them, then render and "
            "`artgen shard` again"
        )
    if inner is not None and any(inner.glob("*.tar")):
        return f"{wanted}; those of this run lie in {inner}: name that folder"
    if inner is not None and not inner.parent.is_dir():
        return f"{folder}: is no folder; name one of shards, such as OUT/shards of a run"
    return f"{wanted}; write some with `artgen shard`"
