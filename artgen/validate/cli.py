"""`artgen validate`: a verdict for each asset, with what was found."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from os import cpu_count
from pathlib import Path
from typing import Annotated, Literal

import tyro
from rich.console import Console

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes, write_json
from artgen.progress import progress
from artgen.validate.batch import Judgement, Task, judge_all
from artgen.validate.battery import LEVELS
from artgen.validate.bounds import load_bounds
from artgen.validate.find import found_sources
from artgen.validate.junit import junit_xml
from artgen.validate.levels import Selection
from artgen.validate.page import page
from artgen.validate.report import Report


@dataclass(frozen=True, kw_only=True)
class Validate:
    """Judge bundles, URDF, MJCF and USD files: structure, meshes, inertia, motion, dynamics.

    Assets are read, never changed, and nothing is written beside them.
    """

    paths: Annotated[tuple[Path, ...], tyro.conf.Positional]
    """Bundles, files, or folders that hold some."""
    profile: Literal["quick", "standard", "full"] = "standard"
    """quick: structure, meshes, compile; standard: all levels; full: also slow simulations."""
    check: Annotated[tuple[str, ...], tyro.conf.UseAppendAction] = ()
    """Only this check (mesh.closed) or level (L4), and what it relies on; may be repeated."""
    bounds: Path | None = None
    """A TOML file with bounds of your own, each with its reason."""
    root: Path | None = None
    """The folder inside which foreign files may name others; their own by default."""
    out: Path | None = None
    """Receives report.json and keeps each verdict; the same command resumes."""
    junit: Path | None = None
    """Receives the verdicts as JUnit XML."""
    html: Path | None = None
    """Receives one page with pictures of the worst poses."""
    workers: int = cpu_count() or 1
    """Processes side by side."""
    limit_s: float = 60.0
    """Seconds after which an asset is given up."""


def validate(argv: Sequence[str]) -> int:
    """Judge assets of any format and print a verdict for each: 0 all valid, 1 findings."""
    command = tyro.cli(Validate, args=list(argv), prog="artgen validate")
    selection = Selection(profile=command.profile, names=known_checks(command.check))
    bounds = load_bounds(command.bounds)
    sources = found_sources(command.paths, command.root)
    kept = None if command.out is None else command.out / "assets"
    tasks = [
        Task(
            source=source,
            selection=selection,
            bounds=bounds,
            kept=kept,
            drawn=command.html is not None,
        )
        for source in sources
    ]
    judged = list(told_in_order(command, tasks))
    named = [
        (str(j.source.root if j.report.format == "bundle" else j.source.file), j) for j in judged
    ]
    failed = sum(not judgement.report.ok for judgement in judged)
    if command.out is not None:
        write_json(command.out / "report.json", whole_report(command, named))
    if command.junit is not None:
        write_bytes(command.junit, junit_xml({name: j.report for name, j in named}))
    if command.html is not None:
        write_bytes(command.html, page(named).encode())
    _console().print(f"{len(judged) - failed} of {len(judged)} assets are valid")
    return 1 if failed else 0


def known_checks(names: Sequence[str]) -> tuple[str, ...]:
    """The names, when each is a check or a level; UsageError otherwise."""
    levels = {word for level in LEVELS for word in (level.name, level.name.split()[0])}
    checks = {name for level in LEVELS for check in level.checks for name in check.finds}
    for name in names:
        if name not in levels | checks:
            known = ", ".join(sorted(levels | checks))
            raise UsageError(f"--check {name}: no check or level of that name; known: {known}")
    return tuple(names)


def told_in_order(command: Validate, tasks: Sequence[Task]) -> Iterator[Judgement]:
    """Judgements in the order of the tasks, each printed as soon as all before it are."""
    console, places = _console(), {task.source.file: k for k, task in enumerate(tasks)}
    waiting: dict[int, Judgement] = {}
    following = 0
    with progress("validating", len(tasks)) as advance:
        outcomes = judge_all(tasks, workers=command.workers, limit_s=command.limit_s)
        for judgement in outcomes:
            waiting[places[judgement.source.file]] = judgement
            advance(judgement.report.asset)
            while following in waiting:
                ready = waiting.pop(following)
                following += 1
                for line in told(ready):
                    console.print(line, markup=False)
                yield ready


def told(judgement: Judgement) -> Iterator[str]:
    """The verdict and its reasons, a line each; what one reason kept from running is one line."""
    report, source = judgement.report, judgement.source
    place = source.root if source.format == "bundle" else source.file
    yield f"{'valid  ' if report.ok else 'INVALID'}  {report.asset}  {place}"
    for finding in report.findings:
        yield f"    {finding}"
    for note in report.notes:
        yield f"    {note.name}: {note.text}"
    for reason, names in reasons(report).items():
        yield f"    not checked: {', '.join(names)}: {reason}"


def reasons(report: Report) -> dict[str, list[str]]:
    """Reason to the checks that did not run for it."""
    found: dict[str, list[str]] = {}
    for skipped in report.skipped:
        own = found.setdefault(skipped.reason, [])
        own += [skipped.name] if skipped.name not in own else []
    return found


def whole_report(command: Validate, named: Sequence[tuple[str, Judgement]]) -> dict[str, object]:
    """What `report.json` of a run says: all verdicts, and under which bounds."""
    return {
        "schema": "artgen-validation/1",
        "profile": command.profile,
        "checks": list(command.check),
        "bounds": asdict(load_bounds(command.bounds)),
        "valid": sum(j.report.ok for _, j in named),
        "assets": [{"path": name, **j.report.as_json()} for name, j in named],
    }


def _console() -> Console:
    return Console(highlight=False, soft_wrap=True)
