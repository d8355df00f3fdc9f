"""`artgen validate`: a verdict for each bundle, with what was found."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_json
from artgen.export.layout import MANIFEST
from artgen.validate import Report, validate_bundle

PROGRESS_FROM = 20
"""Bundles; at 0.1 s each, fewer are done within two seconds."""


@dataclass(frozen=True, kw_only=True)
class Validate:
    """Check bundles from their files: structure, meshes, inertia, MuJoCo, clearance, sizes."""

    paths: Annotated[tuple[Path, ...], tyro.conf.Positional]
    """Bundle folders, or folders that hold bundles."""
    write: bool = False
    """Write report.json into each bundle."""


def validate(argv: Sequence[str]) -> int:
    """Print a verdict for each bundle; 0 all valid, 1 findings, 2 could not run (by UsageError)."""
    command = tyro.cli(Validate, args=list(argv), prog="artgen validate")
    folders = list(bundle_folders(command.paths))
    console = Console(highlight=False, soft_wrap=True)
    columns = (TextColumn("validating"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    failed = 0
    with Progress(
        *columns, console=console, transient=True, disable=len(folders) < PROGRESS_FROM
    ) as progress:
        for folder in progress.track(folders):
            report = validate_bundle(folder)
            failed += not report.ok
            for line in told(folder, report):
                console.print(line, markup=False)
            if command.write:
                write_json(folder / "report.json", report.as_json())
    console.print(f"{len(folders) - failed} of {len(folders)} bundles are valid", markup=False)
    return 1 if failed else 0


def bundle_folders(paths: Sequence[Path]) -> Iterator[Path]:
    """Every bundle at or below the paths, in order.

    Raises:
        UsageError: a path does not exist or holds no bundle.
    """
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
