"""`artgen farm`: plan here, render elsewhere, collect here."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import tyro

from artgen.core.errors import UsageError
from renders.accuracy import quality
from renders.backends import CYCLES
from renders.cli import Preset, asked_preset, render_all, shown, tell_failed
from renders.farm.collect import blenders, farm_backend, frames, returned
from renders.farm.export import JobFile, write_job
from renders.farm.folder import ITEMS, MANIFEST, Farm, read_farm, write_farm
from renders.farm.plan import plan_all
from renders.run import Rendered, RenderTask, is_staged, planned_tasks, unique_tasks
from renders.settings import Settings, checked
from renders.sources import found_bundles, opened_rendering, rendering_folder, write_sources

INTRODUCTION = """\
artgen farm: render on other machines, with nothing on them but Blender.

usage: artgen farm ACTION [OPTIONS]        (artgen farm ACTION --help explains each option)

  plan DIR --out FARM                write the folder that travels: a manifest and what it names
  export --to KIND --manifest M      write a job file for opencue, slurm, flamenco, deadline, openjd
  collect FARM                       make samples of what came back, the same as artgen render's

In between, by hand or by a farm (docs/farms.md):
  blender -b --factory-startup --python-exit-code 1 -P blender_scripts/render_shard.py -- \\
      --manifest FARM/manifest.jsonl --start 0 --end 9
"""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Plan renders as plain files: line k of FARM/manifest.jsonl is item k, one bundle's images.

    Asks for the same options as `artgen render`, of which it is the first half; the same command
    again keeps what is there.
    """

    source: Annotated[Path, tyro.conf.arg(metavar="DIR"), tyro.conf.Positional]
    """Run, folder of bundles, or bundle."""
    out: Path
    """Folder that receives the manifest and the files it names; may be moved or mounted elsewhere
    while items are rendered."""
    preset: Preset = "multiview"
    """Settings to start from, as for `artgen render`; options given beside it win."""
    seed: int = 0
    """Root of all randomness."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side."""
    settings: Annotated[Settings, tyro.conf.arg(name="")] = field(default_factory=Settings)


@dataclass(frozen=True, kw_only=True)
class Collect:
    """Make samples of rendered items, byte for byte those of `artgen render` with these settings.

    Items that are missing, failed or damaged are named; render them and collect again.
    """

    farm: Annotated[Path, tyro.conf.arg(metavar="FARM"), tyro.conf.Positional]
    """What `artgen farm plan` wrote."""
    source: Path | None = None
    """Where the bundles lie; by default where they were planned from, seen from FARM."""
    images: Path | None = None
    """What render_shard.py was given as --out; by default FARM/items."""
    out: Path | None = None
    """Folder that receives the samples, as for `artgen render`."""
    name: str | None = None
    """Name of a second rendering, as for `artgen render`."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side."""


@dataclass(frozen=True, kw_only=True)
class Export:
    """Write a job file that renders all items of a manifest, `chunk` of them a task."""

    to: Literal["opencue", "slurm", "flamenco", "deadline", "openjd"]
    """Whose job file."""
    manifest: Path
    """As the machines of the farm see it; must be readable here too, to count its items."""
    out: Path
    """File to write; for Deadline the job info, with the plugin info beside it."""
    blender: str = "blender"
    """Blender on the machines of the farm; a name that begins with `python` is a Python with the
    bpy wheel."""
    script: Path = Path(__file__).resolve().parents[2] / "blender_scripts" / "render_shard.py"
    """render_shard.py as the machines of the farm see it, in a copy of this repository."""
    chunk: int = 10
    """Items a task renders in one process."""


def farm(argv: Sequence[str]) -> int:
    """Render on farms: plan a manifest, write job files, collect what comes back."""
    if not argv or argv[0] in ("-h", "--help"):
        print(INTRODUCTION)  # noqa: T201
        return 0 if argv else 2
    if argv[0] not in ACTIONS:
        raise UsageError(f"no farm action {argv[0]!r}; known: {', '.join(ACTIONS)}")
    return ACTIONS[argv[0]](list(argv[1:]))


