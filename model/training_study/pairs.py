"""Paired comparison of two arms: the same objects, the same seeds, and an interval over both."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from model.evaluation.intervals import DRAWS, LEVEL
from model.evaluation.metrics import METRICS
from model.training_study.scores import Score

Finding = Literal["better", "worse", "not told apart"]


@dataclass(frozen=True, kw_only=True)
class Difference:
    """An arm less another by one metric.

    Attributes:
        mean: over all seeds and objects that both have.
        lower, upper: percentile bootstrap interval; seeds and objects are both drawn. None for a
            single object.
        by_seed: seed to its own mean.
        objects: how many were compared.
    """

    metric: str
    mean: float
    lower: float | None
    upper: float | None
    by_seed: Mapping[int, float]
    objects: int

    @property
    def finding(self) -> Finding:
        """Which way, where the interval leaves zero out."""
        if self.lower is None or self.upper is None or self.lower <= 0.0 <= self.upper:
            return "not told apart"
        more = METRICS[self.metric].better == "more"
        return "better" if (self.mean > 0.0) == more else "worse"


def difference(
    metric: str, arm: Mapping[int, Score], other: Mapping[int, Score], stream: Stream
) -> Difference | None:
    """The arm less the other, seed by seed and object by object; None where they share nothing."""
    seeds = sorted(set(arm) & set(other))
    pairs = {
        seed: {
            name: value - other[seed].metrics[metric][name]
            for name, value in arm[seed].metrics.get(metric, {}).items()
            if name in other[seed].metrics.get(metric, {})
        }
        for seed in seeds
    }
    names = sorted({name for own in pairs.values() for name in own})
    if not names:
        return None
    table_SN = np.array([[pairs[seed].get(name, np.nan) for name in names] for seed in seeds])
    lower, upper = crossed_interval(table_SN, stream) if len(names) > 1 else (None, None)
    return Difference(
        metric=metric,
        mean=float(np.nanmean(table_SN)),
        lower=lower,
        upper=upper,
        by_seed={
            seed: float(np.nanmean(row))
            for seed, row in zip(seeds, table_SN, strict=True)
            if np.isfinite(row).any()
        },
        objects=len(names),
    )


def crossed_interval(table_SN: Floats, stream: Stream) -> tuple[float, float]:
    """Percentile bootstrap interval of the mean of a table of seeds by objects, nan where unknown.

    Rows and columns are drawn with replacement, independently: both seeds and objects are samples
    of many (Owen 2007, "The pigeonhole bootstrap", which shows it to be conservative). With few
    seeds it can only hint at what further seeds would do.
    """
    seeds, objects = table_SN.shape
    rng = stream.generator()
    known, values = np.isfinite(table_SN).astype(float), np.nan_to_num(table_SN)
    rows = _counts(rng, DRAWS, seeds)
    columns = _counts(rng, DRAWS, objects)
    sums = np.einsum("ds,sn,dn->d", rows, values, columns)
    weights = np.einsum("ds,sn,dn->d", rows, known, columns)
    means = (sums / np.maximum(weights, 1.0))[weights > 0.0]
    tail = (1.0 - LEVEL) / 2.0
    lower, upper = np.quantile(means, [tail, 1.0 - tail]).tolist()
    return lower, upper


def _counts(rng: np.random.Generator, draws: int, size: int) -> Floats:
    """(draws, size) how often each of `size` is among `size` drawn with replacement."""
    return np.asarray(rng.multinomial(size, np.full(size, 1.0 / size), draws), float)
