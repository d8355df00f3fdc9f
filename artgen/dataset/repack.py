"""Shards made anew, from samples or from other shards: another size, or one that was damaged."""

from pathlib import Path

from artgen.core.errors import ShardError
from artgen.dataset.contents import CONTENTS, read_contents
from artgen.dataset.folder import packable
from artgen.dataset.packing import Packing, Plan, carry_out, planned, write_group
from artgen.dataset.reader import OpenShard, open_shard
from artgen.dataset.shard import ShardManifest
from artgen.dataset.store import LocalStore
from artgen.dataset.terms import carry_terms, forget_terms
from artgen.progress import Show, silent


def repack(source: Path, into: Path, *, per_shard: int, show: Show = silent) -> Packing:
    """Pack what `source` holds into `into`; equal samples give equal bytes, wherever they lay.

    Args:
        source: a run's folder, of which the samples are taken, or a folder of shards.

    Raises:
        ShardError: `source` holds nothing or something corrupt, or is `into` itself.
    """
    if source.resolve() == into.resolve():
        raise ShardError(f"{into}: cannot be packed into itself; name another folder with --into")
    plan = _plan(source, into, per_shard)
    forget_terms(into)
    packing = carry_out(plan, show=show)
    carry_terms(source, into)
    return packing


def restore(source: Path, into: Path, name: str) -> ShardManifest:
    """Write one shard of `into` again, to the bytes that `dataset.json` states.

    Args:
        name: of the shard, with or without `.tar`.

    Raises:
        ShardError: `into` lists no such shard, or `source` holds other samples than it had.
    """
    file = f"{name.removesuffix('.tar')}.tar"
    contents = read_contents(LocalStore(into))
    expected = {shard.file: shard for shard in contents.shards}
    if file not in expected:
        raise ShardError(f"{into}: lists no {file}; its shards are {', '.join(expected)}")
    group = _plan(source, into, contents.per_shard, only=file).groups.get(into / file)
    if group is None:
        raise ShardError(f"{source}: holds no sample of {file}; name the folder it was packed from")
    made = write_group(into / file, group)
    if made.sha256 != expected[file].sha256:
        raise ShardError(
            f"{into / file}: was written, but is not what {CONTENTS} lists; the samples of "
            f"{source} have changed since: pack all again with `artgen shard`"
        )
    return made


def _plan(source: Path, into: Path, per_shard: int, only: str | None = None) -> Plan:
    """Of all samples; a damaged shard that is itself to be restored is no source."""
    sources, left_out = _sources(source, only if source.resolve() == into.resolve() else None)
    if not sources:
        raise ShardError(
            f"{source}: holds neither samples of a run nor shards; name the folder of one of these"
        )
    return planned(sources, into, per_shard=per_shard, left_out=left_out)


def _sources(source: Path, damaged: str | None) -> tuple[list[OpenShard], dict[str, str]]:
    tars = sorted(path for path in source.glob("*.tar") if path.name != damaged)
    if tars:
        listed = (source / CONTENTS).exists()
        left_out = dict(read_contents(LocalStore(source)).left_out) if listed else {}
    else:
        tars, left_out = packable(source)
    return [open_shard(path) for path in tars], left_out
