"""The score of a network: every metric of every held-out object, kept as one JSON."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.core.jsonio import content_hash, file_hash, plain, write_json
from model.evaluation.network_run import NetworkRun, run
from model.evaluation.score import Protocol

SCHEMA = "artgen-training-score/1"
FILE = "score.json"

ByObject = Mapping[str, float]
"""Object to the mean of the values that it brings."""


@dataclass(frozen=True, kw_only=True)
class Score:
    """What one network, or baseline, is worth on one set of objects.

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


def scored(asked: NetworkRun, protocol: Protocol, folder: Path) -> Score:
    """Judge a network, or read what was judged before: `score.json` and a record an object."""
    if found := kept_score(asked, protocol, folder):
        return found
    records = run(asked, protocol, folder / "objects")
    by_metric: dict[str, dict[str, float]] = {}
    for record in records:
        for name, values in record.metrics.items():
            if len(values):
                by_metric.setdefault(name, {})[record.name] = float(np.mean(values))
    score = Score(
        metrics=by_metric,
        objects=len(records),
        failures={r.name: r.failure for r in records if r.failure is not None},
    )
    body = {"schema": SCHEMA, "key": _key(asked, protocol), "score": score}
    write_json(folder / FILE, body)
    return score


def kept_score(asked: NetworkRun, protocol: Protocol, folder: Path) -> Score | None:
    """What was judged before, where nothing that it depends on has changed."""
    try:
        found = json.loads((folder / FILE).read_text(encoding="utf-8"))
        return Score(**found["score"]) if found["key"] == _key(asked, protocol) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _key(asked: NetworkRun, protocol: Protocol) -> str:
    """What a score depends on; folders of shards are told apart by their paths alone."""
    places = {name: getattr(asked, name) for name in ("predictions", "truth", "train")}
    hashes = {
        name: file_hash(Path(own)) if own is not None and Path(own).is_file() else str(own)
        for name, own in places.items()
    }
    stated = {**plain(asked), **hashes}
    return content_hash([SCHEMA, stated, protocol])
