"""Where a library's sources come from: our own generators, and bundles of any origin."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from artgen.articulation.canonical import canonicalize
from artgen.assembly.finished import finished_object
from artgen.assembly.source import Source, source_of_draft, source_of_object
from artgen.core.errors import UsageError
from artgen.core.jsonio import file_hash, read_object
from artgen.core.licence import licence_of
from artgen.core.stream import Stream
from artgen.dataset.split import OURS, families_of
from artgen.export.layout import MANIFEST
from artgen.export.places import bundles_below
from artgen.finish import Rounder
from artgen.generators import load_builder
from artgen.rules import load_rule, sample

EMBEDDED: Mapping[str, int] = {
    "storage_furniture": 72,
    "cabinet": 48,
    "dishwasher": 4,
    "microwave": 4,
    "oven": 4,
    "refrigerator": 4,
    "safe": 2,
}
"""Objects of each category in the embedded library."""
SEED = 6
"""Of the embedded library."""
LONGEST = 80
"""Characters of a bundle's own name in the id of its source."""
DIGITS = 12
"""Hex digits of its hash there."""


@dataclass(frozen=True, kw_only=True)
class Made:
    """One object of our own generators."""

    category: str
    index: int
    seed: int = SEED

    @property
    def asset_id(self) -> str:
        """Unique among all seeds; the family that splits tell apart."""
        return f"{self.category}_{self.seed}_{self.index:06d}"


def embedded(counts: Mapping[str, int] = EMBEDDED, seed: int = SEED) -> list[Made]:
    """What the embedded library is built from."""
    return [
        Made(category=category, index=index, seed=seed)
        for category, count in counts.items()
        for index in range(count)
    ]


def made_source(made: Made, rounder: Rounder) -> Source:
    """An object of our generators, taken apart while it is still a draft.

    Raises:
        RuleError: its rule allows no such object. GeometryError: it cannot be finished.
    """
    rule, builder = load_rule(made.category), load_builder(made.category)
    drawn = sample(
        rule,
        Stream(made.seed, made.category, made.index),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )
    draft = canonicalize(builder.build(drawn.params, drawn.surfaces))
    return source_of_draft(draft, id=made.asset_id, rounder=rounder)


def bundle_source(folder: Path) -> Source:
    """A bundle on disk, taken apart body by body.

    Raises:
        ExportError: it is damaged.
        UsageError: it is itself made of others' parts, which are of several families.
    """
    refuse_assembled(folder)
    obj = finished_object(folder)
    families = families_of(obj.provenance)
    return source_of_object(
        obj,
        id=bundle_id(folder),
        licence=licence_of(obj.provenance),
        dataset=_origin(obj.provenance)[0],
        family=families[0] if families else obj.asset_id,
    )


def bundle_id(folder: Path) -> str:
    """The id of a bundle's source: what it is called, and a hash of its manifest, which holds the
    hashes of its files. Names alone are unique only within one run of generate or ingest.

    Raises:
        ExportError: its manifest cannot be read.
    """
    called = re.sub(r"[^A-Za-z0-9_.-]+", "_", "_".join(_origin(read_manifest(folder))))
    return f"{called[:LONGEST]}_{file_hash(folder / MANIFEST)[:DIGITS]}"


def read_manifest(folder: Path) -> Mapping[str, Any]:
    """What a bundle's manifest states, whatever its schema.

    Raises:
        ExportError: it cannot be read.
    """
    return read_object(folder / MANIFEST, remedy="make the bundle again")


def _origin(manifest: Mapping[str, Any]) -> tuple[str, str]:
    """The data set of a bundle and its id there."""
    stated = manifest.get("source")
    origin = stated if isinstance(stated, Mapping) else {}
    own = origin.get("id", manifest.get("asset_id"))
    return str(origin.get("dataset", OURS)), str(own)


def bundle_folders(places: Sequence[Path]) -> list[Path]:
    """Folders of bundles at or below some places, each once, in order; of runs those that passed.

    Raises:
        UsageError: a place does not exist or holds none.
    """
    found: dict[Path, None] = {}
    for place in places:
        below = bundles_below(place)
        if not below:
            raise UsageError(
                f"{place}: holds no bundle that passed; make some with generate or ingest"
            )
        found |= dict.fromkeys(below)
    return list(found)


def refuse_assembled(folder: Path) -> None:
    """Raise UsageError if a bundle is itself made of others' parts, which are of several
    families."""
    if read_manifest(folder).get("donors"):
        raise UsageError(f"{folder}: is made of others' parts; take those objects in instead")
