"""Libraries made from seeds and bundles, in many processes; what an interrupted run finished is
kept."""

import dataclasses
import shutil
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from artgen import __version__
from artgen.core.errors import ArtgenError, ModelError
from artgen.core.jsonio import content_hash, file_hash
from artgen.export.layout import MANIFEST
from artgen.pool import run_in_processes
from artgen.progress import Show
from artgen.rules import load_rule
from model.data.bundle_soup import bundle_soup
from model.data.library import Library, joined, packed, read_library, write_library
from model.data.soup import Soup, seed_soup

CHUNK = 20
"""Objects a task: one to four seconds of work."""
TASK_TIMEOUT_S = 600.0


@dataclass(frozen=True, kw_only=True)
class Request:
    """Which library: indices 0 up to a count of each category, at one seed, and bundles.

    Attributes:
        counts: category to number of objects.
        bundles: folders of bundles.
        tolerance: radii by which triangles may leave the exact shape.
    """

    counts: Mapping[str, int]
    seed: int
    tolerance: float
    bundles: tuple[Path, ...] = ()

    @property
    def made(self) -> dict[str, object]:
        """As the library states it."""
        return {
            "counts": dict(self.counts),
            "seed": self.seed,
            "tolerance": self.tolerance,
            "rules": {name: load_rule(name).digest for name in self.counts},
            "artgen": __version__,
            **({"bundles": self._hashes()} if self.bundles else {}),
        }

    def _hashes(self) -> list[str]:
        return [file_hash(folder / MANIFEST) for folder in self.bundles]


@dataclass(frozen=True, kw_only=True)
class SoupTask:
    """Objects `start` up to `stop` of a category, or bundles, into a file."""

    category: str
    seed: int
    start: int
    stop: int
    tolerance: float
    path: Path
    bundles: tuple[Path, ...] = ()

    @property
    def asset_id(self) -> str:
        """Names the task in messages."""
        return f"{self.category}_{self.start:06d}"

    def soups(self) -> Iterator[tuple[str, Callable[[], Soup]]]:
        """Names of the objects, and what builds each."""
        for folder in self.bundles:
            yield folder.as_posix(), partial(bundle_soup, folder, tolerance=self.tolerance)
        for index in range(self.start, self.stop if not self.bundles else self.start):
            name = f"{self.category}_{index:06d}"
            build = partial(seed_soup, self.category, self.seed, index, tolerance=self.tolerance)
            yield name, build


def dealt(categories: Sequence[str], count: int) -> dict[str, int]:
    """`count` objects dealt out to the categories in turn."""
    share, rest = divmod(count, len(categories))
    return {name: share + (k < rest) for k, name in enumerate(categories)}


def make_library(path: Path, request: Request, *, workers: int, show: Show) -> Mapping[str, str]:
    """Write the library, unless it is there already; asset id to reason for each that failed.

    Finished chunks lie in `PATH.chunks/` until all are done, so the same command resumes.

    Raises:
        ModelError: another library, or another file, is in the place.
    """
    made = request.made
    if path.exists():
        if dict(read_library(path).made) == made:
            return {}
        raise ModelError(
            f"{path}: holds another library (other counts, seed, tolerance, rules or release); "
            "name another --out, or remove it"
        )
    folder = path.with_name(f"{path.name}.chunks") / content_hash(made)[:12]
    tasks = _tasks(request, folder)
    missing = [task for task in tasks if not task.path.exists()]
    with show("chunks", max(len(missing), 1)) as advance:
        for name in _chunks(missing, workers):
            advance(name)
    libraries = [read_library(task.path) for task in tasks]
    whole = joined(libraries, made=made)
    _check_names(path, whole)
    write_library(path, whole)
    shutil.rmtree(folder.parent)
    return {name: str(why) for library in libraries for name, why in library.made.items()}


def _tasks(request: Request, folder: Path) -> list[SoupTask]:
    tasks = [
        SoupTask(
            category=category,
            seed=request.seed,
            start=start,
            stop=min(start + CHUNK, count),
            tolerance=request.tolerance,
            path=folder / f"{category}_{start:06d}.npz",
        )
        for category, count in request.counts.items()
        for start in range(0, count, CHUNK)
    ]
    first = SoupTask(
        category="bundles", seed=0, start=0, stop=0, tolerance=request.tolerance, path=folder
    )
    return tasks + [
        dataclasses.replace(
            first,
            start=start,
            path=folder / f"bundles_{start:06d}.npz",
            bundles=request.bundles[start : start + CHUNK],
        )
        for start in range(0, len(request.bundles), CHUNK)
    ]


def _check_names(path: Path, library: Library) -> None:
    repeated = [name for name, count in Counter(library.ids).items() if count > 1]
    if repeated:
        raise ModelError(
            f"{path}: {len(repeated)} objects have the id of another, such as {repeated[0]}; name "
            "bundles of other ids, or leave that category out"
        )


def _chunks(tasks: Sequence[SoupTask], workers: int) -> Iterator[str]:
    """Names of the tasks as they are done."""
    if not tasks:
        return iter(())
    return run_in_processes(
        tasks,
        make_chunk,
        workers=workers,
        initializer=_ready,
        initargs=(),
        timeout_s=TASK_TIMEOUT_S,
        lost=_lost,
    )


def make_chunk(task: SoupTask) -> str:
    """Build the objects of a task and write them; `made` of the file says which failed, and why.

    Raises:
        ModelError: all failed.
    """
    soups, failed = [], {}
    for name, build in task.soups():
        try:
            soups.append(build())
        except ArtgenError as error:
            failed[name] = str(error)
    if not soups:
        raise ModelError(f"none of {len(failed)} objects could be built: {failed}")
    write_library(task.path, dataclasses.replace(packed(soups), made=failed))
    return task.asset_id


def _ready() -> None:
    """Nothing to prepare in a process."""


def _lost(task: SoupTask, cause: str) -> str:
    raise ModelError(f"{task.asset_id}: {cause}; the same command goes on with what is missing")
