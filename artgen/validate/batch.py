"""Many assets: judged in processes with a time limit each, and kept so that a run can resume."""

import hashlib
import json
import logging
import resource
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import mujoco

from artgen.core.errors import ArtgenError
from artgen.core.jsonio import content_hash, write_json
from artgen.pool import run_in_processes
from artgen.validate.battery import LEVELS
from artgen.validate.bounds import Bounds
from artgen.validate.levels import Selection, run_levels
from artgen.validate.pictures import Picture, pictures_of
from artgen.validate.read import read_subject
from artgen.validate.report import Finding, Report, report_from_json
from artgen.validate.subject import Source, Subject

log = logging.getLogger(__name__)

MEMORY = 8 * 2**30
"""Bytes of addresses that a process may ask for; a file that states huge counts fails in its own
process."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """One asset to judge.

    Attributes:
        kept: the folder of results by key, or None to keep none.
        drawn: whether pictures of the worst poses are wanted.
    """

    source: Source
    selection: Selection
    bounds: Bounds
    kept: Path | None
    drawn: bool

    @property
    def asset_id(self) -> str:
        """The file, for messages."""
        return str(self.source.file)


@dataclass(frozen=True, kw_only=True, eq=False)
class Judgement:
    """What became of a task: its report, and whether it was kept from an earlier run."""

    source: Source
    report: Report
    again: bool = False
    pictures: tuple[Picture, ...] = ()


def judge_all(tasks: Sequence[Task], *, workers: int, limit_s: float) -> Iterator[Judgement]:
    """The judgement of every task, as they come; an asset that takes longer than `limit_s`, or
    kills its process, gets a report that says so."""
    yield from run_in_processes(
        tasks,
        judge,
        workers=workers,
        initializer=prepared,
        initargs=(),
        timeout_s=limit_s,
        lost=_lost,
    )


def prepared() -> None:
    """Cap the memory of this process."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def judge(task: Task) -> Judgement:
    """Judge one asset, or read what an earlier run kept of it."""
    subject = read_subject(task.source, task.bounds)
    place = None if task.kept is None else task.kept / f"{key_of(subject, task)}.json"
    if place is not None and not task.drawn and (kept := _kept(place)) is not None:
        return Judgement(source=task.source, report=kept, again=True)
    try:
        report = run_levels(subject, LEVELS, task.selection)
    except Exception as error:  # One asset that no check foresaw must not end the run.
        log.exception("%s: a check failed", task.asset_id)
        return _lost(task, f"a check failed: {error!r}")
    if place is not None:
        write_json(place, report.as_json())
    drawn = tuple(pictures_of(subject, report)) if task.drawn else ()
    return Judgement(source=task.source, report=report, pictures=drawn)


def key_of(subject: Subject, task: Task) -> str:
    """A hash of the asset's bytes, the bounds, the selection and the versions that judged it."""
    digest = hashlib.sha256()
    for path in sorted(subject.files()):
        try:
            with path.open("rb") as stream:
                digest.update(f"{path.name}\0".encode())
                digest.update(hashlib.file_digest(stream, "sha256").digest())
        except OSError:
            continue  # What cannot be read is reported by the first level.
    judges = {"artgen": version("artgen"), "mujoco": mujoco.__version__}
    terms = [digest.hexdigest(), task.source.format, task.bounds.digest, task.selection, judges]
    return content_hash(terms)


def _kept(place: Path) -> Report | None:
    """The report at a place, or None where there is none of this schema."""
    try:
        return report_from_json(json.loads(place.read_text(encoding="utf-8")))
    except (OSError, ValueError, KeyError, TypeError, ArtgenError):
        return None


def _lost(task: Task, cause: str) -> Judgement:
    finding = Finding(
        check="files.survives",
        part=task.source.file.name,
        value=cause,
        bound="a verdict in time",
        cause="the asset hangs or breaks the programs that read it",
        remedy="look at its largest mesh or count, and mend or drop it",
    )
    report = Report(
        asset=task.source.file.stem, findings=(finding,), format=task.source.format, judged=()
    )
    return Judgement(source=task.source, report=report)
