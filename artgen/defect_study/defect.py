"""A defect that can be planted into a copy of a good asset."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

Plant = Callable[[Path], None]
"""Spoils the asset in a folder; raises LookupError where the asset has no place for the defect."""


@dataclass(frozen=True, kw_only=True)
class Defect:
    """One kind of defect.

    Attributes:
        name: identifier, with words joined by `_`.
        format: of the file that it spoils, by which the asset is then read: urdf, mjcf or usd.
        what: the mistake in a few words, as its maker would confess it.
        plant: makes it.
    """

    name: str
    format: str
    what: str
    plant: Plant
