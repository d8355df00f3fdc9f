"""`artgen shard`: pack, verify, repack, publish."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import ShardError, UsageError
from artgen.dataset.contents import CONTENTS, ListedShard, read_contents
from artgen.dataset.folder import shard_folder
from artgen.dataset.packing import PER_SHARD, Packing
from artgen.dataset.publish import publish
from artgen.dataset.repack import repack, restore
from artgen.dataset.store import LocalStore, Store, opened_store, split_place
from artgen.dataset.terms import refuse_bound_shards
from artgen.dataset.verify import Damage, damages, folder_damages, shard_names
from artgen.progress import progress
from artgen.run_folder import locked


@dataclass(frozen=True, kw_only=True)
class Pack:
    """Pack rendered samples into WebDataset shards and write the catalog.

    Also: artgen shard verify | repack | publish, each with --help.
    """

    out: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder of the run; receives shards/ and catalog/."""
    per_shard: int = PER_SHARD
    """Samples per shard; the same number gives the same shards."""
    public: bool = False
    """The set is to be handed on: refuse if an asset's licence forbids it."""


@dataclass(frozen=True, kw_only=True)
class Verify:
    """Check every byte of shards; names shard, key and offset of all that is damaged."""

    places: Annotated[tuple[str, ...], tyro.conf.Positional] = ("out",)
    """Tars, folders of shards, folders of runs, or URLs such as s3://bucket/prefix."""


@dataclass(frozen=True, kw_only=True)
class Repack:
    """Pack samples or shards into shards of another size, or restore one that is damaged."""

    source: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder of a run, whose samples are taken, or a folder of shards."""
    into: Path | None = None
    """Receives the shards; SOURCE/shards if not given."""
    per_shard: int | None = None
    """Samples per shard; as many as the folder has, if it was packed before."""
    shard: str | None = None
    """Write only this shard again, such as train-000003, to the bytes it had."""


@dataclass(frozen=True, kw_only=True)
class Publish:
    """Copy a folder of shards to an object store; of two packings, the first wins."""

    folder: Annotated[Path, tyro.conf.Positional]
    """Folder of shards, or of the run that holds it."""
    url: Annotated[str, tyro.conf.Positional]
    """Such as s3://bucket/prefix."""
    public: bool = False
    """The place is open to others: refuse if an asset's licence forbids that."""


def shard(argv: Sequence[str]) -> int:
    """Pack rendered samples into WebDataset shards; verify, repack and publish them."""
    words = list(argv)
    return ACTIONS[words[0]](words[1:]) if words and words[0] in ACTIONS else _pack(words)


def _pack(argv: Sequence[str]) -> int:
    command = tyro.cli(Pack, args=list(argv), prog="artgen shard")
    _check_per_shard(command.per_shard)
    _check_folder(command.out)
    with locked(command.out):
        made = shard_folder(
            command.out, per_shard=command.per_shard, show=progress, public=command.public
        )
    _tell(made.packing, made.shards)
    print(f"catalog: {made.catalog[0]}, {made.catalog[1]}")  # noqa: T201
    return _tell_left_out(made.packing.left_out)


def _verify(argv: Sequence[str]) -> int:
    """Exit code 1 if anything is damaged."""
    command = tyro.cli(Verify, args=list(argv), prog="artgen shard verify")
    found: list[Damage] = []
    count = 0
    for place in command.places:
        store, names = _shards_at(place)
        with progress("verify", len(names)) as advance:
            if _is_tar(place):
                found += damages(store, names[0])
                advance(names[0])
            else:
                found += folder_damages(store, advance)
        count += len(names)
    for damage in found:
        print(f"damaged: {damage}")  # noqa: T201
    print(f"shards verified: {count}, damaged places: {len(found)}")  # noqa: T201
    return 1 if found else 0


def _repack(argv: Sequence[str]) -> int:
    command = tyro.cli(Repack, args=list(argv), prog="artgen shard repack")
    _check_folder(command.source)
    into = command.into or command.source / "shards"
    listed = (into / CONTENTS).exists()
    known = read_contents(LocalStore(into)).per_shard if listed else PER_SHARD
    per_shard = command.per_shard or known
    _check_per_shard(per_shard if command.per_shard is None else command.per_shard)
    with locked(into if command.into else command.source):
        if command.shard is not None:
            made = restore(command.source, into, command.shard)
            print(f"restored: {into / made.file}, {made.samples} samples")  # noqa: T201
            return 0
        packing = repack(command.source, into, per_shard=per_shard, show=progress)
    _tell(packing, into)
    return _tell_left_out(packing.left_out)


def _publish(argv: Sequence[str]) -> int:
    command = tyro.cli(Publish, args=list(argv), prog="artgen shard publish")
    _check_folder(command.folder)
    folder = _shard_folder(command.folder)
    if command.public:
        refuse_bound_shards(folder)
    count = len(read_contents(LocalStore(folder)).shards)
    with progress("publish", count) as advance:
        shards: tuple[ListedShard, ...] = publish(folder, command.url, advance=advance)
    print(f"{sum(s.samples for s in shards)} samples in {count} shards: {command.url}")  # noqa: T201
    return 0


ACTIONS: Mapping[str, Callable[[Sequence[str]], int]] = {
    "pack": _pack,
    "verify": _verify,
    "repack": _repack,
    "publish": _publish,
}


def _shards_at(place: str) -> tuple[Store, list[str]]:
    """A store and the shards of it that a word of the command line names."""
    if _is_tar(place):
        store, name = split_place(place)
        return store, [name]
    if "://" not in place:
        _check_folder(Path(place))
        place = str(_shard_folder(Path(place)))
    store = opened_store(place)
    if not (names := shard_names(store)):
        raise ShardError(f"{place}: holds no shard; write some with `artgen shard`")
    return store, names


def _is_tar(place: str) -> bool:
    return place.endswith(".tar")


def _shard_folder(folder: Path) -> Path:
    """A run's `shards/`, or the folder itself."""
    return folder / "shards" if (folder / "shards").is_dir() else folder


def _check_folder(folder: Path) -> None:
    if not folder.is_dir():
        raise UsageError(f"{folder}: no such folder; name a run of `artgen generate`")


def _check_per_shard(count: int) -> None:
    if count < 1:
        raise UsageError(f"--per-shard {count} packs nothing; ask for at least 1")


def _tell(packing: Packing, shards: Path) -> None:
    packed = sum(manifest.samples for manifest in packing.shards)
    print(f"{packed} samples in {len(packing.shards)} shards: {shards}")  # noqa: T201


def _tell_left_out(left_out: Mapping[str, str]) -> int:
    """One line for each; the exit code."""
    for asset_id, reason in left_out.items():
        print(f"left out: {asset_id}: {reason}")  # noqa: T201
    return 1 if left_out else 0
