"""Means with 95 % intervals: objects are drawn again, with all the values they bring."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from artgen.core.stream import Stream

DRAWS = 2000
LEVEL = 0.95


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """Of one metric over some objects.

    Attributes:
        mean: over all values; None where there are none.
        median: over all values.
        lower, upper: percentile bootstrap interval of the mean; None for fewer than two objects.
        values: how many there are.
        objects: how many objects brought at least one.
    """

    mean: float | None
    median: float | None
    lower: float | None
    upper: float | None
    values: int
    objects: int


def estimate(by_object: Sequence[Sequence[float]], stream: Stream) -> Estimate:
    """Of the values that each object brings; values of one object are not independent, so objects
    are drawn with replacement (Efron and Tibshirani 1993, section 8.5), `DRAWS` times."""
    kept = [list(values) for values in by_object if len(values)]
    flat = [value for values in kept for value in values]
    if not flat:
        return Estimate(mean=None, median=None, lower=None, upper=None, values=0, objects=0)
    lower, upper = _interval(kept, stream) if len(kept) > 1 else (None, None)
    return Estimate(
        mean=float(np.mean(flat)),
        median=float(np.median(flat)),
        lower=lower,
        upper=upper,
        values=len(flat),
        objects=len(kept),
    )


def _interval(kept: Sequence[Sequence[float]], stream: Stream) -> tuple[float, float]:
    sums = np.array([np.sum(values) for values in kept])
    counts = np.array([len(values) for values in kept])
    drawn = stream.generator().integers(0, len(kept), (DRAWS, len(kept)))
    means = sums[drawn].sum(axis=1) / counts[drawn].sum(axis=1)
    tail = (1.0 - LEVEL) / 2.0
    lower, upper = np.quantile(means, [tail, 1.0 - tail]).tolist()
    return lower, upper