def _plan(words: list[str]) -> int:
    command = tyro.cli(
        Plan,
        args=words,
        prog="artgen farm plan",
        default=Plan(source=tyro.MISSING, out=tyro.MISSING, settings=asked_preset(words)),
    )
    settings = checked(command.settings)
    if settings.backend != CYCLES:
        raise UsageError(f"--backend {settings.backend}: farms render with cycles alone")
    quality(settings.accuracy, settings.size)
    _check_workers(command.workers)
    found = found_bundles(command.source)
    write_farm(command.out, Farm(source=command.source, settings=settings, seed=command.seed))
    tasks, refused = unique_tasks(command.out / "samples", found, settings, command.seed)
    failed = plan_all(command.out, tasks, workers=command.workers)
    planned = len(tasks) - len(failed)
    print(f"{planned} of {len(found)} assets planned: {command.out / MANIFEST}")  # noqa: T201
    told = [Rendered(asset_id=plan.asset_id, message=plan.message) for plan in failed]
    return tell_failed([*refused, *told])


def _collect(words: list[str]) -> int:
    command = tyro.cli(Collect, args=words, prog="artgen farm collect")
    _check_workers(command.workers)
    plan = read_farm(command.farm)
    source = command.source or plan.source
    images = command.images or command.farm / ITEMS
    items = returned(command.farm, images)
    found = [bundle for bundle in found_bundles(source) if bundle.asset_id in items]
    root = rendering_folder(source, out=command.out, name=command.name)
    with opened_rendering(root, source, seed=plan.seed) as folder:
        tasks, failed = planned_tasks(folder, found, plan.settings, plan.seed)
        write_sources(folder, source, found)
        ready, lacking = _sorted(tasks, {name: item.fault for name, item in items.items()})
        digests = {name: item.digest for name, item in items.items()}
        backend = partial(farm_backend, images.resolve(), digests)
        failed += [*lacking, *_gone(items, found_ids={bundle.asset_id for bundle in found})]
        failed += render_all(folder, ready, workers=command.workers, backend=backend)
        staged = shown(folder, tasks)
    print(f"{staged} of {len(items)} items collected: {root / 'samples'}")  # noqa: T201
    for version, count in sorted(blenders(items).items()):
        print(f"rendered by Blender {version}: {count}")  # noqa: T201
    if lacking:
        again = frames([items[outcome.asset_id].number for outcome in lacking])
        print(f"to be rendered again: --frames {again}")  # noqa: T201
    return tell_failed(failed)


def _sorted(
    tasks: Sequence[RenderTask], faults: Mapping[str, str | None]
) -> tuple[list[RenderTask], list[Rendered]]:
    """Tasks whose images are there, or whose samples were collected before; and the others."""
    ready, lacking = [], []
    for task in tasks:
        fault = faults[task.asset_id]
        if fault is None or is_staged(task):
            ready.append(task)
        else:
            lacking.append(Rendered(asset_id=task.asset_id, message=fault))
    return ready, lacking


def _gone(items: Mapping[str, object], *, found_ids: set[str]) -> list[Rendered]:
    return [
        Rendered(asset_id=name, message="its bundle is gone; name its folder by --source")
        for name in items
        if name not in found_ids
    ]


def _export(words: list[str]) -> int:
    command = tyro.cli(Export, args=words, prog="artgen farm export")
    job = JobFile(
        manifest=command.manifest,
        blender=command.blender,
        script=command.script,
        chunk=command.chunk,
    )
    for path in write_job(command.to, job, command.out):
        print(path)  # noqa: T201
    return 0


def _check_workers(workers: int) -> None:
    if workers < 1:
        raise UsageError(f"--workers {workers}: expected at least 1")


ACTIONS: Mapping[str, Callable[[list[str]], int]] = {
    "plan": _plan,
    "export": _export,
    "collect": _collect,
}
