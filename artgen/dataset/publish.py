"""Shards to an object store, so that of two packings one wins and readers see whole shards only.

1. `dataset.json` goes up first, on the condition that there is none (`If-None-Match: *`). Whoever
   finds another packing's there has lost, and has changed nothing. `terms.json` follows in the same
   way, so that no shard is there without what says whether it may be handed on.
2. Of every shard the index and the tar go up, then the manifest, again conditionally.

A publisher that died is finished by the same command, by anybody who holds the same bytes; readers
refuse a prefix where a listed shard's manifest is missing.
"""

from collections.abc import Callable
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.dataset.contents import CONTENTS, ListedShard, read_contents
from artgen.dataset.shard import check_size, index_name, is_whole, manifest_name, read_manifest
from artgen.dataset.store import LocalStore, Target, opened_target
from artgen.dataset.terms import TERMS


def publish(
    folder: Path, url: str, *, advance: Callable[[str], None] = lambda note: None
) -> tuple[ListedShard, ...]:
    """Copy a packed folder of shards to `url`, such as `s3://bucket/prefix`; the shards there.

    Args:
        advance: called with a shard's name as each is done.

    Raises:
        ShardError: packing has not finished, a shard is corrupt, another packing is there, or the
            store refuses.
        UsageError: `url` is none, or the `s3` extra is not installed.
    """
    target, source = opened_target(url), LocalStore(folder)
    shards = read_contents(source).shards
    for shard in shards:
        if is_whole(folder / shard.file) is None:
            raise ShardError(
                f"{folder / shard.file}: is not whole; see `artgen shard verify {folder}`"
            )
    _put_once(target, CONTENTS, source.read(CONTENTS))
    if (folder / TERMS).exists():
        _put_once(target, TERMS, source.read(TERMS))
    for shard in shards:
        if not _is_there(target, source, shard.file):
            target.put(index_name(shard.file), folder / index_name(shard.file))
            target.put(shard.file, folder / shard.file)
            _put_once(target, manifest_name(shard.file), source.read(manifest_name(shard.file)))
        advance(shard.file.removesuffix(".tar"))
    return shards


def _put_once(target: Target, name: str, content: bytes) -> None:
    """Write an object that is the same for every publisher of this packing."""
    if not target.put_new(name, content) and target.read(name) != content:
        raise ShardError(
            f"{target.where(name)}: is from another packing, which came first; nothing of it was "
            "changed: publish to another prefix, or remove that one"
        )


def _is_there(target: Target, source: LocalStore, name: str) -> bool:
    """True when a shard's manifest, which is written last, is there and is ours."""
    try:
        found = read_manifest(target, name)
    except ShardError:
        return False
    check_size(target.where(name), target.size(name), found)
    return found == read_manifest(source, name)
