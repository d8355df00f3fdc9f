"""Train, validation or test: a frozen function of an asset's family, never of a view."""

import hashlib
from collections.abc import Iterable, Mapping
from typing import Any, Literal

Split = Literal["train", "val", "test"]
SPLITS: tuple[Split, ...] = ("train", "val", "test")

OURS = "artgen"
"""The data set of bundles that name no other."""
_NAME = "artgen-split/1"
"""Part of the hashed text; a change of it would move assets between splits."""
_TEST, _VAL = 10, 20
"""Per cent: below 10 is test, below 20 validation."""


def split_of(asset_id: str, donors: Iterable[str] = ()) -> Split | None:
    """Split of an asset: that of its own id, or of the donors that `families_of` tells.

    A part is so never seen both in training and in testing. None where donors lie in different
    splits: no split may hold such an asset. It depends on nothing else, so a growing set moves no
    asset.
    """
    splits = {_split(family) for family in (tuple(donors) or (asset_id,))}
    return splits.pop() if len(splits) == 1 else None


def families_of(manifest: Mapping[str, Any]) -> tuple[str, ...]:
    """What decides the split of a bundle beside its id, for `split_of`: its donors; else the family
    of the foreign object that it was made from, whatever the bundle is called; nothing for an asset
    of its own."""
    donors, source = manifest.get("donors"), manifest.get("source")
    if donors:
        return tuple(map(str, donors))
    if not isinstance(source, Mapping):
        return ()
    dataset, own = source.get("dataset", OURS), source.get("id")
    named = None if dataset == OURS or own is None else f"{dataset}:{own}"
    family = source.get("family") or named
    return () if family is None else (str(family),)


def divided(donors: Iterable[str]) -> str:
    """Why an asset with these donors is in no split."""
    lie = ", ".join(f"{donor} ({_split(donor)})" for donor in sorted(donors))
    return f"borrows parts from different splits: {lie}"


def _split(family: str) -> Split:
    digest = hashlib.sha256(f"{_NAME}:{family}".encode()).digest()
    percent = int.from_bytes(digest[:8], "big") % 100
    if percent < _TEST:
        return "test"
    return "val" if percent < _VAL else "train"
