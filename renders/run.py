"""Many assets to staged samples: processes side by side, resumable, faults set aside."""

import json
import logging
import os
import shutil
import traceback
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.cli import FULL_DISK
from artgen.core.errors import ArtgenError, ShardError, UsageError
from artgen.core.jsonio import plain, write_json
from artgen.dataset import open_shard
from artgen.export import read_bundle
from artgen.export.manifest import versions
from artgen.pool import run_in_processes
from artgen.run_folder import RunFolder
from renders.accuracy import quality
from renders.asset import Account, render_asset
from renders.backends import TIMEOUT_PER_IMAGE_S, TIMEOUT_PER_PATH_S, Backend, MakeBackend
from renders.settings import Settings
from renders.sources import SAFE, Found

log = logging.getLogger(__name__)

ASSET_TIMEOUT_S = 3600.0
MOST_PARTS = 30
"""For a limit that is beyond every limit of the Blender worker itself, which tries twice."""


@dataclass(frozen=True, kw_only=True)
class RenderTask:
    """One asset to render; the sample depends on the bundle, `settings` and `seed` alone."""

    asset_id: str
    bundle: Path
    sample: Path
    settings: Settings
    seed: int


@dataclass(frozen=True, kw_only=True)
class Rendered:
    """What became of a task; an empty message means that its sample is staged."""

    asset_id: str
    message: str = ""
    account: Account | None = None


def planned_tasks(
    folder: RunFolder, found: Sequence[Found], settings: Settings, seed: int
) -> tuple[list[RenderTask], list[Rendered]]:
    """One task for every bundle, and those that cannot be told apart or named.

    Raises:
        UsageError: samples/ was rendered with other settings.
    """
    samples = folder.root / "samples"
    _remember(samples / "settings.json", settings, seed)
    return unique_tasks(samples, found, settings, seed)


def unique_tasks(
    samples: Path, found: Sequence[Found], settings: Settings, seed: int
) -> tuple[list[RenderTask], list[Rendered]]:
    """One task for every bundle, and those that cannot be told apart or named."""
    times = Counter(bundle.asset_id for bundle in found)
    tasks, refused = [], []
    for bundle in found:
        if message := _unnameable(bundle, times[bundle.asset_id]):
            refused.append(Rendered(asset_id=bundle.asset_id, message=message))
            continue
        tasks.append(
            RenderTask(
                asset_id=bundle.asset_id,
                bundle=bundle.folder,
                sample=samples / bundle.sample,
                settings=settings,
                seed=seed,
            )
        )
    return tasks, refused


def _unnameable(bundle: Found, times: int) -> str:
    if not (SAFE.fullmatch(bundle.asset_id) and SAFE.fullmatch(bundle.category)):
        return (
            f"{bundle.folder}: asset id {bundle.asset_id!r} and category {bundle.category!r} must "
            "be letters, digits, - and _; rename them in the manifest"
        )
    if times > 1:
        return (
            f"{bundle.folder}: {times} bundles call themselves {bundle.asset_id}; render them from "
            "separate folders, each with its own --out"
        )
    return ""


def is_staged(task: RenderTask) -> bool:
    """True when the sample is there and whole."""
    try:
        open_shard(task.sample)
    except (ShardError, OSError):
        return False
    return True


def run_tasks(
    folder: RunFolder, tasks: Sequence[RenderTask], *, workers: int, backend: MakeBackend
) -> Iterator[Rendered]:
    """Outcomes as they come; cores beyond the number of processes become render threads."""
    shutil.rmtree(scratch(folder), ignore_errors=True)  # of a run that was killed
    processes = max(1, min(workers, len(tasks)))
    settings = tasks[0].settings
    return run_in_processes(
        tasks,
        _task_in_worker,
        workers=processes,
        initializer=_open_worker,
        initargs=(folder, backend, max(1, workers // processes)),
        timeout_s=_asset_timeout(settings),
        lost=lambda task, cause: Rendered(asset_id=task.asset_id, message=cause),
    )


def _asset_timeout(settings: Settings) -> float:
    """Seconds after which a process that is still at one asset hangs."""
    images = (1 + MOST_PARTS) * settings.views * settings.states
    samples = quality(settings.accuracy, settings.size).samples
    paths = images * settings.size**2 * samples
    return ASSET_TIMEOUT_S + 2.0 * (TIMEOUT_PER_IMAGE_S * images + TIMEOUT_PER_PATH_S * paths)


def scratch(folder: RunFolder) -> Path:
    """Where images lie until they are packed into a sample."""
    return folder.work / "render"


def _remember(path: Path, settings: Settings, seed: int) -> None:
    """Write down how samples are rendered, or check that it has not changed."""
    asked = plain({"settings": settings, "seed": seed, "versions": versions()})
    if not path.exists():
        write_json(path, asked)
        return
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise UsageError(
            f"{path}: is damaged ({error}), so nobody knows how the samples beside it were "
            "rendered; delete that folder to render anew"
        ) from error
    if found != asked:
        changed = ", ".join(_changes(asked, found))
        raise UsageError(
            f"{path.parent}: was rendered with other {changed} (see {path.name}); ask for the "
            "same, give this rendering a --name of its own, or delete that folder to render anew"
        )


def _changes(asked: dict[str, object], found: object, where: str = "") -> Iterator[str]:
    """The options that differ, as `views 4 (now 2)`."""
    for key, value in asked.items():
        before = found.get(key) if isinstance(found, dict) else None
        if isinstance(value, dict):
            yield from _changes(value, before, where if key == "settings" else f"{where}{key}.")
        elif before != value:
            yield f"{where}{key} {before} (now {value})"


_worker: tuple[Backend, Path] | None = None
"""Of this process, with its scratch folder; set once by the pool's initializer."""


def _open_worker(folder: RunFolder, backend: MakeBackend, threads: int) -> None:
    global _worker
    log_file = folder.logs / f"blender-render-{os.getpid()}.log"
    _worker = backend(log_file, threads), scratch(folder)


def _task_in_worker(task: RenderTask) -> Rendered:
    """Faults of one asset become its outcome; the process goes on."""
    if _worker is None:
        raise RuntimeError("the pool did not open its worker")
    backend, images = _worker
    try:
        account = render_asset(
            read_bundle(task.bundle),
            task.sample,
            settings=task.settings,
            seed=task.seed,
            scratch=images,
            backend=backend,
        )
    except Exception as error:  # One asset must not end a run of thousands, whatever is wrong.
        return Rendered(asset_id=task.asset_id, message=told(error))
    return Rendered(asset_id=task.asset_id, account=account)


def told(error: Exception) -> str:
    """A fault of one asset in one line, but for the log of Blender that a WorkerError quotes; of
    one that is ours the traceback is logged."""
    if isinstance(error, OSError) and error.errno in FULL_DISK:
        place = error.filename or "the output folder"
        return f"{place}: no space left; free some, then run the same command"
    if isinstance(error, MemoryError):
        return f"out of memory ({error}); ask for fewer --views or --states, or a smaller --size"
    if isinstance(error, ArtgenError | OSError):
        return str(error)
    log.error("unexpected fault", exc_info=error)
    place = traceback.extract_tb(error.__traceback__)[-1]
    cause = " ".join(repr(error).split())
    return f"unexpected {cause} ({Path(place.filename).name}:{place.lineno}); please report it"
