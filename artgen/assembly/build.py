"""A library built from generators and bundles: processes side by side, resumable, cached."""

import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen import __version__
from artgen.assembly.harvest import (
    Made,
    bundle_id,
    bundle_source,
    made_source,
    refuse_assembled,
)
from artgen.assembly.library import seal_library
from artgen.assembly.source import Source
from artgen.assembly.store import write_source
from artgen.core.errors import ArtgenError, UsageError
from artgen.core.jsonio import file_hash, plain, write_json
from artgen.core.mesh import Floats, Ints
from artgen.export.layout import MANIFEST
from artgen.finish import RawBody
from artgen.pipeline import Toolbox, rounded
from artgen.pool import run_in_processes
from artgen.progress import Show
from artgen.run_folder import RunFolder

EDITION = 3
"""Of how sources are taken apart; a library of another one is not gone on with."""
TIMEOUT_S = 300.0
"""A source takes under a second; a process that hangs for this long is killed."""


@dataclass(frozen=True, kw_only=True)
class SourceTask:
    """One source to take apart: made by a generator, or a bundle on disk.

    Attributes:
        id: of the source that comes of it.
    """

    folder: Path
    id: str
    made: Made | None = None
    bundle: Path | None = None
    sharp: bool = False

    @property
    def asset_id(self) -> str:
        """For messages."""
        return self.made.asset_id if self.made else str(self.bundle)


@dataclass(frozen=True, kw_only=True)
class Taken:
    """What became of a task: the id of a source that now lies in the library, or a fault."""

    task: str
    id: str = ""
    fault: str = ""


def build_library(
    folder: Path,
    *,
    made: Sequence[Made],
    bundles: Sequence[Path],
    workers: int,
    show: Show,
    sharp: bool = False,
) -> tuple[str, list[Taken]]:
    """Write a library; its digest, and what could not be taken in.

    Sources that lie in the folder already are kept, so that an interrupted build goes on. Of equal
    bundles one is taken in.

    Args:
        sharp: leave edges sharp, without Blender.

    Raises:
        UsageError: no source could be taken in, or those in the folder were made otherwise.
    """
    claim(folder, sharp=sharp)
    tasks = [SourceTask(folder=folder, id=one.asset_id, made=one, sharp=sharp) for one in made]
    found, taken = _bundle_tasks(folder, bundles)
    tasks += found
    there = {task.id for task in tasks if (folder / "sources" / f"{task.id}.json").exists()}
    taken += [Taken(task=task.asset_id, id=task.id) for task in tasks if task.id in there]
    missing = [task for task in tasks if task.id not in there]
    with show("sources", len(missing)) as advance:
        for outcome in _outcomes(missing, workers):
            taken.append(outcome)
            advance(f"{outcome.task} {outcome.fault}")
    ids = sorted(outcome.id for outcome in taken if outcome.id)
    if not ids:
        raise UsageError(f"{folder}: no source could be taken in: {taken[0].fault}")
    recipe = {
        "made": [plain(one) for one in made],
        "bundles": sorted({file_hash(task.bundle / MANIFEST) for task in found if task.bundle}),
        "sharp": sharp,
    }
    digest = seal_library(folder, ids, recipe=recipe)
    return digest, [outcome for outcome in taken if outcome.fault]


def claim(folder: Path, *, sharp: bool) -> None:
    """Say in build.json how the sources of a folder are made, before the first of them is.

    Raises:
        UsageError: there are some that were made otherwise, or nobody knows how.
    """
    path = folder / "build.json"
    wanted = {"edition": EDITION, "sharp": sharp, "artgen": __version__}
    if not any((folder / "sources").glob("*.json")):
        write_json(path, wanted)
        return
    try:
        stated = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        stated = {}
    if stated != wanted:
        how = f"with {json.dumps(stated)}" if stated else "with settings that it does not state"
        raise UsageError(
            f"{folder}: its sources were made {how}, not with {json.dumps(wanted)}; choose a new "
            "--out (nothing is overwritten), or remove the folder"
        )


def _bundle_tasks(folder: Path, bundles: Sequence[Path]) -> tuple[list[SourceTask], list[Taken]]:
    """A task for each bundle, and those that cannot be read or are there twice."""
    tasks: dict[str, SourceTask] = {}
    faults = []
    for bundle in bundles:
        try:
            refuse_assembled(bundle)
            id = bundle_id(bundle)
        except ArtgenError as error:
            faults.append(Taken(task=str(bundle), fault=str(error)))
            continue
        task = SourceTask(folder=folder, id=id, bundle=bundle)
        if tasks.setdefault(id, task) is not task:
            twin = f"is the same as {tasks[id].asset_id}"
            faults.append(Taken(task=str(bundle), fault=twin))
    return list(tasks.values()), faults


def _outcomes(tasks: Sequence[SourceTask], workers: int) -> Iterator[Taken]:
    if not tasks:
        return iter(())
    return run_in_processes(
        tasks,
        _task_in_worker,
        workers=workers,
        initializer=_open_tools,
        initargs=(tasks[0].folder,),
        timeout_s=TIMEOUT_S,
        lost=lambda task, cause: Taken(task=task.asset_id, fault=cause),
    )


_tools: Toolbox | None = None
"""Of this worker process; set once by the pool's initializer, as pools offer no other way."""


def _open_tools(folder: Path) -> None:
    global _tools
    _tools = Toolbox(RunFolder(folder / "scratch"), str(os.getpid()))


def _task_in_worker(task: SourceTask) -> Taken:
    """Take one source apart and write it; faults of one become its outcome."""
    if _tools is None:
        raise RuntimeError("the pool did not open its tools")
    try:
        source = take_apart(task, _tools)
        write_source(task.folder, source)
    except ArtgenError as error:
        return Taken(task=task.asset_id, fault=str(error))
    return Taken(task=task.asset_id, id=source.id)


def take_apart(task: SourceTask, tools: Toolbox) -> Source:
    """The source of a task.

    Raises:
        ArtgenError: it cannot be made or read.
    """
    if task.bundle is not None:
        return bundle_source(task.bundle)
    if task.made is None:
        raise UsageError("a task names neither what to make nor a bundle")
    return made_source(task.made, sharp if task.sharp else lambda bodies: rounded(bodies, tools))


def sharp(bodies: Sequence[RawBody]) -> list[tuple[Floats, Ints]]:
    """Bodies as they are, edges sharp: a rounder that needs no Blender."""
    return [(body.vertices, body.faces) for body in bodies]
