"""`dataset.json`: every shard of a folder, and the assets left out with reasons."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.core.jsonio import write_json
from artgen.dataset.sealed import sealed, unsealed
from artgen.dataset.shard import ShardManifest
from artgen.dataset.store import Store

DATASET_SCHEMA = "artgen-dataset/2"
CONTENTS = "dataset.json"


@dataclass(frozen=True, kw_only=True)
class ListedShard:
    """A shard as `dataset.json` lists it; the sha256 is the tar's."""

    file: str
    samples: int
    bytes: int
    sha256: str


@dataclass(frozen=True, kw_only=True)
class Contents:
    """What `dataset.json` states.

    Attributes:
        shards: by split and number.
        left_out: asset id to the reason why no shard holds it.
    """

    per_shard: int
    shards: tuple[ListedShard, ...]
    left_out: Mapping[str, str]
    schema: str = DATASET_SCHEMA


def listed(manifest: ShardManifest) -> ListedShard:
    """The entry of a shard."""
    return ListedShard(
        file=manifest.file,
        samples=manifest.samples,
        bytes=manifest.bytes,
        sha256=manifest.sha256,
    )


def write_contents(folder: Path, contents: Contents) -> None:
    """Write `dataset.json`, atomically."""
    write_json(folder / CONTENTS, sealed(vars(contents)))


def read_contents(store: Store) -> Contents:
    """What `dataset.json` says.

    Raises:
        ShardError: it is missing, corrupt or of another schema.
    """
    where = store.where(CONTENTS)
    try:
        facts = unsealed(store.read(CONTENTS), where=where, schema=DATASET_SCHEMA)
    except FileNotFoundError as error:
        raise ShardError(
            f"{where}: is missing; packing has not finished, run `artgen shard` again"
        ) from error
    return Contents(
        per_shard=facts["per_shard"],
        shards=tuple(ListedShard(**shard) for shard in facts["shards"]),
        left_out=facts["left_out"],
    )


def check_contents(store: Store, manifests: Sequence[ShardManifest], prefix: str) -> None:
    """Raise ShardError unless the shards whose names begin so are those that are listed."""
    expected = {
        shard.file: shard for shard in read_contents(store).shards if shard.file.startswith(prefix)
    }
    found = {manifest.file: listed(manifest) for manifest in manifests}
    for file in sorted(expected.keys() | found.keys()):
        if file not in found:
            raise ShardError(
                f"{store.where(file)}: {CONTENTS} lists it, but it is not here; copy or publish "
                "the rest"
            )
        if file in expected and found[file] != expected[file]:
            raise ShardError(
                f"{store.where(file)}: is not the shard that {CONTENTS} lists; the two are from "
                "different packings: copy both again, or pack again"
            )
