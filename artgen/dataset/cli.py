"""`artgen shard`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import UsageError
from artgen.dataset.folder import packable, shard_folder
from artgen.dataset.packing import PER_SHARD, shard_count
from artgen.progress import progress
from artgen.run_folder import locked


@dataclass(frozen=True, kw_only=True)
class Shard:
    """Pack rendered samples into WebDataset shards and write the catalog."""

    out: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder of the run; receives shards/ and catalog/."""
    per_shard: int = PER_SHARD
    """Samples per shard; the same number gives the same shards."""


def shard(argv: Sequence[str]) -> int:
    """Pack rendered samples into WebDataset shards, write the Parquet catalog."""
    command = tyro.cli(Shard, args=list(argv), prog="artgen shard")
    if command.per_shard < 1:
        raise UsageError(f"--per-shard {command.per_shard} packs nothing; ask for at least 1")
    if not command.out.is_dir():
        raise UsageError(f"{command.out}: no such folder; name a run of `artgen generate`")
    with locked(command.out):
        staged, _ = packable(command.out)
        ids = [f"{path.parent.name}_{path.stem}" for path in staged]
        with progress("shards", shard_count(ids, command.per_shard)) as advance:
            made = shard_folder(command.out, per_shard=command.per_shard, advance=advance)
    packed = sum(manifest.samples for manifest in made.packing.shards)
    print(f"{packed} samples in {len(made.packing.shards)} shards: {made.shards}")  # noqa: T201
    print(f"catalog: {made.catalog[0]}, {made.catalog[1]}")  # noqa: T201
    for asset_id, reason in made.packing.left_out.items():
        print(f"left out: {asset_id}: {reason}")  # noqa: T201
    return 1 if made.packing.left_out else 0
