"""From rule to validated bundle: one asset at a time, many processes side by side, resumable."""

import dataclasses
import os
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from artgen import __version__
from artgen.articulation.types import ArticulatedObject
from artgen.core.errors import ArtgenError, UsageError
from artgen.core.jsonio import fill_folder_atomically, plain, read_object, write_json
from artgen.core.mesh import Floats, Ints
from artgen.core.stream import Stream
from artgen.export import write_bundle
from artgen.finish import RawBody, finish
from artgen.finish_jobs import RoundJob, read_bodies, write_bodies
from artgen.generators import load_builder
from artgen.pool import run_in_processes
from artgen.progress import progress
from artgen.rules import CategoryRule, Override, load_rule, overridden, sample
from artgen.run_folder import RunFolder, run_log, settled
from artgen.textures.library import TextureLibrary
from artgen.validate import validate_bundle
from artgen.worker import BlenderWorker

BYTES_PER_ASSET = 5_000_000
"""A bundle stays under 3 MB; its sample and its share of the shards add about 1 MB."""
ANEW = "remove its folder and run the same command again to have it made anew"
"""What to do about a kept bundle that is damaged."""
ROUND_TIMEOUT_S = 60.0
ASSET_TIMEOUT_S = 600.0
"""An asset takes 3 to 5 s; a process that hangs for this long is killed and its asset set aside."""


@dataclass(frozen=True, kw_only=True)
class AssetTask:
    """One asset of a run; its content depends on (seed, category, index) and the rule alone."""

    category: str
    index: int
    seed: int
    occlusion: bool = False
    overrides: tuple[Override, ...] = ()

    @property
    def rule(self) -> CategoryRule:
        """What is drawn from, overrides included."""
        return overridden(load_rule(self.category), self.overrides)

    @property
    def asset_id(self) -> str:
        """Unique within a run: category and six-digit index."""
        return f"{self.category}_{self.index:06d}"

    def place(self, root: Path) -> Path:
        """`<root>/<category>/<index>`."""
        return root / self.category / f"{self.index:06d}"


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What became of a task: made now, kept from an earlier run, or failed with a message."""

    asset_id: str
    status: Literal["made", "kept", "failed"]
    message: str = ""
    seconds: Mapping[str, float] = dataclasses.field(default_factory=dict)


def plan(
    categories: Sequence[str],
    count: int,
    seed: int,
    *,
    occlusion: bool = False,
    overrides: Sequence[Override] = (),
) -> list[AssetTask]:
    """`count` tasks dealt out to the categories in turn; a larger count only adds tasks.

    Raises:
        RuleError: a category is unknown, or an override breaks its rule. UsageError: the count is
            not positive, or an override is for a category that is not made.
    """
    if count < 1:
        raise UsageError(f"--count {count} makes nothing; ask for at least 1")
    categories = tuple(dict.fromkeys(categories))  # Named twice, it is one category.
    for category in categories:
        overridden(load_rule(category), overrides)
    for override in overrides:
        if override.category not in categories:
            raise UsageError(
                f"--set {override}: {override.category!r} is not among the categories made: "
                f"{', '.join(categories)}"
            )
    return [
        AssetTask(
            category=categories[k % len(categories)],
            index=k // len(categories),
            seed=seed,
            occlusion=occlusion,
            overrides=tuple(overrides),
        )
        for k in range(count)
    ]


def check_kept(folder: RunFolder, tasks: Sequence[AssetTask]) -> set[str]:
    """Ids of tasks whose bundle is already here.

    Raises:
        UsageError: one was made from another seed, rule or version; nothing is overwritten.
        ExportError: a manifest is damaged.
    """
    kept = set()
    digests = {task.category: task.rule.digest for task in {t.category: t for t in tasks}.values()}
    for task in tasks:
        manifest = task.place(folder.assets) / "manifest.json"
        if not manifest.exists():
            continue
        found = read_object(manifest, remedy=ANEW)
        expected = {
            "seed": task.seed,
            "rule": digests[task.category],
            "artgen": __version__,
            "occlusion": task.occlusion,
        }
        actual = {
            "seed": found.get("seed"),
            "rule": found.get("rule", {}).get("digest"),
            "artgen": found.get("versions", {}).get("artgen"),
            "occlusion": found.get("occlusion"),
        }
        if differing := [key for key in expected if expected[key] != actual[key]]:
            raise UsageError(
                f"{manifest.parent}: was made from another {' and '.join(differing)}; "
                "choose a new --out (nothing is overwritten)"
            )
        kept.add(task.asset_id)
    return kept


class Toolbox:
    """What a process keeps between assets: a Blender worker and the texture cache."""

    def __init__(self, folder: RunFolder, name: str) -> None:
        self.folder = folder
        self.blender = BlenderWorker(folder.logs / f"blender-{name}.log")
        self.textures = TextureLibrary(folder.work / "textures")
        folder.work.mkdir(parents=True, exist_ok=True)


class Stopwatch:
    """Seconds by stage."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._last = time.perf_counter()

    def lap(self, stage: str) -> None:
        """Book the time since the last lap on `stage`."""
        now = time.perf_counter()
        self.seconds[stage] = now - self._last
        self._last = now


