"""Rows of the tables that a study writes."""

from collections.abc import Mapping
from dataclasses import dataclass

from artgen.core.stream import Stream
from model.evaluation.metrics import METRICS
from model.training_study.claims import CLAIMS, NAMES, Claim, Comparison
from model.training_study.pairs import Difference, difference
from model.training_study.scores import Score

Known = Mapping[str, Mapping[int, Score]]
"""Arm and seed to what was scored."""


@dataclass(frozen=True, kw_only=True)
class ScoreRow:
    """One metric of one run.

    Attributes:
        mean: over the objects that have a value.
    """

    arm: str
    seed: int
    metric: str
    mean: float
    objects: int


@dataclass(frozen=True, kw_only=True)
class ClaimRow:
    """One metric of one comparison.

    Attributes:
        expected: what the claim says of the arm.
        mean: of the arm less that of `against`; None where a run is missing.
        lower, upper: 95 % interval over seeds and objects.
        seeds: how many both arms were run from.
        agreeing: from how many of them the difference has the sign of the mean.
        verdict: whether the claim reproduces by this metric.
    """

    claim: str
    arm: str
    against: str
    metric: str
    expected: str
    mean: float | None
    lower: float | None
    upper: float | None
    seeds: int
    agreeing: int
    objects: int
    verdict: str


NOT_RUN = "not yet run"
LEAST_SEEDS = 3
"""Two runs of 16 updates, which had learned nothing, gave an interval beside zero."""


def score_rows(known: Known) -> list[ScoreRow]:
    """Every metric of a study that a run has."""
    return [
        ScoreRow(
            arm=arm,
            seed=seed,
            metric=metric,
            mean=score.mean(metric),
            objects=len(score.metrics[metric]),
        )
        for arm, by_seed in known.items()
        for seed, score in sorted(by_seed.items())
        for metric in NAMES
        if metric in score.metrics
    ]


def claim_rows(known: Known) -> list[ClaimRow]:
    """Every metric of every comparison of every claim, those that were not run among them."""
    return [
        _row(claim, own, metric, known)
        for claim in CLAIMS
        for own in claim.comparisons
        for metric in claim.metrics
    ]


def _row(claim: Claim, own: Comparison, metric: str, known: Known) -> ClaimRow:
    stream = Stream(0, "training study", own.arm, own.against, metric)
    found = difference(metric, known.get(own.arm, {}), known.get(own.against, {}), stream)
    return ClaimRow(
        claim=claim.name,
        arm=own.arm,
        against=own.against,
        metric=metric,
        expected=own.expected,
        mean=found.mean if found else None,
        lower=found.lower if found else None,
        upper=found.upper if found else None,
        seeds=len(found.by_seed) if found else 0,
        agreeing=_agreeing(found) if found else 0,
        objects=found.objects if found else 0,
        verdict=verdict(own, found),
    )


def verdict(own: Comparison, found: Difference | None) -> str:
    """In a word: whether the interval lies on the side that the claim names.

    An interval over few seeds is too narrow, so that there must be `LEAST_SEEDS`, of one sign.
    """
    if found is None:
        return NOT_RUN
    if len(found.by_seed) < LEAST_SEEDS or _agreeing(found) < len(found.by_seed):
        return "not told apart"
    if found.finding == "not told apart" or own.expected == "open":
        return found.finding
    return "reproduces" if found.finding == own.expected else "reversed"


def _agreeing(found: Difference) -> int:
    return sum((mean > 0.0) == (found.mean > 0.0) for mean in found.by_seed.values())


def told(metric: str, difference: float | None) -> str:
    """A difference with its sign, with as many digits as its unit deserves."""
    return "-" if difference is None else f"{difference:+.{_digits(metric) + 1}f}"


def plainly(metric: str, value: float) -> str:
    """A figure with as many digits as its unit deserves."""
    return f"{value:.{_digits(metric)}f}"


def _digits(metric: str) -> int:
    return 1 if METRICS[metric].unit.startswith(("deg", "dB")) else 3
