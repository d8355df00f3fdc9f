"""Which assets a folder of samples is about: those of a run, or those that bundles.json names."""

import json
import os
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ShardError

MANIFEST = "manifest.json"
"""Of a bundle."""
BUNDLES = "bundles.json"
"""Written by `artgen render` where a rendering lies apart from its bundles: asset id to their
folder, relative to the rendering's."""


@dataclass(frozen=True, kw_only=True)
class Listed:
    """One asset.

    Attributes:
        bundle: its folder.
        sample: where its staged sample lies if it was rendered.
        valid: False for assets that failed validation, or could not be rendered from elsewhere.
    """

    asset_id: str
    category: str
    bundle: Path
    sample: Path
    valid: bool


def listed_assets(out: Path) -> list[Listed]:
    """The assets of a folder, by ascending id.

    Raises:
        ShardError: bundles.json is damaged.
    """
    if (out / BUNDLES).exists():
        return _elsewhere(out)
    found = (
        _in_run(out, folder, valid=root == "assets")
        for root in ("assets", "failed")
        for folder in (out / root).glob("*/*")
        if folder.is_dir() and (folder.name.isdigit() or (folder / MANIFEST).is_file())
    )
    return sorted(found, key=lambda asset: asset.asset_id)


def _in_run(out: Path, folder: Path, *, valid: bool) -> Listed:
    """As its folders are named, if they are named as those of generated ones and its sample lies
    there; else as its manifest says: ingested and assembled ones are called otherwise."""
    category, samples = folder.parent.name, out / "samples"
    asset_id, sample = f"{category}_{folder.name}", samples / category / f"{folder.name}.tar"
    generated = folder.name.isdigit() and sample.exists()
    if not generated and (named := _named(folder / MANIFEST)) is not None:
        asset_id, category = named
        sample = samples / sample_path(asset_id, category)
    return Listed(asset_id=asset_id, category=category, bundle=folder, sample=sample, valid=valid)


def sample_path(asset_id: str, category: str) -> Path:
    """Where a sample lies among samples: <category>/<rest of the id>.tar."""
    return Path(category) / f"{asset_id.removeprefix(f'{category}_')}.tar"


def _named(manifest: Path) -> tuple[str, str] | None:
    """Id and category; None where no manifest states them, which whoever reads on tells."""
    try:
        facts = json.loads(manifest.read_text(encoding="utf-8"))
        return str(facts["asset_id"]), str(facts["category"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _elsewhere(out: Path) -> list[Listed]:
    try:
        places = json.loads((out / BUNDLES).read_text(encoding="utf-8"))
        return [
            Listed(
                asset_id=asset_id,
                category=place["category"],
                bundle=Path(os.path.normpath(out / place["bundle"])),
                sample=out / place["sample"],
                valid=(out / place["sample"]).exists(),
            )
            for asset_id, place in sorted(places.items())
        ]
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ShardError(
            f"{out / BUNDLES}: is damaged ({error!r}); run the same `artgen render` again"
        ) from error
