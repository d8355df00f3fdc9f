"""What a hard case states."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class HardCase:
    """A case that holds to a bound.

    Attributes:
        name: a few words.
        reason: why it is hard, or where it comes up.
        error: measures it, in `unit`.
        bound: what the error may be.
        derived: how the bound follows.
        outside: what happens beyond the case's conditions.
        seen: shows that what happens outside does not pass silently; True when it was seen.
    """

    name: str
    reason: str
    error: Callable[[], float]
    bound: float
    unit: str
    derived: str
    outside: str
    seen: Callable[[], bool] | None = None
