"""Bundles to a manifest: what `artgen farm plan` does."""

import logging
import os
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.core.jsonio import replace_atomically
from artgen.core.stream import Stream
from artgen.export import read_bundle
from artgen.pool import run_in_processes
from artgen.progress import progress
from renders.farm.folder import MANIFEST, bring, portable
from renders.plan import plan_render
from renders.run import RenderTask, told

log = logging.getLogger(__name__)

TIMEOUT_S = 900.0
"""Planning takes less than a second; a process that takes this long hangs."""


@dataclass(frozen=True, kw_only=True)
class Planned:
    """What became of a task; an empty message means that `line` is its item."""

    asset_id: str
    message: str = ""
    line: str = ""


def plan_all(root: Path, tasks: Sequence[RenderTask], *, workers: int) -> list[Planned]:
    """Write the manifest, its items in the order of the tasks; what could not be planned."""
    lines, failed = {}, []
    with progress("plans", len(tasks)) as advance:
        for planned in _outcomes(root, tasks, workers):
            if planned.message:
                failed.append(planned)
            lines[planned.asset_id] = planned.line
            advance(f"{planned.asset_id} {'failed' if planned.message else 'planned'}")
    whole = [lines[task.asset_id] for task in tasks if lines[task.asset_id]]
    replace_atomically(root / MANIFEST, lambda partial: _write(partial, whole))
    return failed


def _outcomes(root: Path, tasks: Sequence[RenderTask], workers: int) -> Iterator[Planned]:
    return run_in_processes(
        tasks,
        _plan_in_worker,
        workers=workers,
        initializer=_open_worker,
        initargs=(root,),
        timeout_s=TIMEOUT_S,
        lost=lambda task, cause: Planned(asset_id=task.asset_id, message=cause),
    )


_root: Path | None = None
"""Of this process; set once by the pool's initializer."""


def _open_worker(root: Path) -> None:
    global _root
    _root = root


def _plan_in_worker(task: RenderTask) -> Planned:
    if _root is None:
        raise RuntimeError("the pool did not open its worker")
    try:
        return Planned(asset_id=task.asset_id, line=planned_line(task, _root))
    except Exception as error:  # One asset must not end the planning of thousands.
        return Planned(asset_id=task.asset_id, message=told(error))


def planned_line(task: RenderTask, root: Path) -> str:
    """The manifest's line of an asset; the files it names are in `root` when this returns.

    Raises:
        RenderError: the asset cannot be rendered.
    """
    stream = Stream(task.seed, "render", task.asset_id)
    with tempfile.TemporaryDirectory(dir=root, prefix=".plan-") as folder:
        plan = plan_render(
            read_bundle(task.bundle), stream, settings=task.settings, folder=Path(folder)
        )
        item, files = portable(plan)
        bring(root, files, item.inputs)
    return item.line


def _write(path: Path, lines: Iterable[str]) -> None:
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(f"{line}\n" for line in lines)
        stream.flush()
        os.fsync(stream.fileno())
