"""`artgen render`."""

import logging
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import UsageError
from artgen.progress import progress
from artgen.run_folder import RunFolder, locked, run_log
from artgen.system_libraries import check_libraries
from renders.accuracy import quality
from renders.contact_sheet import write_contact_sheet
from renders.run import Rendered, RenderTask, is_staged, planned_tasks, run_tasks
from renders.settings import Settings


@dataclass(frozen=True, kw_only=True)
class Render:
    """Render every bundle of a run: all parts together and each alone, with labels and targets.

    Interrupted runs resume. A sample depends on its bundle, these settings and the seed alone.
    """

    out: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder of the run; receives samples/ and contact_sheet.png."""
    views: int = 4
    """Cameras per asset."""
    states: int = 2
    """Joint states per asset; the first of several is closed."""
    size: int = 128
    """Image width and height, px."""
    accuracy: str = "standard"
    """A preset (draft, standard, high, reference) or paths a pixel such as 16spp."""
    seed: int = 0
    """Root of all randomness."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side; the result is the same for any number."""


def render(argv: Sequence[str]) -> int:
    """Render bundles in several views and states, with labels."""
    command = tyro.cli(Render, args=list(argv), prog="artgen render")
    settings = checked(command)
    check_libraries()
    if not command.out.is_dir():
        raise UsageError(f"{command.out}: no such folder; name a run of `artgen generate`")
    folder = RunFolder(command.out)
    with locked(command.out):
        tasks = planned_tasks(folder, settings, command.seed)
        failed = render_all(folder, tasks, workers=command.workers)
        if staged := [task.sample for task in tasks if is_staged(task)]:
            write_contact_sheet(folder.contact_sheet, staged)
    print(f"{len(staged)} of {len(tasks)} assets rendered: {command.out / 'samples'}")  # noqa: T201
    for outcome in failed:
        print(f"failed {outcome.asset_id}: {outcome.message}")  # noqa: T201
    return 1 if failed else 0


def checked(command: Render) -> Settings:
    """The settings of a sensible command.

    Raises:
        UsageError: a number is out of bounds.
    """
    least = {"views": 1, "states": 1, "size": 16, "workers": 1}
    for name, bound in least.items():
        if (value := getattr(command, name)) < bound:
            raise UsageError(f"--{name} {value} is too small; ask for at least {bound}")
    quality(command.accuracy)
    return Settings(
        views=command.views, states=command.states, size=command.size, accuracy=command.accuracy
    )


def render_all(folder: RunFolder, tasks: Sequence[RenderTask], *, workers: int) -> list[Rendered]:
    """Render what is missing; the failures, sorted. One line per asset and stage in run.log."""
    missing = [task for task in tasks if not is_staged(task)]
    if not missing:
        return []
    record, failed = run_log(folder), []
    with progress("renders", len(missing)) as advance:
        for outcome in run_tasks(folder, missing, workers=workers):
            _write_down(record, outcome)
            if outcome.message:
                failed.append(outcome)
            advance(f"{outcome.asset_id} {'failed' if outcome.message else 'rendered'}")
    return sorted(failed, key=lambda outcome: outcome.asset_id)


def _write_down(record: logging.Logger, outcome: Rendered) -> None:
    for stage, seconds in outcome.seconds.items():
        record.info("%s %s %.2f s", outcome.asset_id, stage, seconds)
    record.info("%s render: %s", outcome.asset_id, outcome.message or "staged")
