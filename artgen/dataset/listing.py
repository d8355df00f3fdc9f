"""Which assets a folder of samples is about: those of a run, or those that bundles.json names."""

import json
import os
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import ShardError

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
    return sorted(
        (
            Listed(
                asset_id=f"{folder.parent.name}_{folder.name}",
                category=folder.parent.name,
                bundle=folder,
                sample=out / "samples" / folder.parent.name / f"{folder.name}.tar",
                valid=root == "assets",
            )
            for root in ("assets", "failed")
            for folder in (out / root).glob("*/*")
            if folder.is_dir() and folder.name.isdigit()
        ),
        key=lambda asset: asset.asset_id,
    )


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
