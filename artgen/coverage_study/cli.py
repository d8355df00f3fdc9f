"""`artgen study coverage`."""

import inspect
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

import tyro

from artgen.core.errors import ArtgenError, UsageError
from artgen.core.jsonio import content_hash, file_hash, plain, write_bytes, write_json
from artgen.coverage_study.drawn import Drawn, DrawTask, draw_all
from artgen.coverage_study.neighbours import neighbours
from artgen.coverage_study.page import page
from artgen.coverage_study.plots import write_histograms
from artgen.coverage_study.rows import CategoryCoverage, coverage, from_json, parameter_rows
from artgen.generators import load_builder
from artgen.pool import run_in_processes
from artgen.progress import progress
from artgen.rules import load_rule, rule_names
from artgen.studies.table import write_table

CHUNK = 25
"""Seeds a task; two to four seconds of work."""
TASK_TIMEOUT_S = 900.0


@dataclass(frozen=True, kw_only=True)
class Study:
    """Draw many seeds of every category and report what comes out: histograms of every parameter,
    distinct topologies, distances to the nearest neighbor in shape, near-duplicates."""

    categories: tuple[str, ...] = ()
    """Which categories; all when none is named."""
    count: int = 500
    """Seeds of each."""
    seed: int = 11
    """Root of all randomness."""
    out: Path = Path("docs/studies")
    """Receives coverage.md, coverage.csv, coverage_parameters.csv, coverage_neighbours.csv and
    coverage/<category>.png."""
    kept: Path = Path("out/coverage")
    """Keeps what was drawn of each category, so that another run draws only those whose rule or
    builder changed; remove it after changing pieces that builders share."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side."""


def study(argv: Sequence[str]) -> int:
    """What the rules make: histograms, topologies, nearest neighbors, near-duplicates."""
    command = tyro.cli(Study, args=list(argv), prog="artgen study coverage")
    if command.count < 2:
        raise UsageError(f"--count {command.count}: expected at least 2, to have neighbors")
    names = command.categories or tuple(rule_names())
    found = []
    with progress("categories", len(names)) as advance:
        for name in names:
            found.append(category_coverage(name, command))
            advance(name)
    rows = [own.row for own in found]
    nearest = [n for own in found for n in own.nearest]
    write_table(command.out / "coverage.csv", rows)
    write_table(command.out / "coverage_parameters.csv", [p for f in found for p in f.parameters])
    write_table(command.out / "coverage_neighbours.csv", nearest)
    text = page(rows, nearest, seed=command.seed)
    write_bytes(command.out / "coverage.md", text.encode())
    print(f"page: {command.out / 'coverage.md'}")  # noqa: T201
    return 0


def category_coverage(name: str, command: Study) -> CategoryCoverage:
    """What one category makes, with its histograms, drawn now or kept from an earlier run of the
    same rule and builder."""
    rule = load_rule(name)
    builder = file_hash(Path(str(inspect.getsourcefile(load_builder(name).build))))
    key = content_hash([rule.digest, builder, command.seed, command.count])
    place = command.kept / f"{name}-{key[:16]}.json"
    picture, shown = place.with_suffix(".png"), command.out / f"coverage/{name}.png"
    if place.exists() and picture.exists():
        write_bytes(shown, picture.read_bytes())
        return from_json(json.loads(place.read_text(encoding="utf-8")))
    objects = drawn_objects(name, command)
    own = neighbours(objects)
    made = CategoryCoverage(
        row=coverage(rule, objects, own),
        parameters=tuple(parameter_rows(rule, objects)),
        nearest=tuple(own),
    )
    write_histograms(picture, rule, objects, own)
    write_bytes(shown, picture.read_bytes())
    write_json(place, plain(made))
    return made


def drawn_objects(name: str, command: Study) -> list[Drawn]:
    """The seeds of a category, in order.

    Raises:
        ArtgenError: a seed cannot be drawn.
    """
    starts = range(0, command.count, CHUNK)
    tasks = [
        DrawTask(category=name, seed=command.seed, start=k, stop=min(k + CHUNK, command.count))
        for k in starts
    ]
    outcomes = run_in_processes(
        tasks,
        draw_all,
        workers=command.workers,
        initializer=_ready,
        initargs=(),
        timeout_s=TASK_TIMEOUT_S,
        lost=_lost,
    )
    return sorted(chain.from_iterable(outcomes), key=lambda drawn: drawn.index)


def _ready() -> None:
    """Nothing to prepare in a process."""


def _lost(task: DrawTask, cause: str) -> list[Drawn]:
    raise ArtgenError(f"{task.asset_id} and the {CHUNK - 1} after it cannot be drawn: {cause}")
