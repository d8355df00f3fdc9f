"""Train, validation or test: a frozen function of an asset's family, never of a view."""

import hashlib
from collections.abc import Iterable
from typing import Literal

Split = Literal["train", "val", "test"]
SPLITS: tuple[Split, ...] = ("train", "val", "test")

_NAME = "artgen-split/1"
"""Part of the hashed text; a change of it would move assets between splits."""
_TEST, _VAL = 10, 20
"""Per cent: below 10 is test, below 20 validation."""


def split_of(asset_id: str, donors: Iterable[str] = ()) -> Split | None:
    """Split of an asset: that of its own id, or of the donors whose parts it borrows.

    A part is so never seen both in training and in testing. None where donors lie in different
    splits: no split may hold such an asset. It depends on nothing else, so a growing set moves no
    asset.
    """
    splits = {_split(family) for family in (tuple(donors) or (asset_id,))}
    return splits.pop() if len(splits) == 1 else None


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
