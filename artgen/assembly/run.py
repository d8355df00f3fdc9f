"""Assembled objects as validated bundles: processes side by side, resumable, no object twice."""

import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen import __version__
from artgen.assembly.assemble import Assembled, GivenUp, assembled, finished
from artgen.assembly.choice import Market
from artgen.assembly.library import MOST_PARTS, Library
from artgen.core.errors import ArtgenError, UsageError
from artgen.core.jsonio import read_object, write_json
from artgen.core.stream import Stream
from artgen.pipeline import ANEW, Outcome, Stopwatch, Toolbox, landed
from artgen.pool import run_in_processes
from artgen.run_folder import RunFolder

TEMPLATES: Mapping[str, tuple[str, ...]] = {"storage_furniture": ("storage_furniture", "cabinet")}
"""What can be assembled, and the categories of its templates."""
HOME = "assembled"
"""Folder of assets/ and failed/ that receives them."""
TIMEOUT_S = 300.0


@dataclass(frozen=True, kw_only=True)
class AssembleTask:
    """One object; its content depends on (library, what, seed, index) alone."""

    what: str
    index: int
    seed: int
    library: Path

    @property
    def asset_id(self) -> str:
        """Unique within a run."""
        return f"{HOME}_{self.index:06d}"

    def place(self, root: Path) -> Path:
        """`<root>/assembled/<index>`."""
        return root / HOME / f"{self.index:06d}"


def new_object(market: Market, what: str, seed: int, index: int) -> Assembled | GivenUp:
    """Object `index` of a run, or why there is none; a pure function of library, what, seed and
    index. Templates are dealt out evenly: each once, shuffled, before any comes again."""
    turn, place = divmod(index, len(market.template_ids))
    order = Stream(seed, what, "templates", turn).generator().permutation(len(market.template_ids))
    template = market.template_ids[int(order[place])]
    return assembled(market, template, Stream(seed, what, "object", index))


def opened_market(library: Path, what: str) -> Market:
    """What a library offers for some kind of object.

    Raises:
        UsageError: it cannot be read, or nothing can be assembled from it.
    """
    market = Market(Library(library), TEMPLATES[what])
    if not market.template_ids:
        held = len({entry.source for entry in market.library.entries})
        among = len(market.library.templates(TEMPLATES[what]))
        raise UsageError(
            f"{library}: nothing can be made from its {held} sources: {among} of them can be a "
            f"template ({' or '.join(TEMPLATES[what])}, at most {MOST_PARTS} parts, with a front "
            "that opens), and none finds donors of its split for more than half of its fronts; "
            "take in more bundles, or build it without --no-embedded"
        )
    return market


class Bench:
    """What a process keeps between objects."""

    def __init__(self, folder: RunFolder, library: Path, what: str) -> None:
        self.tools = Toolbox(folder, f"assemble-{os.getpid()}")
        self.market = opened_market(library, what)


def make_object(task: AssembleTask, bench: Bench) -> Outcome:
    """Assemble, export and validate one object; it lands whole in assets/ or in failed/."""
    watch, folder = Stopwatch(), bench.tools.folder
    new = new_object(bench.market, task.what, task.seed, task.index)
    watch.lap("assemble")
    if isinstance(new, GivenUp):
        return _set_aside(task, folder, f"{new.template}: {new.reason}", new.tried)
    provenance = {
        "seed": task.seed,
        "index": task.index,
        "assembled": task.what,
        "library": bench.market.library.digest,
        "tried": new.tried,
    }
    obj = finished(new, asset_id=task.asset_id, provenance=provenance)
    watch.lap("finish")
    return landed(obj, bench.tools, watch, place=task.place)


def _set_aside(
    task: AssembleTask, folder: RunFolder, reason: str, tried: Sequence[str] = ()
) -> Outcome:
    """The outcome of an object that could not be made, its reason kept in failed/."""
    aside = task.place(folder.failed)
    aside.mkdir(parents=True, exist_ok=True)
    fault = {"asset_id": task.asset_id, "error": reason, "tried": tried}
    write_json(aside / "error.json", fault)
    return Outcome(asset_id=task.asset_id, status="failed", message=reason)


def check_kept(folder: RunFolder, tasks: Sequence[AssembleTask], digest: str) -> set[str]:
    """Ids of tasks whose bundle is already here.

    Raises:
        UsageError: one was made from another seed, library or version; nothing is overwritten.
        ExportError: a manifest is damaged.
    """
    kept = set()
    for task in tasks:
        manifest = task.place(folder.assets) / "manifest.json"
        if not manifest.exists():
            continue
        found = read_object(manifest, remedy=ANEW)
        expected = {"seed": task.seed, "library": digest, "artgen": __version__}
        actual = {key: found.get(key) for key in ("seed", "library")}
        actual["artgen"] = found.get("versions", {}).get("artgen")
        if differing := [key for key in expected if expected[key] != actual[key]]:
            raise UsageError(
                f"{manifest.parent}: was made from another {' and '.join(differing)}; "
                "choose a new --out (nothing is overwritten)"
            )
        kept.add(task.asset_id)
    return kept


def set_twins_aside(folder: RunFolder, tasks: Sequence[AssembleTask]) -> list[Outcome]:
    """Of objects with equal tree, shapes and looks the first stays; the others go to failed/."""
    first: dict[str, str] = {}
    outcomes = []
    for task in sorted(tasks, key=lambda task: task.index):
        home = task.place(folder.assets)
        if not (home / "manifest.json").exists():
            continue
        manifest = read_object(home / "manifest.json", remedy=ANEW)
        digest = manifest.get("hashes", {}).get("object", task.asset_id)
        twin = first.setdefault(digest, task.asset_id)
        if twin != task.asset_id:
            shutil.rmtree(home)
            outcomes.append(_set_aside(task, folder, f"is the same object as {twin}"))
    return outcomes


_bench: Bench | None = None
"""Of this worker process; set once by the pool's initializer, as pools offer no other way."""


def _open_bench(folder: RunFolder, library: Path, what: str) -> None:
    global _bench
    _bench = Bench(folder, library, what)


def _task_in_worker(task: AssembleTask) -> Outcome:
    """make_object with faults of one object turned into its outcome; the bench outlives it."""
    if _bench is None:
        raise RuntimeError("the pool did not open its bench")
    try:
        return make_object(task, _bench)
    except ArtgenError as error:
        return _set_aside(task, _bench.tools.folder, str(error))


def run_tasks(
    folder: RunFolder, tasks: Sequence[AssembleTask], *, workers: int
) -> Iterator[Outcome]:
    """Outcomes as they come; a process that dies fails its object alone, after a second try, and so
    does an unforeseen fault."""
    return run_in_processes(
        tasks,
        _task_in_worker,
        workers=workers,
        initializer=_open_bench,
        initargs=(folder, tasks[0].library, tasks[0].what),
        timeout_s=TIMEOUT_S,
        lost=lambda task, cause: _set_aside(task, folder, cause),
    )
