"""Terms of a set: which of its assets may not be handed on, and the file that says so."""

import json
import shutil
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from artgen.core.errors import ShardError
from artgen.core.jsonio import write_json
from artgen.dataset.listing import Listed, listed_assets

TERMS = "terms.json"
"""Beside the shards: licence ids with how many assets are under each, and whether the set may be
handed on."""
OURS = "LicenseRef-artgen-output"
"""Of assets whose manifest states no other source."""
TOLD = 5
"""Assets that a refusal names."""


def terms_of(assets: Iterable[Listed]) -> tuple[Counter[str], list[str]]:
    """How many assets are under each licence, and the ids of those that may not be handed on.

    Raises:
        ShardError: a manifest cannot be read.
    """
    licences: Counter[str] = Counter()
    bound = []
    for asset in assets:
        licence, free = _licence(asset.bundle / "manifest.json")
        licences[licence] += 1
        if not free:
            bound.append(asset.asset_id)
    return licences, bound


def write_terms(shards: Path, licences: Counter[str], bound: list[str]) -> None:
    """terms.json beside shards."""
    facts = {"distributable": not bound, "licences": dict(sorted(licences.items())), "bound": bound}
    write_json(shards / TERMS, facts)


def carry_terms(source: Path, into: Path) -> None:
    """The terms of shards, or of the run that they come from, beside other shards of theirs."""
    if (source / TERMS).exists():
        shutil.copyfile(source / TERMS, into / TERMS)
    elif assets := [a for a in listed_assets(source) if a.valid and a.sample.exists()]:
        write_terms(into, *terms_of(assets))


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
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ShardError(
            f"{shards / TERMS}: cannot be read ({error!r}), so nobody can tell whether the shards "
            "may be handed on; pack them again with artgen shard --public"
        ) from error
    refuse_bound(shards, bound)


def _licence(path: Path) -> tuple[str, bool]:
    """A manifest's licence and whether copies may be handed on; a foreign source that states none
    may not."""
    try:
        facts = json.loads(path.read_text(encoding="utf-8"))
        stated = facts.get("licence")
        if stated is None:
            return ("NOASSERTION", False) if "source" in facts else (OURS, True)
        return str(stated["id"]), stated["distributable"] is True
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ShardError(f"{path}: cannot be read ({error!r}); make the asset again") from error
