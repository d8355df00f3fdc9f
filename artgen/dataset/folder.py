"""A run's folder to its shards and catalog: what `artgen shard` does."""

import json
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.dataset.catalog import write_catalog
from artgen.dataset.listing import listed_assets
from artgen.dataset.packing import PER_SHARD, Packing, pack
from artgen.dataset.terms import forget_terms, refuse_bound, terms_of, write_terms
from artgen.progress import Show, silent


@dataclass(frozen=True, kw_only=True)
class Sharded:
    """What `shard_folder` made, and where."""

    packing: Packing
    shards: Path
    catalog: tuple[Path, Path]


def shard_folder(
    out: Path,
    *,
    per_shard: int = PER_SHARD,
    show: Show = silent,
    public: bool = False,
) -> Sharded:
    """Pack `samples/<category>/<index>.tar` of every valid asset into `shards/`, write `catalog/`.

    Failed assets and assets without a sample are left out and listed in `shards/dataset.json`;
    `shards/terms.json` says under which licences the others are.

    Args:
        public: the set is to be handed on.

    Raises:
        ShardError: nothing can be packed, a sample is corrupt, the disk refuses, or the set is
            public and an asset may not be handed on.
    """
    staged, left_out = packable(out)
    if not staged:
        raise ShardError(
            f"{out}: holds no sample of a valid asset; make some with `artgen generate` or "
            "`artgen render`"
        )
    terms = terms_of(asset for asset in listed_assets(out) if asset.valid and asset.sample.exists())
    if public:
        refuse_bound(out, terms.bound)
    forget_terms(out / "shards")
    packing = pack(staged, out / "shards", per_shard=per_shard, left_out=left_out, show=show)
    write_terms(out / "shards", terms)
    return Sharded(packing=packing, shards=out / "shards", catalog=write_catalog(out, packing))


def packable(out: Path) -> tuple[list[Path], dict[str, str]]:
    """Staged samples of valid assets, and the reason for every asset that has none."""
    staged: list[Path] = []
    left_out: dict[str, str] = {}
    for asset in listed_assets(out):
        if asset.valid and asset.sample.exists():
            staged.append(asset.sample)
        elif asset.valid or asset.bundle.parent.parent != out / "failed":
            left_out[asset.asset_id] = "not rendered"
        else:
            left_out[asset.asset_id] = _failure(asset.bundle)
    return staged, left_out


def _failure(folder: Path) -> str:
    """The first finding of a failed asset's report, or the error that stopped it."""
    report, error = folder / "report.json", folder / "error.json"
    if report.exists():
        findings = json.loads(report.read_text(encoding="utf-8"))["findings"]
        return "; ".join(f"{f['check']}: {f['part']}: {f['cause']}" for f in findings[:1])
    if error.exists():
        return str(json.loads(error.read_text(encoding="utf-8"))["error"])
    return "failed without a report"
