"""Objects scored side by side in processes; each leaves a record, so that a run resumes."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path

import numpy as np
from PIL import Image

from artgen.core.errors import ArtgenError, ModelError
from artgen.core.jsonio import content_hash, file_hash, write_bytes
from artgen.core.mesh import Floats
from artgen.export.layout import MANIFEST
from artgen.pool import run_in_processes
from artgen.validate.meshfile import MESH_READERS
from artgen.validate.subject import Source
from model.evaluation.adapters.formats import FORMATS, Place
from model.evaluation.gates import gates
from model.evaluation.images import ImageScores, Perceptual, image_scores, over_white
from model.evaluation.layout import Layout
from model.evaluation.pictures import strip
from model.evaluation.records import SCHEMA, keep_record, kept_record, picture_path
from model.evaluation.score import Protocol, Record, failed, score, unread
from model.evaluation.surfaces import has_surface

TASK_TIMEOUT_S = 900.0
SIMULATED = {"bundle": "bundle", "urdf": "urdf", "urdformer": "urdf"}
"""Format of a prediction to the format that the gates read; others state no simulation."""
IMAGES = "images"
"""Folder beside an object's files with PNGs; predicted and true ones of one name are compared."""
UNREADABLE = (ArtgenError, OSError, ValueError, SyntaxError, Image.DecompressionBombError)
"""What a file that is no image, or an image of another size, raises."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """One object to score.

    Attributes:
        predicted: None where there is no prediction.
        gated: whether predictions are driven in MuJoCo; their format is one of `SIMULATED`.
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
    """Every file of an object with its hash; a folder's own files, or those beside a file, and
    meshes where a format has them elsewhere."""
    if place is None:
        return []
    root = place.path if place.path.is_dir() else place.path.parent
    files = [path for path in root.rglob("*") if path.is_file()]
    if place.format == "urdformer":
        around = root.parent.rglob("*")
        files += [path for path in around if path.suffix.lower() in MESH_READERS]
    named = {path.relative_to(root.parent).as_posix(): path for path in files}
    return [[place.format, name, _digest(path)] for name, path in sorted(named.items())]


def _digest(path: Path) -> str:
    """Its hash; of a file that may not be read, which its reader tells, that."""
    try:
        return file_hash(path)
    except OSError as error:
        return str(error)


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
    record = _record(task)
    keep_record(task.folder, record, task.key)
    return record


def _record(task: Task) -> Record:
    try:
        true = _truth(task)
    except ArtgenError as error:
        return unread(task.name, str(error))
    if task.predicted is None:
        return failed(true, "no prediction of that name", idle=_idle(task, true))
    try:
        predicted = task.predicted.read()
        return _scored(task, task.predicted, predicted, true)
    except ArtgenError as error:
        why = str(error)
    except (ArithmeticError, ValueError, LookupError, MemoryError) as error:
        why = f"{task.predicted.path} is read and cannot be scored: {error!r}"
    return failed(true, why, idle=_idle(task, true))


def _truth(task: Task) -> Layout:
    """The true object, which needs an extent to measure by."""
    true = replace(task.true.read(), name=task.name)
    if not true.radius > 0.0:
        raise ModelError(f"{task.true.path}: all boxes are one point; a true object has a size")
    return true


def _scored(task: Task, place: Place, predicted: Layout, true: Layout) -> Record:
    held = gates(_source(place)) if task.gated else None
    images, wrong = image_pairs(place, task.true, perceptual_of(task.lpips))
    record = score(predicted, true, task.protocol, gates=held, images={IMAGES: images})
    write_bytes(picture_path(task.folder, task.name), strip(predicted, true))
    return replace(record, reasons={**record.reasons, **wrong})


def _idle(task: Task, true: Layout) -> tuple[str, ...]:
    """Beginnings of the metrics that this run asks of no prediction."""
    asked = {
        "masks.": task.protocol.mask_pixels > 0,
        "gates.": task.gated,
        "images.": any(_images(task.true).glob("*.png")),
        "images.new_state.": False,
        "surfaces.": has_surface(true),
    }
    return tuple(beginning for beginning, held in asked.items() if not held)


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
) -> tuple[list[ImageScores], dict[str, str]]:
    """Scores of the images that both objects have under one name, and what is wrong with some.

    A predicted image that cannot be compared shares no pixel with the true one; a true one that
    cannot be read is left out.
    """
    found, wrong = [], {}
    for path in sorted(_images(true).glob("*.png")):
        other = _images(predicted) / path.name
        if not other.is_file():
            continue
        try:
            theirs, true_mask = over_white(_pixels(path))
        except UNREADABLE as error:
            wrong[f"true {IMAGES}/{path.name}"] = f"cannot be read: {error}"
            continue
        try:
            mine, mask = over_white(_pixels(other))
            found.append(image_scores(mine, theirs, mask, true_mask, perceptual=perceptual))
        except UNREADABLE as error:
            wrong[f"{IMAGES}/{path.name}"] = str(error)
            found.append(ImageScores(mask_iou=None if true_mask is None else 0.0))
    return found, wrong


def _images(place: Place) -> Path:
    return (place.path if place.path.is_dir() else place.path.parent) / IMAGES


def _pixels(path: Path) -> Floats:
    """(H, W, 4) in [0, 1], or (H, W, 3) of an image without alpha."""
    with Image.open(path) as image:
        mode = "RGBA" if image.has_transparency_data else "RGB"
        return np.asarray(image.convert(mode), float) / 255.0


def _lost(task: Task, why: str) -> Record:
    """The record of an object whose process died."""
    try:
        true = _truth(task)
    except ArtgenError as error:
        return unread(task.name, str(error))
    return failed(true, why, idle=_idle(task, true))
