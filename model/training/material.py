"""What a run learns from: objects made from seeds, libraries of them, rendered shards."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from artgen.core.errors import UsageError
from artgen.dataset.split import Split
from artgen.progress import Show
from artgen.rules import rule_names
from model.data.config import DataConfig
from model.data.fingerprint import fingerprint
from model.data.items import Source
from model.data.kept import Kept
from model.data.library import library_made, read_library
from model.data.make import Request, dealt, make_library
from model.data.mixed import BLOCK, Mixed, mixed_by_number
from model.data.shards import ShardSource
from model.data.soup import TOLERANCE
from model.data.soup_source import SoupSource

WORKERS = os.cpu_count() or 1
LEAST = 1 / BLOCK
"""Share of the items that a source has at least, where several are mixed."""


@dataclass(frozen=True, kw_only=True)
class Material:
    """What is learned from.

    Attributes:
        categories: of objects made from seeds; all where none is named.
        objects: how many are made, dealt out to the categories in turn.
        library: file of objects, instead of making them.
        shards: folders of rendered shards, mixed in.
        shard_share: of the items, from shards, where there are other objects beside them; None
            goes by their numbers. A hundredth at least is for either.
        split: share of the objects that is learned from; None for all.
        scenes: in which every object is seen, again in every epoch; None draws a new one each time.
    """

    categories: tuple[str, ...] = ()
    objects: int = 64
    library: Path | None = None
    shards: tuple[Path, ...] = ()
    split: Split | None = "train"
    scenes: int | None = None
    shard_share: float | None = None

    def __post_init__(self) -> None:
        share, both = self.shard_share, self.shards and (self.library or self.categories)
        if share is not None and not both:
            raise UsageError(
                f"--shard-share {share}: divides the items between --shards and --library or "
                "--categories; name both, or leave it out"
            )
        if share is not None and not LEAST <= share <= 1.0 - LEAST:
            raise UsageError(
                f"--shard-share {share}: expected {LEAST} to {1.0 - LEAST}, whole hundredths"
            )

    def request(self, seed: int) -> Request:
        """Which objects to make."""
        names = self.categories or tuple(rule_names())
        counts = {name: count for name, count in dealt(names, self.objects).items() if count}
        return Request(counts=counts, seed=seed, tolerance=TOLERANCE)


def stated_origin(material: Material, seed: int) -> Mapping[str, object]:
    """What the objects were made from, as a model card states it; empty for shards alone."""
    if material.library is not None:
        return library_made(material.library)
    return material.request(seed).made if material.categories or not material.shards else {}


def material_hashes(material: Material, folder: Path) -> dict[str, Any]:
    """What the material holds, by content; the objects of the folder are there by now."""
    library = library_of(material, folder)
    return {
        "library": library and fingerprint(library),
        "shards": [fingerprint(path, material.split) for path in material.shards],
    }


def make_missing(material: Material, folder: Path, data: DataConfig, *, show: Show) -> None:
    """Make the objects that are to be made from seeds, unless the folder has them."""
    path = library_of(material, folder)
    if path is not None and material.library is None and not path.exists():
        make_library(path, material.request(data.seed), workers=WORKERS, show=show)


SCENES = "scenes"
"""In a run's folder until the run is done: scenes that were cast and come again."""


def opened(material: Material, folder: Path, data: DataConfig) -> Source[Any]:
    """The items of all that the material names.

    Raises:
        ModelError: a library or shard is missing or damaged, or nothing is left of the split.
        ShardError: a shard is damaged.
    """
    split, slots = material.split, data.slots
    path = library_of(material, folder)
    shards: list[Source[Any]] = [
        _shown(
            ShardSource(one, split=split, slots=slots), material.scenes, folder / SCENES / f"{k}"
        )
        for k, one in enumerate(material.shards, 1)
    ]
    objects: list[Source[Any]] = (
        [
            _shown(
                SoupSource(read_library(path), split=split, slots=slots),
                material.scenes,
                folder / SCENES / "0",
            )
        ]
        if path
        else []
    )
    share = material.shard_share
    if share is None:
        return mixed_by_number([*shards, *objects])
    return Mixed([(mixed_by_number(shards), share), (mixed_by_number(objects), 1.0 - share)])


def _shown(source: Source[Any], scenes: int | None, folder: Path) -> Source[Any]:
    """Kept before it is mixed: each source then comes round in its own share."""
    return source if scenes is None else Kept(source, scenes, folder)


def library_of(material: Material, folder: Path) -> Path | None:
    """The file of objects: given, to be made, or None where shards alone are learned from."""
    if material.library is not None:
        return material.library
    return folder / "library.npz" if material.categories or not material.shards else None
