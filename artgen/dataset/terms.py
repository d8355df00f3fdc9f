"""Terms of a set: which of its assets may not be handed on, and the file that says so."""

import json
import shutil
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from artgen.core.errors import ShardError
from artgen.core.jsonio import read_object, write_json
from artgen.core.licence import OURS, licence_of, sources_of
from artgen.dataset.listing import Listed, listed_assets

TERMS = "terms.json"
"""Beside the shards: licence ids with how many assets are under each, whether the set may be handed
on, and whose works its assets are made from."""
TOLD = 5
"""Assets that a refusal names."""


@dataclass(frozen=True, kw_only=True)
class Terms:
    """Of a set.

    Attributes:
        licences: identifier to how many assets are under it.
        bound: ids of the assets that may not be handed on.
        sources: identifier to the foreign works under it that assets are made from; licences that
            ask for their makers' names are kept with them.
    """

    licences: Mapping[str, int]
    bound: list[str]
    sources: Mapping[str, list[str]]


def terms_of(assets: Iterable[Listed]) -> Terms:
    """Terms of some assets, told by their manifests.

    Raises:
        ExportError: a manifest cannot be read.
    """
    licences: Counter[str] = Counter()
    sources: dict[str, set[str]] = defaultdict(set)
    bound = []
    for asset in assets:
        facts = read_object(asset.bundle / "manifest.json", remedy="make the asset again")
        licence = licence_of(facts)
        licences[licence.id] += 1
        if not licence.distributable:
            bound.append(asset.asset_id)
        for source, id in foreign_sources(facts):
            sources[id].add(source)
    return Terms(
        licences=dict(sorted(licences.items())),
        bound=bound,
        sources={id: sorted(names) for id, names in sorted(sources.items())},
    )


def foreign_sources(facts: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """The works that a manifest names other than our generators', with identifiers of their
    licences: the sources of an assembled object's parts, or what an ingested one was."""
    parts = list(sources_of(facts))
    origin = facts.get("source")
    if not parts and isinstance(origin, Mapping):
        parts = [(f"{origin.get('dataset')}:{origin.get('id')}", licence_of(facts).id)]
    return ((source, id) for source, id in parts if id != OURS.id)


def write_terms(shards: Path, terms: Terms) -> None:
    """terms.json beside shards."""
    write_json(shards / TERMS, {"distributable": not terms.bound, **vars(terms)})


def forget_terms(shards: Path) -> None:
    """Take away the terms of shards that are about to change: until they are written again nobody
    can tell whether the set may be handed on."""
    (shards / TERMS).unlink(missing_ok=True)


def carry_terms(source: Path, into: Path) -> None:
    """The terms of shards, or of the run that they come from, beside other shards of theirs."""
    if (source / TERMS).exists():
        shutil.copyfile(source / TERMS, into / TERMS)
    elif assets := [a for a in listed_assets(source) if a.valid and a.sample.exists()]:
        write_terms(into, terms_of(assets))


def refuse_bound(where: Path, bound: list[str]) -> None:
    """Raise ShardError if there is an asset that may not be handed on."""
    if bound:
        named = ", ".join(bound[:TOLD]) + (" ..." if len(bound) > TOLD else "")
        raise ShardError(
            f"{where}: {len(bound)} assets may not be handed on ({named}); their licence is in "
            "their manifests: pack them for yourself without --public, or make the set anew from "
            "a library whose sources all allow it"
        )


def refuse_bound_shards(shards: Path) -> None:
    """Raise ShardError unless terms.json says that the shards may be handed on."""
    try:
        facts = json.loads((shards / TERMS).read_text(encoding="utf-8"))
        bound = [str(asset_id) for asset_id in facts["bound"]]
        if facts["distributable"] is not (not bound):
            raise ValueError("it contradicts itself")
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ShardError(
            f"{shards / TERMS}: cannot be read ({error!r}), so nobody can tell whether the shards "
            "may be handed on; pack them again with artgen shard --public"
        ) from error
    refuse_bound(shards, bound)
