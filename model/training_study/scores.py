"""The score of a network: metrics of every held-out object, kept as one JSON.

Of what `artgen evaluate` measures, studies ask only for what compares runs, which costs a tenth.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import torch

from artgen.core.errors import ArtgenError
from artgen.core.jsonio import content_hash, file_hash, plain, write_json
from artgen.dataset.split import Split
from artgen.progress import progress
from model.data.fingerprint import fingerprint
from model.evaluation.held_out import HeldOut, held_out
from model.evaluation.metrics import METRICS
from model.evaluation.network_run import NetworkRun, made_predictor, opened
from model.evaluation.predictors import Guess, Predictor
from model.evaluation.reshape import rebased
from model.evaluation.score import Values, in_radii, matched_values, nearest, put

SCHEMA = "artgen-training-score/1"
FILE = "score.json"

ByObject = Mapping[str, float]
"""Object to the mean of the values that it brings."""


@dataclass(frozen=True, kw_only=True)
class Score:
    """What one network, or baseline, is worth on one set of objects; an object without a prediction
    counts with the worst value of every metric whose scale has an end.

    Attributes:
        metrics: name of `model.evaluation.metrics.METRICS` to the objects that have values of it.
        objects: how many were judged.
        failures: object to why there is no prediction.
    """

    metrics: Mapping[str, ByObject]
    objects: int
    failures: Mapping[str, str]

    def mean(self, metric: str) -> float:
        """Over objects; nan where none has a value."""
        values = list(self.metrics.get(metric, {}).values())
        return float(np.mean(values)) if values else math.nan


def scored(asked: NetworkRun, folder: Path, *, mask_pixels: int) -> Score:
    """Judge a network, or read what was judged before; kept as `score.json`."""
    if found := kept_score(asked, folder, mask_pixels=mask_pixels):
        return found
    score = _judged(asked, mask_pixels)
    body = {"schema": SCHEMA, "key": _key(asked, mask_pixels), "score": score}
    write_json(folder / FILE, body)
    return score


def kept_score(asked: NetworkRun, folder: Path, *, mask_pixels: int) -> Score | None:
    """What was judged before, where nothing that it depends on has changed."""
    try:
        found = json.loads((folder / FILE).read_text(encoding="utf-8"))
        return Score(**found["score"]) if found["key"] == _key(asked, mask_pixels) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


@torch.no_grad()
def _judged(asked: NetworkRun, mask_pixels: int) -> Score:
    predictor, config = made_predictor(asked)
    source = opened(asked.truth, asked.split, config.slots)
    by_metric: dict[str, dict[str, float]] = {}
    failures, total = {}, min(asked.count, len(source))
    with progress("objects", total) as advance:
        for item in held_out(source, config, count=asked.count):
            try:
                found = values_of(predictor, item, mask_pixels=mask_pixels)
            except ArtgenError as error:
                failures[item.name], found = str(error), {}
            for name, values in found.items():
                by_metric.setdefault(name, {})[item.name] = float(np.mean(values))
            advance(item.name)
    for name, values_by_object in by_metric.items():
        worst = METRICS[name].worst
        values_by_object |= {} if worst is None else dict.fromkeys(failures, worst)
    return Score(metrics=by_metric, objects=total, failures=failures)


def values_of(predictor: Predictor, item: HeldOut, *, mask_pixels: int) -> Values:
    """Metrics of one object, parts matched by nearness."""
    guess: Guess = predictor(item)
    true = item.layout if guess.rest is None else rebased(item.layout, guess.rest)
    predicted, true = in_radii(guess.layout, true)
    pairs = {"nearest": nearest(predicted, true)}
    found = matched_values(predicted, true, pairs, mask_pixels=mask_pixels)
    for prefix, images in guess.images.items():
        for image in images:
            put(found, prefix, asdict(image))
    return found


def _key(asked: NetworkRun, mask_pixels: int) -> str:
    """What a score depends on."""
    splits = {"predictions": None, "truth": asked.split, "train": "train"}
    hashes = {name: _content(getattr(asked, name), split) for name, split in splits.items()}
    table = {**plain(asked), **hashes}
    del table["device"]  # Alike but for rounding.
    return content_hash([SCHEMA, table, mask_pixels])


def _content(place: Path | str | None, split: Split | None) -> str:
    """A hash of what is there; the word itself where nothing is, as for a baseline."""
    if place is None or not Path(place).exists():
        return str(place)
    path = Path(place)
    return file_hash(path) if path.is_file() else fingerprint(path, split)
