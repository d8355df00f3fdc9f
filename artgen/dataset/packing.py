"""Staged samples to shards; which asset lies where depends on the set of assets alone."""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.core.jsonio import content_hash
from artgen.dataset.contents import CONTENTS, Contents, listed, write_contents
from artgen.dataset.members import encoded
from artgen.dataset.reader import OpenShard, open_shard
from artgen.dataset.sample import Sample
from artgen.dataset.shard import ShardManifest, is_whole, write_shard
from artgen.dataset.split import SPLITS, split_of

PER_SHARD = 1000
"""Samples of one shard: 0.3 to 1 MB each at 128 px, so shards of the usual 0.3 to 1 GB."""
_OURS = re.compile(r"(train|val|test)-\d{6}(\.tar|\.json|\.index\.parquet)(\.partial)?")


@dataclass(frozen=True, kw_only=True)
class Packing:
    """What a folder of shards holds; `dataset.json` states it in short.

    Attributes:
        shards: manifests, by split and number.
        left_out: asset id to the reason why no shard holds it.
    """

    per_shard: int
    shards: tuple[ShardManifest, ...]
    left_out: Mapping[str, str]

    @property
    def shard_of(self) -> dict[str, str]:
        """Asset id to the name of its shard."""
        return {asset_id: shard.file for shard in self.shards for asset_id in shard.ids}

    @property
    def contents(self) -> Contents:
        """The packing without its asset ids, which each shard's own manifest lists."""
        return Contents(
            per_shard=self.per_shard,
            shards=tuple(map(listed, self.shards)),
            left_out=self.left_out,
        )


def stage(path: Path, sample: Sample) -> ShardManifest:
    """Write one sample to its own small shard, to be packed later; `path` ends in `.tar`."""
    return write_shard(path, [encoded(sample)])


def pack(
    staged: Iterable[Path],
    folder: Path,
    *,
    per_shard: int = PER_SHARD,
    left_out: Mapping[str, str] | None = None,
    advance: Callable[[str], None] = lambda note: None,
) -> Packing:
    """Pack staged samples into `<split>-<number>.tar` of at most `per_shard` samples each.

    Within a split, assets are sorted by id and cut into runs, so neither the order of `staged` nor
    of their making shows in a byte. Shards that are there already, whole and made from the same
    samples, are kept; others of our naming are removed first, so that no asset ever lies in two.
    `dataset.json` is written last.

    Args:
        staged: tars that `stage` wrote. One that does not open is left out and listed.
        left_out: assets known to be missing, with reasons; passed on to `dataset.json`.
        advance: called with a shard's name as each is done.
    """
    if per_shard < 1:
        raise ShardError(f"{per_shard} samples per shard pack nothing; ask for at least 1")
    sources, broken = _opened(staged)
    planned = _planned(sources, folder, per_shard)
    kept = {path: found for path, group in planned.items() if (found := _kept(path, group))}
    _clear(folder, keep=set(kept))
    shards = []
    for path, group in planned.items():
        shards.append(kept.get(path) or _packed(path, group))
        advance(path.stem)
    packing = Packing(
        per_shard=per_shard,
        shards=tuple(shards),
        left_out=dict(sorted({**(left_out or {}), **broken}.items())),
    )
    write_contents(folder, packing.contents)
    return packing


def shard_count(samples: Iterable[str], per_shard: int) -> int:
    """How many shards `pack` makes of these asset ids."""
    splits = [split_of(asset_id) for asset_id in samples]
    return sum(-(-splits.count(split) // per_shard) for split in SPLITS)


def _opened(staged: Iterable[Path]) -> tuple[dict[str, OpenShard], dict[str, str]]:
    """Samples by ascending asset id, and the reasons of those that do not open."""
    found: dict[str, OpenShard] = {}
    broken: dict[str, str] = {}
    for path in staged:
        try:
            shard = open_shard(path)
        except ShardError as error:
            broken[f"{path.parent.name}_{path.stem}"] = str(error)
            continue
        for asset_id in shard.manifest.ids:
            if asset_id in found:
                raise ShardError(
                    f"{path}: {asset_id} is in {found[asset_id].place} too; remove one"
                )
            found[asset_id] = shard
    return dict(sorted(found.items())), broken


def _planned(
    sources: Mapping[str, OpenShard], folder: Path, per_shard: int
) -> dict[Path, dict[str, OpenShard]]:
    planned = {}
    for split in SPLITS:
        ids = [asset_id for asset_id in sources if split_of(asset_id) == split]
        for number, start in enumerate(range(0, len(ids), per_shard)):
            group = {asset_id: sources[asset_id] for asset_id in ids[start : start + per_shard]}
            planned[folder / f"{split}-{number:06d}.tar"] = group
    return planned


def _digest(group: Mapping[str, OpenShard]) -> str:
    return content_hash([[asset_id, shard.manifest.sha256] for asset_id, shard in group.items()])


def _kept(path: Path, group: Mapping[str, OpenShard]) -> ShardManifest | None:
    """The manifest of a shard that is there, whole, and made from just these samples."""
    manifest = is_whole(path)
    return manifest if manifest and manifest.sources_sha256 == _digest(group) else None


def _packed(path: Path, group: Mapping[str, OpenShard]) -> ShardManifest:
    samples = (shard.raw(asset_id) for asset_id, shard in group.items())
    return write_shard(path, samples, sources_sha256=_digest(group))


def _clear(folder: Path, *, keep: set[Path]) -> None:
    """Remove `dataset.json` and every file of our naming that belongs to no kept shard."""
    (folder / CONTENTS).unlink(missing_ok=True)
    names = {path.stem for path in keep}
    for path in sorted(folder.glob("*")):
        if _OURS.fullmatch(path.name) and path.name.split(".")[0] not in names:
            path.unlink()
