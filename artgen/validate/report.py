"""What a validation says: findings, what was skipped, and the verdict."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, cast

from artgen.articulation.types import State
from artgen.core.jsonio import plain

SCHEMA = "artgen-report/3"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One broken rule.

    Attributes:
        check: `level.rule`, a row of docs/validation.md.
        part: the part, joint, pair or file it is about.
        value: what was found; a number, or words where there is none.
        bound: what was expected, with its unit.
        cause: what makes it so.
        remedy: what to do about it.
        joint: the joint that was moved, where one was.
        state: joint name to q (rad or m) at the worst pose, where there is one.
    """

    check: str
    part: str
    value: float | str
    bound: str
    cause: str
    remedy: str
    joint: str | None = None
    state: State | None = None

    def __post_init__(self) -> None:
        if isinstance(self.value, float) and not math.isfinite(self.value):
            object.__setattr__(self, "value", repr(self.value))  # JSON has no word for it

    def __str__(self) -> str:
        shown = f"{self.value:.6g}" if isinstance(self.value, float) else self.value
        said = f"{self.check}: {self.part}: {shown} (expected {self.bound})"
        return f"{said}; {self.cause}; {self.remedy}"


@dataclass(frozen=True, kw_only=True)
class Skipped:
    """A level or check that did not run, and why."""

    name: str
    reason: str


@dataclass(frozen=True, kw_only=True)
class Note:
    """What is worth knowing and breaks no rule."""

    name: str
    text: str


@dataclass(frozen=True, kw_only=True)
class Simulated:
    """What a check had computed in its simulation: effect to `on: why` or `off: why`."""

    check: str
    effects: Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class Report:
    """The verdict on one asset; no findings means valid.

    Attributes:
        simulated: the effects that each simulating check called for, with reasons.
        asset: its name.
        format: what it was read from: bundle, urdf, mjcf or usd.
        judged: names of the checks that ran.
        seconds: CPU seconds by level; no part of equality, as clocks differ.
    """

    asset: str
    findings: tuple[Finding, ...]
    skipped: tuple[Skipped, ...] = ()
    notes: tuple[Note, ...] = ()
    simulated: tuple[Simulated, ...] = ()
    format: str = "bundle"
    judged: tuple[str, ...] = ()
    seconds: Mapping[str, float] = field(default_factory=dict, compare=False)

    @property
    def ok(self) -> bool:
        """True when nothing was found."""
        return not self.findings

    def as_json(self) -> Mapping[str, object]:
        """Plain data for `report.json`; equal assets give equal data, so it holds no times."""
        return {
            "schema": SCHEMA,
            "asset": self.asset,
            "format": self.format,
            "ok": self.ok,
            "judged": list(self.judged),
            "findings": [plain(finding) for finding in self.findings],
            "notes": [plain(note) for note in self.notes],
            "simulated": [plain(item) for item in self.simulated],
            "skipped": [plain(skipped) for skipped in self.skipped],
        }


def report_from_json(stated: Mapping[str, object]) -> Report:
    """The report that `as_json` told; the inverse of it.

    Raises:
        KeyError, TypeError, ValueError: the data is no report of this schema.
    """
    if stated["schema"] != SCHEMA:
        raise ValueError(f"schema {stated['schema']!r} instead of {SCHEMA!r}")
    lists = ("findings", "skipped", "notes", "simulated", "judged")
    rows: dict[str, list[Any]] = {key: list(cast(Any, stated[key])) for key in lists}
    return Report(
        asset=str(stated["asset"]),
        format=str(stated["format"]),
        judged=tuple(rows["judged"]),
        findings=tuple(Finding(**row) for row in rows["findings"]),
        skipped=tuple(Skipped(**row) for row in rows["skipped"]),
        notes=tuple(Note(**row) for row in rows["notes"]),
        simulated=tuple(Simulated(**row) for row in rows["simulated"]),
    )
