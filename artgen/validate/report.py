"""What a validation says: findings, what was skipped, and the verdict."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

Subject = TypeVar("Subject")


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One broken rule.

    Attributes:
        check: `level.rule`, a row of docs/validation.md.
        part: the part, joint, pair or file it is about.
        value: what was found; a number, or words where there is none.
        bound: what was expected, with its unit.
        message: cause and remedy, in one line.
    """

    check: str
    part: str
    value: float | str
    bound: str
    message: str

    def __post_init__(self) -> None:
        if isinstance(self.value, float) and not math.isfinite(self.value):
            object.__setattr__(self, "value", repr(self.value))  # JSON has no word for it

    def __str__(self) -> str:
        shown = f"{self.value:.6g}" if isinstance(self.value, float) else self.value
        return f"{self.check}: {self.part}: {shown} (expected {self.bound}); {self.message}"


@dataclass(frozen=True, kw_only=True)
class Skipped:
    """A level or check that did not run, and why."""

    name: str
    reason: str


@dataclass(frozen=True, kw_only=True)
class Report:
    """The verdict on one bundle; no findings means valid."""

    asset: str
    findings: tuple[Finding, ...]
    skipped: tuple[Skipped, ...] = ()

    @property
    def ok(self) -> bool:
        """True when nothing was found."""
        return not self.findings

    def as_json(self) -> Mapping[str, object]:
        """Plain data for `report.json`."""
        return {
            "schema": "artgen-report/1",
            "asset": self.asset,
            "ok": self.ok,
            "findings": [vars(finding) for finding in self.findings],
            "skipped": [vars(skipped) for skipped in self.skipped],
        }


@dataclass(frozen=True, kw_only=True)
class Level(Generic[Subject]):
    """Checks that rely on the same things; run only when every level in `needs` found nothing."""

    name: str
    needs: tuple[str, ...]
    checks: tuple[Callable[[Subject], Iterable[Finding | Skipped]], ...]


def run_levels(asset: str, subject: Subject, levels: Iterable[Level[Subject]]) -> Report:
    """Run the levels in order and collect everything they say."""
    findings: list[Finding] = []
    skipped: list[Skipped] = []
    failed: set[str] = set()
    for level in levels:
        if blockers := [name for name in level.needs if name in failed]:
            reason = f"relies on {' and '.join(blockers)}, which did not pass"
            skipped.append(Skipped(name=level.name, reason=reason))
            failed.add(level.name)
            continue
        said = [item for check in level.checks for item in check(subject)]
        found = [item for item in said if isinstance(item, Finding)]
        skipped += [item for item in said if isinstance(item, Skipped)]
        findings += found
        if found:
            failed.add(level.name)
    return Report(asset=asset, findings=tuple(findings), skipped=tuple(skipped))
