"""Reading shards: samples in order, or any one by position or asset id; every byte is checked."""

import os
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from artgen.core.errors import ShardError
from artgen.dataset.members import EncodedSample, decoded, sample_facts
from artgen.dataset.sample import Sample
from artgen.dataset.shard import Place, ShardManifest, check_size, read_index, read_manifest


@dataclass(frozen=True)
class OpenShard:
    """A shard whose sidecars were read and found to fit; holds no file handle, so it pickles."""

    path: Path
    manifest: ShardManifest
    index: dict[str, tuple[Place, ...]]

    def read(
        self,
        asset_id: str,
        *,
        states: Sequence[int] | None = None,
        views: Sequence[int] | None = None,
    ) -> Sample:
        """The sample of an asset; only the bytes of the states and views asked for are read."""
        with self._opened(asset_id) as read:
            return decoded(read, where=f"{self.path}: {asset_id}", states=states, views=views)

    def facts(self, asset_id: str) -> Mapping[str, Any]:
        """What `meta.json` of an asset says, without touching its images."""
        with self._opened(asset_id) as read:
            return sample_facts(read, where=f"{self.path}: {asset_id}")

    def raw(self, asset_id: str) -> EncodedSample:
        """The members as they are, checksums checked; packing needs no decoding."""
        with self._opened(asset_id) as read:
            members = tuple((place.name, read(place.name)) for place in self._places(asset_id))
        return EncodedSample(asset_id=asset_id, members=members)

    @contextmanager
    def _opened(self, asset_id: str) -> Iterator[Callable[[str], bytes]]:
        """A function from member name to its checked bytes."""
        places = {place.name: place for place in self._places(asset_id)}
        handle = os.open(self.path, os.O_RDONLY)

        def read(name: str) -> bytes:
            if name not in places:
                raise ShardError(f"{self.path}: {asset_id} has no member {name}; pack again")
            return self._member(handle, asset_id, places[name])

        try:
            yield read
        finally:
            os.close(handle)

    def _places(self, asset_id: str) -> tuple[Place, ...]:
        if asset_id not in self.index:
            first, last = self.manifest.ids[0], self.manifest.ids[-1]
            raise ShardError(f"{self.path}: holds no {asset_id}; it runs from {first} to {last}")
        return self.index[asset_id]

    def _member(self, handle: int, asset_id: str, place: Place) -> bytes:
        data = os.pread(handle, place.size, place.offset)
        if len(data) != place.size:
            raise ShardError(
                f"{self.path}: ends inside {asset_id}.{place.name} (offset {place.offset}, "
                f"{len(data)} of {place.size} bytes); the tar is truncated: copy it again"
            )
        if zlib.crc32(data) != place.crc32:
            raise ShardError(
                f"{self.path}: {asset_id}.{place.name} (offset {place.offset}, {place.size} bytes) "
                "fails its checksum; the tar is corrupt: copy it again, or pack again"
            )
        return data


def open_shard(path: Path) -> OpenShard:
    """The shard at `path`, ready for random access.

    Raises:
        ShardError: a sidecar is missing, of another schema or of another packing, or the tar's size
            differs from the manifest's.
    """
    manifest = read_manifest(path)
    check_size(path, manifest)
    index = read_index(path, manifest)
    if tuple(index) != manifest.ids:
        raise ShardError(f"{path}: index and manifest list different assets; pack again")
    return OpenShard(path, manifest, index)


def read_shard(path: Path) -> Iterator[Sample]:
    """Samples of one shard, by ascending asset id.

    Raises:
        ShardError: the shard is truncated, corrupt, incomplete, or of another schema.
    """
    shard = open_shard(path)
    for asset_id in shard.manifest.ids:
        yield shard.read(asset_id)


class ShardDataset:
    """All samples of the shards in a folder, as a sequence.

    `dataset[i]` is a whole Sample; `dataset.load(i, states=[0], views=[0, 2])` reads those bytes
    alone. Order: by shard name, then by asset id. It pickles, so worker processes may share it.
    """

    def __init__(self, folder: Path, *, split: str | None = None) -> None:
        """Open `<split>-*.tar`, or every `*.tar`.

        Raises:
            ShardError: there is none, one does not open (see `open_shard`), or two hold one asset.
        """
        paths = sorted(folder.glob(f"{split}-*.tar" if split else "*.tar"))
        if not paths:
            raise ShardError(
                f"{folder}: holds no {split or 'complete'} shard; write some with `artgen shard`"
            )
        self._shards = tuple(open_shard(path) for path in paths)
        self._items = tuple((shard, name) for shard in self._shards for name in shard.manifest.ids)
        self._position = {name: i for i, (_, name) in enumerate(self._items)}
        if len(self._position) < len(self._items):
            raise ShardError(
                f"{folder}: some assets lie in two shards; remove shards of an older packing, or "
                "pack again"
            )

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
        shard, asset_id = self._items[position]
        return shard.read(asset_id, states=states, views=views)

    def position(self, asset_id: str) -> int:
        """Where an asset's sample is.

        Raises:
            ShardError: no shard here holds it.
        """
        if asset_id not in self._position:
            raise ShardError(f"no shard holds {asset_id}; see the catalog for what is packed")
        return self._position[asset_id]
