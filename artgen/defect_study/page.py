"""The page of `artgen study defects`, written from what was measured."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from artgen.defect_study.run import DEFECTS, Planted
from artgen.studies.table import markdown_table
from artgen.validate.report import Report

HEAD = """# Which defects are caught

Written by `artgen study defects`. Every kind of defect is planted into copies of good assets, which
are then judged as a stranger's: without manifest, by the file of the format named. `first check` is
what reports it first; docs/validation.md explains each. A joint that was left out, so that a part
is welded shut, cannot be seen in a stranger's file; in our bundles the formats are held against
each other, which shows it.
"""
RIVALS = """## Beside other checkers

The same spoilt URDF files, one per kind, given to the loaders and checkers that are installed. A
refusal, an exception or a crash counts as noticed; a file that loads without a word does not. Most
are loaders, not validators: they look for what they need. {kinds} kinds.
"""


@dataclass(frozen=True, kw_only=True)
class Alarms:
    """How many good assets were judged, and `asset (format): finding` of each alarm."""

    assets: int
    raised: list[str]

    def joined(self, asset: str, format_: str, report: Report) -> "Alarms":
        """With another verdict."""
        said = [f"{asset} ({format_}): {finding}" for finding in report.findings[:1]]
        return replace(self, assets=self.assets + 1, raised=[*self.raised, *said])


def page(
    found: Sequence[Planted], alarms: Alarms, rivals: dict[str, dict[str, bool] | None]
) -> str:
    """Markdown."""
    return "\n".join([HEAD, _summary(found, alarms), _kinds(found), _beside(found, rivals)])


def _summary(found: Sequence[Planted], alarms: Alarms) -> str:
    kinds = {row.defect for row in found}
    missed = sorted({row.defect for row in found if not row.check})
    lines = [
        f"- {len(kinds)} kinds planted {len(found)} times; "
        f"{len(found) - sum(not row.check for row in found)} caught.",
        f"- Kinds that were missed at least once: {', '.join(missed) or 'none'}.",
        f"- {alarms.assets} verdicts on good assets (each in every format): "
        f"{len(alarms.raised)} false alarms.",
    ]
    return "\n".join([*lines, *(f"  - {text}" for text in alarms.raised), ""])


def _kinds(found: Sequence[Planted]) -> str:
    rows = []
    for defect in DEFECTS:
        own = [row for row in found if row.defect == defect.name]
        checks = sorted({row.check or row.crash for row in own if row.check or row.crash})
        number = f"{sum(bool(row.check) for row in own)} of {len(own)}"
        rows.append([defect.format, defect.name, defect.what, number, ", ".join(checks)])
    header = ["format", "defect", "what its maker did", "caught", "first check"]
    return "## Kinds\n\n" + markdown_table(header, rows) + "\n"


def _beside(found: Sequence[Planted], rivals: dict[str, dict[str, bool] | None]) -> str:
    kinds = [d.name for d in DEFECTS if any(name == d.name for said in rivals.values()
             for name in said or ())]  # fmt: skip
    ours = {name: all(row.check for row in found if row.defect == name) for name in kinds}
    table = {"artgen": ours, **rivals}
    total = [
        [name, "not installed" if said is None else f"{sum(said.values())} of {len(kinds)}"]
        for name, said in table.items()
    ]
    present = {name: said for name, said in table.items() if said is not None}
    rows = [[kind, *("x" if said.get(kind) else "" for said in present.values())] for kind in kinds]
    return "\n\n".join(
        [
            RIVALS.format(kinds=len(kinds)),
            markdown_table(["checker", "noticed"], total),
            markdown_table(["defect", *present], rows) + "\n",
        ]
    )
