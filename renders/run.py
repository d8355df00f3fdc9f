"""Many assets to staged samples: processes side by side, resumable."""

import json
import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from artgen.core.errors import ArtgenError, ShardError, UsageError
from artgen.core.jsonio import plain, write_json
from artgen.dataset import open_shard
from artgen.export import read_bundle
from artgen.export.layout import MANIFEST
from artgen.export.manifest import versions
from artgen.pool import run_in_processes
from artgen.run_folder import RunFolder
from renders.asset import render_asset
from renders.backends import BACKENDS, Backend
from renders.settings import Settings

ASSET_TIMEOUT_S = 3600.0
"""Beyond every limit of the Blender worker itself; a process that hangs for this long is killed."""


@dataclass(frozen=True, kw_only=True)
class RenderTask:
    """One asset to render; the sample depends on the bundle, `settings` and `seed` alone."""

    bundle: Path
    sample: Path
    settings: Settings
    seed: int

    @property
    def asset_id(self) -> str:
        """Category and index, as the folders are named."""
        return f"{self.bundle.parent.name}_{self.bundle.name}"


@dataclass(frozen=True, kw_only=True)
class Rendered:
    """What became of a task; an empty message means that its sample is staged."""

    asset_id: str
    message: str = ""
    seconds: Mapping[str, float] = field(default_factory=dict)


def planned_tasks(folder: RunFolder, settings: Settings, seed: int) -> list[RenderTask]:
    """One task for every bundle under assets/, sorted.

    Raises:
        UsageError: there is no bundle, or samples/ was rendered with other settings.
    """
    bundles = sorted(path.parent for path in folder.assets.glob(f"*/*/{MANIFEST}"))
    if not bundles:
        raise UsageError(
            f"{folder.assets}: holds no bundle; make some with "
            f"`artgen generate --out {folder.root}`"
        )
    samples = folder.root / "samples"
    _remember(samples / "settings.json", settings, seed)
    return [
        RenderTask(
            bundle=bundle,
            sample=samples / bundle.parent.name / f"{bundle.name}.tar",
            settings=settings,
            seed=seed,
        )
        for bundle in bundles
    ]


def is_staged(task: RenderTask) -> bool:
    """True when the sample is there and whole."""
    try:
        open_shard(task.sample)
    except (ShardError, OSError):
        return False
    return True


def run_tasks(
    folder: RunFolder, tasks: Sequence[RenderTask], *, workers: int
) -> Iterator[Rendered]:
    """Outcomes as they come; cores beyond the number of processes become render threads."""
    shutil.rmtree(scratch(folder), ignore_errors=True)  # of a run that was killed
    processes = max(1, min(workers, len(tasks)))
    return run_in_processes(
        tasks,
        _task_in_worker,
        workers=processes,
        initializer=_open_worker,
        initargs=(folder, tasks[0].settings.backend, max(1, workers // processes)),
        timeout_s=ASSET_TIMEOUT_S,
        lost=lambda task, cause: Rendered(asset_id=task.asset_id, message=cause),
    )


def scratch(folder: RunFolder) -> Path:
    """Where images lie until they are packed into a sample."""
    return folder.work / "render"


def _remember(path: Path, settings: Settings, seed: int) -> None:
    """Write down how samples are rendered, or check that it has not changed."""
    asked = plain({"settings": settings, "seed": seed, "versions": versions()})
    if not path.exists():
        write_json(path, asked)
        return
    found = json.loads(path.read_text(encoding="utf-8"))
    if found != asked:
        changed = [key for key in asked if found.get(key) != asked[key]]
        raise UsageError(
            f"{path.parent}: was rendered with other {' and '.join(changed)} (see {path.name}); "
            "delete that folder to render anew, or ask for the same"
        )


_worker: tuple[Backend, Path] | None = None
"""Of this process, with its scratch folder; set once by the pool's initializer."""


def _open_worker(folder: RunFolder, backend: str, threads: int) -> None:
    global _worker
    log_file = folder.logs / f"blender-render-{os.getpid()}.log"
    _worker = BACKENDS[backend](log_file, threads), scratch(folder)


def _task_in_worker(task: RenderTask) -> Rendered:
    """Faults of one asset become its outcome; the process goes on."""
    if _worker is None:
        raise RuntimeError("the pool did not open its worker")
    backend, images = _worker
    try:
        seconds = render_asset(
            read_bundle(task.bundle),
            task.sample,
            settings=task.settings,
            seed=task.seed,
            scratch=images,
            backend=backend,
        )
    except ArtgenError as error:
        return Rendered(asset_id=task.asset_id, message=str(error))
    return Rendered(asset_id=task.asset_id, seconds=seconds)
