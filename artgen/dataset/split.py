"""Train, validation or test: a frozen function of an asset's family, never of a view."""

import hashlib
from typing import Literal

Split = Literal["train", "val", "test"]
SPLITS: tuple[Split, ...] = ("train", "val", "test")

_NAME = "artgen-split/1"
"""Part of the hashed text; a change of it would move assets between splits."""
_TEST, _VAL = 10, 20
"""Per cent: below 10 is test, below 20 validation."""


def split_of(family: str) -> Split:
    """Split of a family: the asset's id, or for recombined assets the id that all share whose parts
    they borrow, so that no part is seen both in training and in testing."""
    digest = hashlib.sha256(f"{_NAME}:{family}".encode()).digest()
    percent = int.from_bytes(digest[:8], "big") % 100
    if percent < _TEST:
        return "test"
    return "val" if percent < _VAL else "train"
