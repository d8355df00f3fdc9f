"""What a repair did, and what it left alone."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Change:
    """One thing that was mended.

    Attributes:
        subject: the part, joint or mesh file.
        what: the attribute or property.
        before: as it was; `nothing` where it was not stated.
        after: as it is.
        why: what was wrong, and what was assumed.
    """

    subject: str
    what: str
    before: str
    after: str
    why: str

    def as_json(self) -> Mapping[str, str]:
        """A row of `repair.json`."""
        return {
            "subject": self.subject,
            "what": self.what,
            "from": self.before,
            "to": self.after,
            "why": self.why,
        }

    def __str__(self) -> str:
        return f"{self.subject}: {self.what}: {self.before} -> {self.after} ({self.why})"


@dataclass(frozen=True, kw_only=True)
class Left:
    """One thing that is wrong and was not mended, as that would be a guess."""

    subject: str
    why: str

    def __str__(self) -> str:
        return f"{self.subject}: {self.why}"


Outcome = Change | Left