def make_asset(task: AssetTask, tools: Toolbox) -> Outcome:
    """Build, finish, export and validate one asset; it lands whole in assets/ or in failed/."""
    watch = Stopwatch()
    obj = built(task, task.rule, tools, watch)
    return landed(obj, tools, watch, place=task.place, occlusion=task.occlusion)


def landed(
    obj: ArticulatedObject,
    tools: Toolbox,
    watch: Stopwatch,
    *,
    place: Callable[[Path], Path],
    occlusion: bool = False,
) -> Outcome:
    """Export and validate a finished object; it lands whole in assets/ or in failed/.

    Args:
        place: the object's folder below a folder of the run.
    """
    staged = place(tools.folder.work / "staged")
    messages: list[str] = []

    def fill(partial: Path) -> None:
        write_bundle(
            obj, partial, library=tools.textures, worker=tools.blender, occlusion=occlusion
        )
        watch.lap("export")
        report = validate_bundle(partial)
        write_json(partial / "report.json", report.as_json())
        messages.extend(str(finding) for finding in report.findings)
        watch.lap("validate")

    fill_folder_atomically(staged, fill)
    home, other = place(tools.folder.assets), place(tools.folder.failed)
    if messages:
        home, other = other, home
    settled(staged, home=home, other=other)
    return Outcome(
        asset_id=obj.asset_id,
        status="failed" if messages else "made",
        message="; ".join(messages[:3]),
        seconds=watch.seconds,
    )


def built(
    task: AssetTask, rule: CategoryRule, tools: Toolbox, watch: Stopwatch
) -> ArticulatedObject:
    """The finished object of a task."""
    builder = load_builder(task.category)
    drawn = sample(
        rule,
        Stream(task.seed, task.category, task.index),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )
    draft = builder.build(drawn.params, drawn.surfaces)
    watch.lap("build")
    obj = finish(
        draft,
        asset_id=task.asset_id,
        rounder=lambda bodies: rounded(bodies, tools),
        provenance={
            "seed": task.seed,
            "index": task.index,
            "occlusion": task.occlusion,
            "rule": {"version": rule.version, "digest": rule.digest},
            "params": plain(drawn.params),
            **({"set": [str(o) for o in task.overrides]} if task.overrides else {}),
        },
    )
    watch.lap("finish")
    return obj


def rounded(bodies: Sequence[RawBody], tools: Toolbox) -> list[tuple[Floats, Ints]]:
    """Bodies with their edges rounded by Blender."""
    if not bodies:
        return []
    with tempfile.TemporaryDirectory(dir=tools.folder.work) as scratch:
        job = RoundJob(input=f"{scratch}/sharp.npz", output=f"{scratch}/round.npz")
        write_bodies(
            Path(job.input),
            [(body.vertices, body.faces) for body in bodies],
            radius=[body.radius for body in bodies],
        )
        tools.blender.run(plain(job), timeout_s=ROUND_TIMEOUT_S)
        return [(v, np.asarray(f, np.int32)) for v, f in read_bodies(Path(job.output))[0]]


_tools: Toolbox | None = None
"""Of this worker process; set once by the pool's initializer, as pools offer no other way."""


def _open_toolbox(folder: RunFolder) -> None:
    global _tools
    _tools = Toolbox(folder, str(os.getpid()))


def _task_in_worker(task: AssetTask) -> Outcome:
    """make_asset with faults of one asset turned into its outcome; the tools outlive it."""
    if _tools is None:
        raise RuntimeError("the pool did not open its toolbox")
    try:
        return make_asset(task, _tools)
    except ArtgenError as error:
        aside = task.place(_tools.folder.failed)
        aside.mkdir(parents=True, exist_ok=True)
        write_json(aside / "error.json", {"asset_id": task.asset_id, "error": str(error)})
        return Outcome(asset_id=task.asset_id, status="failed", message=str(error))


def run_tasks(folder: RunFolder, tasks: Sequence[AssetTask], *, workers: int) -> Iterator[Outcome]:
    """Outcomes as they come; a process that dies fails its asset alone, after a second try."""
    return run_in_processes(
        tasks,
        _task_in_worker,
        workers=workers,
        initializer=_open_toolbox,
        initargs=(folder,),
        timeout_s=ASSET_TIMEOUT_S,
        lost=lambda task, cause: Outcome(asset_id=task.asset_id, status="failed", message=cause),
    )


def build_assets(folder: RunFolder, tasks: Sequence[AssetTask], *, workers: int) -> list[Outcome]:
    """Make what is missing; one line per asset and stage goes to logs/run.log."""
    kept = check_kept(folder, tasks)
    outcomes = [
        Outcome(asset_id=task.asset_id, status="kept") for task in tasks if task.asset_id in kept
    ]
    missing = [task for task in tasks if task.asset_id not in kept]
    if not missing:
        return outcomes
    record = run_log(folder)
    with progress("assets", len(missing)) as advance:
        for outcome in run_tasks(folder, missing, workers=min(workers, len(missing))):
            for stage, seconds in outcome.seconds.items():
                record.info("%s %s %.2f s", outcome.asset_id, stage, seconds)
            record.info("%s %s %s", outcome.asset_id, outcome.status, outcome.message)
            outcomes.append(outcome)
            advance(f"{outcome.asset_id} {outcome.status}")
    return outcomes
