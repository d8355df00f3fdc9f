"""A run over many objects: processes side by side, resumable, one outcome each."""

import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from artgen import __version__
from artgen.core.errors import UsageError
from artgen.core.jsonio import content_hash, file_hash, plain, write_json
from artgen.ingest.found import Found, named
from artgen.ingest.options import Options
from artgen.ingest.partnet.folder import annotation_digest
from artgen.ingest.task import IngestTask, Kind, Outcome, ingest, refused
from artgen.pipeline import Toolbox
from artgen.pool import run_in_processes
from artgen.progress import Show
from artgen.run_folder import RunFolder, run_log

OBJECT_TIMEOUT_S = 900.0
"""An object takes 5 to 30 s; a process that hangs for this long is killed, its object refused."""


def ingest_all(
    folder: RunFolder,
    kind: Kind,
    found: Sequence[Found],
    options: Options,
    *,
    workers: int,
    show: Show,
) -> list[Outcome]:
    """An outcome for each object, in the order of `found`; those of an earlier run are kept.

    Raises:
        UsageError: the folder holds objects that were read with other settings.
    """
    settings = content_hash([kind, options, __version__])
    listed = [(_task(name, entry, kind, options), entry) for name, entry in named(found, kind)]
    outcomes: dict[str, Outcome] = {}
    waiting = []
    for task, entry in listed:
        if entry.problem is not None:
            outcomes[task.asset_id] = refused(task, entry.problem)
        elif (kept := kept_outcome(folder, task, settings)) is not None:
            outcomes[task.asset_id] = kept
        else:
            waiting.append(task)
    log = run_log(folder)
    with show("objects", len(waiting)) as advance:
        for outcome in run_tasks(folder, waiting, workers=workers):
            outcomes[outcome.asset_id] = outcome
            task = next(task for task in waiting if task.asset_id == outcome.asset_id)
            write_record(folder, task, outcome, settings)
            log.info("%s %s %s", outcome.asset_id, outcome.status, outcome.message)
            advance(f"{outcome.asset_id} {outcome.status}")
    return [outcomes[task.asset_id] for task, _ in listed]


def _task(name: str, entry: Found, kind: Kind, options: Options) -> IngestTask:
    return IngestTask(
        kind=kind,
        path=entry.path,
        asset_id=name,
        options=options,
        root=entry.root if kind == "urdf" else None,
    )


def run_tasks(folder: RunFolder, tasks: Sequence[IngestTask], *, workers: int) -> Iterator[Outcome]:
    """Outcomes as they come; a process that dies twice costs its own object alone."""
    if not tasks:
        return iter(())
    return run_in_processes(
        tasks,
        _in_worker,
        workers=min(workers, len(tasks)),
        initializer=_open_toolbox,
        initargs=(folder,),
        timeout_s=OBJECT_TIMEOUT_S,
        lost=refused,
    )


_tools: Toolbox | None = None
"""Of this worker process; set once by the pool's initializer, as pools offer no other way."""


def _open_toolbox(folder: RunFolder) -> None:
    global _tools
    _tools = Toolbox(folder, str(os.getpid()))


def _in_worker(task: IngestTask) -> Outcome:
    if _tools is None:
        raise RuntimeError("the pool did not open its toolbox")
    return ingest(task, _tools)


def record_path(folder: RunFolder, asset_id: str) -> Path:
    """Where the outcome of an object is kept, so that a run can resume."""
    return folder.logs / "ingest" / f"{asset_id}.json"


def write_record(folder: RunFolder, task: IngestTask, outcome: Outcome, settings: str) -> None:
    """Keep an outcome; `settings` is a hash of all that it depends on but the source's files, of
    which those that say what the object is are hashed beside."""
    entry = {
        "settings": settings,
        **_places(task),
        "read": read_digest(task),
        "outcome": plain(outcome),
    }
    write_json(record_path(folder, task.asset_id), entry)


def read_digest(task: IngestTask) -> str | None:
    """Of the file that an object is read from, or of its folder's annotation; None where it cannot
    be read."""
    try:
        return annotation_digest(task.path) if task.path.is_dir() else file_hash(task.path)
    except OSError:
        return None


def _places(task: IngestTask) -> dict[str, str | None]:
    root = task.path.parent if task.root is None and task.kind == "urdf" else task.root
    return {"path": _real(task.path), "root": _real(root)}


def _real(place: object) -> str | None:
    """Where a place really is, however it is spelled: relative, with a slash behind it, by a
    link."""
    return None if place is None else os.path.realpath(str(place))


def kept_outcome(folder: RunFolder, task: IngestTask, settings: str) -> Outcome | None:
    """The outcome of an earlier run whose bundle is there; None where it is to be made, as after
    a refusal.

    Raises:
        UsageError: it was made with other settings, of another place's files, or of another
            annotation.
    """
    path = record_path(folder, task.asset_id)
    if not path.exists():
        return None
    try:
        stated: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        outcome = Outcome(**stated["outcome"])
    except (OSError, ValueError, TypeError, KeyError):
        return None  # A damaged record costs one object's time.
    if outcome.status == "refused":
        return None
    if stated.get("settings") != settings:
        raise UsageError(
            f"{folder.root}: {task.asset_id} was ingested with other settings or by another version"
            "; choose a new --out (nothing is overwritten)"
        )
    for key, place in _places(task).items():
        if _real(stated.get(key)) != place:
            raise UsageError(
                f"{folder.root}: {task.asset_id} was ingested from {key} {stated.get(key)}, not "
                f"{place}; name that one, or choose a new --out (nothing is overwritten)"
            )
    home = folder.assets / outcome.category / task.asset_id
    if not (home / "manifest.json").exists():
        return None
    if "read" in stated and stated["read"] != read_digest(task):
        raise UsageError(
            f"{task.path}: has changed since {task.asset_id} was made of it; remove {home} to have "
            "it made anew, or choose a new --out (nothing is overwritten)"
        )
    return outcome
