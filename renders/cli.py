"""`artgen render`."""

import logging
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import tyro
from rich.console import Console

from artgen.core.errors import UsageError
from artgen.progress import progress
from artgen.run_folder import RunFolder, run_log
from renders.accuracy import quality
from renders.backends import BACKENDS, CHECKS, MakeBackend
from renders.contact_sheet import write_contact_sheet
from renders.report import print_report, render_report, write_report
from renders.run import Rendered, RenderTask, is_staged, planned_tasks, run_tasks
from renders.settings import PRESETS, Settings, checked
from renders.sources import (
    found_bundles,
    opened_rendering,
    rendering_folder,
    write_sources,
)

Preset = Literal["multiview", "monocular", "trajectory"]
SHEET = 96
"""Assets on the contact sheet at most."""


@dataclass(frozen=True, kw_only=True)
class Render:
    """Render bundles: all parts together and each alone, with labels and training targets.

    DIR is a run of `artgen generate`, a folder that holds bundles at any depth (generated,
    ingested, reconstructed), or one bundle. Interrupted runs resume: the same command again renders
    what is missing. A sample depends on its bundle, the settings and the seed alone.

    For example:

    artgen render out --views 12 --states 4 --size 256 --accuracy standard

    artgen render out --preset monocular --name mono

    artgen render scans --out scans-rendered --cameras.scheme sphere --cameras.look-at 0.1
    """

    source: Annotated[Path, tyro.conf.arg(metavar="DIR"), tyro.conf.Positional] = Path("out")
    """Run, folder of bundles, or bundle."""
    preset: Preset = "multiview"
    """Settings to start from, as ART trains: multiview (V=4, T=2), monocular (V=1, T=2), trajectory
    (V=1, 16 frames of one motion); options given beside it win."""
    out: Path | None = None
    """Folder that receives the rendering; by default DIR itself if it is a run, else DIR-renders.
    Bundles are never written to."""
    name: str | None = None
    """Name of a second rendering, with other settings, that lives in renders/NAME of that folder.
    """
    seed: int = 0
    """Root of all randomness."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side; the result is the same for any number."""
    settings: Annotated[Settings, tyro.conf.arg(name="")] = field(default_factory=Settings)


def render(argv: Sequence[str]) -> int:
    """Render bundles in several views and states, with labels."""
    words = list(argv)
    command = tyro.cli(
        Render, args=words, prog="artgen render", default=Render(settings=asked_preset(words))
    )
    settings = checked(command.settings)
    quality(settings.accuracy, settings.size)
    if command.workers < 1:
        raise UsageError(f"--workers {command.workers}: expected at least 1")
    CHECKS[settings.backend]()
    found = found_bundles(command.source)
    root = rendering_folder(command.source, out=command.out, name=command.name)
    with opened_rendering(root, command.source, seed=command.seed) as folder:
        tasks, refused = planned_tasks(folder, found, settings, command.seed)
        write_sources(folder, command.source, found)
        backend = BACKENDS[settings.backend]
        failed = [*refused, *render_all(folder, tasks, workers=command.workers, backend=backend)]
        staged = shown(folder, tasks)
    print(f"{staged} of {len(found)} assets rendered: {root / 'samples'}")  # noqa: T201
    return tell_failed(failed)


def shown(folder: RunFolder, tasks: Sequence[RenderTask]) -> int:
    """How many samples are staged; the contact sheet shows them."""
    staged = [task.sample for task in tasks if is_staged(task)]
    if staged:
        write_contact_sheet(folder.contact_sheet, staged[:SHEET])
    return len(staged)


def tell_failed(failed: Sequence[Rendered]) -> int:
    """One line for each; the exit code."""
    for outcome in sorted(failed, key=lambda outcome: outcome.asset_id):
        print(f"failed {outcome.asset_id}: {_line(outcome.message)}")  # noqa: T201
    return 1 if failed else 0


def asked_preset(words: Sequence[str]) -> Settings:
    """The preset that the words name; a name that does not exist is told by the parser."""
    asked = "multiview"
    for word, following in zip(words, [*words[1:], ""], strict=True):
        if word == "--preset":
            asked = following
        elif word.startswith("--preset="):
            asked = word.removeprefix("--preset=")
    return PRESETS.get(asked, Settings())


def render_all(
    folder: RunFolder, tasks: Sequence[RenderTask], *, workers: int, backend: MakeBackend
) -> list[Rendered]:
    """Render what is missing; the failures. One line per asset and stage in run.log, a report in
    render_report.json."""
    missing = [task for task in tasks if not is_staged(task)]
    if not missing:
        return []
    record, outcomes = run_log(folder), []
    started = time.perf_counter()
    with progress("renders", len(missing)) as advance:
        for outcome in run_tasks(folder, missing, workers=workers, backend=backend):
            _write_down(record, outcome)
            outcomes.append(outcome)
            advance(f"{outcome.asset_id} {'failed' if outcome.message else 'rendered'}")
    report = render_report(
        sorted(outcomes, key=lambda outcome: outcome.asset_id),
        missing[0].settings,
        kept=len(tasks) - len(missing),
        wall=time.perf_counter() - started,
    )
    write_report(folder.root / "render_report.json", report)
    print_report(report, Console())
    return [outcome for outcome in outcomes if outcome.message]


def _write_down(record: logging.Logger, outcome: Rendered) -> None:
    if outcome.account is not None:
        for stage, seconds in outcome.account.seconds.items():
            record.info("%s %s %.2f s", outcome.asset_id, stage, seconds)
    record.info("%s render: %s", outcome.asset_id, outcome.message or "staged")


def _line(message: str) -> str:
    """The first line of a message; Blender's log, which may follow, is in logs/."""
    first, *more = message.splitlines()
    return first.removesuffix(" ends with:") if more else first
