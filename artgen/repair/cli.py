"""`artgen repair`: a mended copy of a foreign URDF, what was changed, and both verdicts."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro
from rich.console import Console

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_json
from artgen.repair.change import Change, Left, Outcome
from artgen.repair.collision import PIECES
from artgen.repair.mend import mended
from artgen.validate import Report, validate_asset
from artgen.validate.bounds import load_bounds
from artgen.validate.find import found_sources
from artgen.validate.levels import Selection
from artgen.validate.urdf_subject import UrdfSubject

SCHEMA = "artgen-repair/1"


@dataclass(frozen=True, kw_only=True)
class Repair:
    """Write a mended copy of a URDF asset, say what was changed, and judge it.

    The original is read, never changed.
    """

    path: Annotated[Path, tyro.conf.Positional]
    """A URDF file, or a folder that holds one and no other asset."""
    out: Path
    """A new or empty folder: receives the copy, repair.json (changes) and report.json (verdict)."""
    root: Path | None = None
    """The folder inside which the file may name others; its own by default."""
    pieces: int = PIECES
    """Convex pieces that CoACD may make of one body."""
    bounds: Path | None = None
    """A TOML file with bounds of your own, each with its reason."""


def repair(argv: Sequence[str]) -> int:
    """Mend a copy of a foreign URDF and judge it: 0 valid now, 1 findings are left."""
    command = tyro.cli(Repair, args=list(argv), prog="artgen repair")
    sources = found_sources([command.path], command.root)
    if len(sources) != 1 or sources[0].format != "urdf":
        held = ", ".join(f"{source.file.name} ({source.format})" for source in sources)
        raise UsageError(
            f"{command.path} holds {held}; artgen repair mends one URDF file at a time"
        )
    if command.out.exists() and (not command.out.is_dir() or any(command.out.iterdir())):
        raise UsageError(f"--out {command.out} is not empty; name a new folder")
    original = UrdfSubject(source=sources[0], bounds=load_bounds(command.bounds))
    before = validate_asset(original.source, Selection(), original.bounds)
    draft, outcomes = mended(original, command.out, pieces=command.pieces)
    after = validate_asset(draft.source, Selection(), original.bounds)
    write_json(command.out / "repair.json", told(outcomes))
    write_json(command.out / "report.json", after.as_json())
    console = Console(highlight=False, soft_wrap=True)
    for line in lines(original.source.file, draft.source.file, before, outcomes, after):
        console.print(line, markup=False)
    return 0 if after.ok else 1


def told(outcomes: Sequence[Outcome]) -> dict[str, object]:
    """What `repair.json` says."""
    return {
        "schema": SCHEMA,
        "changes": [change.as_json() for change in outcomes if isinstance(change, Change)],
        "left": [left for left in outcomes if isinstance(left, Left)],
    }


def lines(
    original: Path, copy: Path, before: Report, outcomes: Sequence[Outcome], after: Report
) -> list[str]:
    """Both verdicts, and between them what was changed and what was left."""
    said = [_verdict(before, original)]
    said += [f"    {finding}" for finding in before.findings]
    for outcome in outcomes:
        said.append(f"{'changed' if isinstance(outcome, Change) else 'left   '}  {outcome}")
    said.append(_verdict(after, copy))
    return [*said, *(f"    {finding}" for finding in after.findings)]


def _verdict(report: Report, file: Path) -> str:
    return f"{'valid  ' if report.ok else 'INVALID'}  {file}"
