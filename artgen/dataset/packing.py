"""Staged samples to shards; which asset lies where depends on the set of assets alone."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.core.jsonio import content_hash
from artgen.dataset.contents import CONTENTS, Contents, listed, write_contents
from artgen.dataset.members import encoded
from artgen.dataset.reader import OpenShard, open_shard
from artgen.dataset.sample import Sample
from artgen.dataset.shard import ShardManifest, is_whole, write_shard
from artgen.dataset.split import SPLITS, Split, divided, split_of
from artgen.progress import Show, silent

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


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Which sample goes into which shard.

    Attributes:
        groups: by the shard's path, asset id to the shard that holds the sample now.
    """

    folder: Path
    per_shard: int
    groups: Mapping[Path, Mapping[str, OpenShard]]
    left_out: Mapping[str, str]


def pack(
    staged: Iterable[Path],
    folder: Path,
    *,
    per_shard: int = PER_SHARD,
    left_out: Mapping[str, str] | None = None,
    show: Show = silent,
) -> Packing:
    """Pack staged samples into `<split>-<number>.tar` of at most `per_shard` samples each.

    Within a split, assets are sorted by id and cut into runs, so neither the order of `staged` nor
    of their making shows in a byte. Shards that are there already, whole and made from the same
    samples, are kept; others of our naming are removed first, so that no asset ever lies in two.
    `dataset.json` is written last.

    Args:
        staged: tars that `stage` wrote. One that does not open is left out and listed.
        left_out: assets known to be missing, with reasons; passed on to `dataset.json`.
        show: reports progress, as `artgen.progress.progress` does.
    """
    sources, broken = _opened(staged)
    missing = {**(left_out or {}), **broken}
    return carry_out(planned(sources, folder, per_shard=per_shard, left_out=missing), show=show)


def planned(
    sources: Iterable[OpenShard], folder: Path, *, per_shard: int, left_out: Mapping[str, str]
) -> Plan:
    """Where the samples of these shards go; those whose donors lie in two splits are left out.

    Raises:
        ShardError: two shards hold one asset, or `per_shard` is less than 1.
    """
    if per_shard < 1:
        raise ShardError(f"{per_shard} samples per shard pack nothing; ask for at least 1")
    homes: dict[str, OpenShard] = {}
    by_split: dict[Split, list[str]] = {split: [] for split in SPLITS}
    missing = dict(left_out)
    for shard in sources:
        for asset_id in shard.manifest.ids:
            if asset_id in homes:
                raise ShardError(
                    f"{shard.place}: {asset_id} is in {homes[asset_id].place} too; remove one"
                )
            homes[asset_id] = shard
            donors = shard.facts(asset_id)["donors"]
            split = split_of(asset_id, donors)
            if split is None:
                missing[asset_id] = divided(donors)
            else:
                by_split[split].append(asset_id)
    groups = {
        folder / f"{split}-{number:06d}.tar": {name: homes[name] for name in ids}
        for split, names in by_split.items()
        for number, ids in enumerate(_cut(sorted(names), per_shard))
    }
    left = dict(sorted(missing.items()))
    return Plan(folder=folder, per_shard=per_shard, groups=groups, left_out=left)


def carry_out(plan: Plan, *, show: Show = silent) -> Packing:
    """Make the shards of a plan that are not there yet, and their list."""
    kept = {path: found for path, group in plan.groups.items() if (found := _kept(path, group))}
    _clear(plan.folder, keep=set(kept))
    shards = []
    with show("shards", len(plan.groups)) as advance:
        for path, group in plan.groups.items():
            shards.append(kept.get(path) or write_group(path, group))
            advance(path.stem)
    packing = Packing(per_shard=plan.per_shard, shards=tuple(shards), left_out=plan.left_out)
    write_contents(plan.folder, packing.contents)
    return packing


def write_group(path: Path, group: Mapping[str, OpenShard]) -> ShardManifest:
    """Write one shard of a plan."""
    samples = (shard.raw(asset_id) for asset_id, shard in group.items())
    return write_shard(path, samples, sources_sha256=_digest(group))


def _opened(staged: Iterable[Path]) -> tuple[list[OpenShard], dict[str, str]]:
    """Staged samples, and the reasons of those that do not open."""
    found: list[OpenShard] = []
    broken: dict[str, str] = {}
    for path in staged:
        try:
            found.append(open_shard(path))
        except ShardError as error:
            broken[f"{path.parent.name}_{path.stem}"] = str(error)
    return found, broken


def _cut(names: list[str], per_shard: int) -> list[list[str]]:
    return [names[start : start + per_shard] for start in range(0, len(names), per_shard)]


def _digest(group: Mapping[str, OpenShard]) -> str:
    """Of the members' names, sizes and checksums, wherever they lie."""
    return content_hash(
        [
            [asset_id, [(place.name, place.size, place.crc32c) for place in shard.index[asset_id]]]
            for asset_id, shard in group.items()
        ]
    )


def _kept(path: Path, group: Mapping[str, OpenShard]) -> ShardManifest | None:
    """The manifest of a shard that is there, whole, and made from just these samples."""
    manifest = is_whole(path)
    return manifest if manifest and manifest.sources_sha256 == _digest(group) else None


def _clear(folder: Path, *, keep: set[Path]) -> None:
    """Remove `dataset.json` and every file of our naming that belongs to no kept shard."""
    (folder / CONTENTS).unlink(missing_ok=True)
    names = {path.stem for path in keep}
    for path in sorted(folder.glob("*")):
        if _OURS.fullmatch(path.name) and path.name.split(".")[0] not in names:
            path.unlink()
