"""`artgen validate`: a verdict for each bundle, with what was found."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Annotated

import tyro
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_json
from artgen.export.layout import MANIFEST, REPORT
from artgen.validate import Report, validate_bundle

QUIET_S = 2.0
"""Runs that are shorter show no progress bar."""


@dataclass(frozen=True, kw_only=True)
class Validate:
    """Check bundles from their files: structure, meshes, inertia, MuJoCo, clearance, sizes."""

    paths: Annotated[tuple[Path, ...], tyro.conf.Positional]
    """Bundle folders, or folders that hold bundles."""
    write: bool = False
    """Write report.json into each bundle."""


def validate(argv: Sequence[str]) -> int:
    """Check bundles from their files and print a verdict for each: 0 all valid, 1 findings."""
    command = tyro.cli(Validate, args=list(argv), prog="artgen validate")
    folders = list(bundle_folders(command.paths))
    columns = (TextColumn("validating"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    progress = Progress(*columns, console=Console(highlight=False, soft_wrap=True), transient=True)
    task, began, failed = progress.add_task("validating", total=len(folders)), perf_counter(), 0
    try:
        for folder in folders:
            report = validate_bundle(folder)
            failed += not report.ok
            for line in told(folder, report):
                progress.console.print(line, markup=False)
            if command.write:
                write_json(folder / REPORT, report.as_json())
            progress.advance(task)
            if perf_counter() - began > QUIET_S:
                progress.start()
    finally:
        if progress.live.is_started:
            progress.stop()
    progress.console.print(f"{len(folders) - failed} of {len(folders)} bundles are valid")
    return 1 if failed else 0


def bundle_folders(paths: Sequence[Path]) -> Iterator[Path]:
    """Every bundle at or below the paths, in order.

    Raises:
        UsageError: there is no path, or one does not exist or holds no bundle.
    """
    if not paths:
        raise UsageError("artgen validate needs a path, for example out/assets")
    for path in paths:
        if not path.is_dir():
            raise UsageError(
                f"{path} is not a folder; name a bundle or a folder that holds bundles"
            )
        found = sorted(manifest.parent for manifest in path.rglob(MANIFEST))
        if not found:
            raise UsageError(f"{path} holds no {MANIFEST}; is it the output of artgen generate?")
        yield from found


def told(folder: Path, report: Report) -> Iterator[str]:
    """The verdict and its reasons, a line each."""
    yield f"{'valid  ' if report.ok else 'INVALID'}  {report.asset}  {folder}"
    for finding in report.findings:
        yield f"    {finding}"
    for skipped in report.skipped:
        yield f"    not checked: {skipped.name}: {skipped.reason}"
