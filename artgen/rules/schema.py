"""CategoryRule and its pieces: a category's TOML file as typed, checked values."""

from collections.abc import Mapping
from dataclasses import dataclass

from artgen.rules.distributions import Choice, Distribution


@dataclass(frozen=True)
class Band:
    """Bounds that a finished asset's size (m) or mass (kg) must meet."""

    lower: float
    upper: float

    def __contains__(self, value: float) -> bool:
        return self.lower <= value <= self.upper


@dataclass(frozen=True)
class Draw:
    """One key of [sample]: a distribution, drawn once or `length` times."""

    distribution: Distribution
    length: int | None = None


@dataclass(frozen=True, kw_only=True)
class CategoryRule:
    """What varies in a category.

    Attributes:
        version: bumped when the same seed gives another object.
        bands: `width`, `depth`, `height` (extent along x, y, z, m) and `mass` (kg).
        draws: parameter name to what it is drawn from; exactly the fields of the builder's Params.
        surfaces: role in the builder to a choice among palette entries of `_surfaces*.toml`.
        invariants: names of predicates that the builder's module defines.
        held: labels of parts that stay at every angle: friction barrels, counterbalanced doors.
        mounted: it is screwed to a wall, floor or sink, and need not stand by itself.
        tries: samples drawn before the rule is called impossible.
        file: where it was read, for messages.
        digest: sha256 of the rule and of the palette entries it names.
    """

    name: str
    version: int
    summary: str
    bands: Mapping[str, Band]
    draws: Mapping[str, Draw]
    surfaces: Mapping[str, Choice]
    invariants: tuple[str, ...]
    tries: int
    held: tuple[str, ...]
    mounted: bool
    file: str
    digest: str
