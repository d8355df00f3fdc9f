"""Objects scored side by side in processes; each leaves a record, so that a run resumes."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path

import numpy as np
from PIL import Image

from artgen.core.errors import ArtgenError
from artgen.core.jsonio import content_hash, file_hash, write_bytes
from artgen.core.mesh import Floats
from artgen.export.layout import MANIFEST
from artgen.pool import run_in_processes
from artgen.validate.subject import Source
from model.evaluation.adapters.formats import FORMATS, Place
from model.evaluation.gates import gates
from model.evaluation.images import ImageScores, Perceptual, image_scores, over_white
from model.evaluation.layout import Layout
from model.evaluation.pictures import strip
from model.evaluation.records import SCHEMA, keep_record, kept_record, picture_path
from model.evaluation.score import Protocol, Record, failed, score

TASK_TIMEOUT_S = 900.0
SIMULATED = {"bundle": "bundle", "urdf": "urdf", "urdformer": "urdf"}
"""Format of a prediction to the format that the gates read; others state no simulation."""
IMAGES = "images"
"""Folder beside an object's files with PNGs; predicted and true ones of one name are compared."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """One object to score.

    Attributes:
        predicted: None where there is no prediction.
        folder: receives the record and the picture.
        lpips: folder of LPIPS's weights; None leaves it null.
    """

    name: str
    predicted: Place | None
    true: Place
    protocol: Protocol
    gated: bool
    folder: Path
    lpips: Path | None = None

    @property
    def asset_id(self) -> str:
        """Its name, for messages."""
        return self.name

    @property
    def key(self) -> str:
        """What the record depends on."""
        places = [self.predicted, self.true]
        asked = [self.protocol, self.gated, self.lpips]
        return content_hash([SCHEMA, asked, [_digests(own) for own in places]])


def _digests(place: Place | None) -> list[list[str]]:
    """Every file of an object with its hash; a folder's own files, or those beside a file."""
    if place is None:
        return []
    root = place.path if place.path.is_dir() else place.path.parent
    files = sorted(path for path in root.rglob("*") if path.is_file())
    return [[place.format, path.relative_to(root).as_posix(), file_hash(path)] for path in files]


def scored(tasks: Sequence[Task], *, workers: int) -> Iterator[Record]:
    """A record for every task, kept ones first and the others as they come."""
    waiting = []
    for task in tasks:
        kept = kept_record(task.folder, task.name, task.key)
        if kept is None:
            waiting.append(task)
        else:
            yield kept
    if not waiting:
        return
    yield from run_in_processes(
        waiting,
        work,
        workers=min(workers, len(waiting)),
        initializer=_one_thread,
        initargs=(),
        timeout_s=TASK_TIMEOUT_S,
        lost=_lost,
    )


def _one_thread() -> None:
    """Processes side by side leave each other their cores."""
    os.environ["OMP_NUM_THREADS"] = "1"


def work(task: Task) -> Record:
    """Score one object, and keep its record and picture."""
    true = replace(task.true.read(), name=task.name)
    record = _record(task, true)
    keep_record(task.folder, record, task.key)
    return record


def _record(task: Task, true: Layout) -> Record:
    if task.predicted is None:
        return failed(true, "no prediction of that name")
    try:
        predicted = task.predicted.read()
    except ArtgenError as error:
        return failed(true, str(error))
    held = gates(_source(task.predicted)) if task.gated and _simulated(task.predicted) else None
    images = {"images": list(image_pairs(task.predicted, task.true, perceptual_of(task.lpips)))}
    record = score(predicted, true, task.protocol, gates=held, images=images)
    write_bytes(picture_path(task.folder, task.name), strip(predicted, true))
    return record


def _simulated(place: Place) -> bool:
    return place.format in SIMULATED


def _source(place: Place) -> Source:
    file = place.path / MANIFEST if FORMATS[place.format].whole else place.path
    root = file.parent.parent if place.format == "urdformer" else file.parent
    return Source(format=SIMULATED[place.format], file=file, root=root)


def perceptual_of(folder: Path | None) -> Perceptual | None:
    """LPIPS with the weights in a folder; torch is imported here, as nothing else needs it."""
    if folder is None:
        return None
    perceptual: Perceptual = import_module("model.evaluation.lpips").load_lpips(folder)
    return perceptual


def image_pairs(
    predicted: Place, true: Place, perceptual: Perceptual | None = None
) -> Iterator[ImageScores]:
    """Scores of the images that both objects have under one name."""
    folders = [
        (own.path if own.path.is_dir() else own.path.parent) / IMAGES for own in (predicted, true)
    ]
    for path in sorted(folders[1].glob("*.png")):
        other = folders[0] / path.name
        if other.is_file():
            (mine, mask), (theirs, true_mask) = (over_white(_rgba(p)) for p in (other, path))
            yield image_scores(mine, theirs, mask, true_mask, perceptual=perceptual)


def _rgba(path: Path) -> Floats:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"), float) / 255.0


def _lost(task: Task, why: str) -> Record:
    return Record(name=task.name, category="", parts=0, failure=why)
