"""Records to tables: every metric over all objects, by category and by part count."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from artgen.core.stream import Stream
from model.evaluation.intervals import Estimate, estimate
from model.evaluation.metrics import HEADLINES, MATCHINGS, METRICS
from model.evaluation.score import Record


@dataclass(frozen=True, kw_only=True)
class Summary:
    """What a run says.

    Attributes:
        objects: how many there were.
        failures: name to why there is no prediction.
        overall: metric to its estimate, for all of `METRICS`; a metric that could not be asked has
            the mean None.
        by_category, by_parts: group to the estimates of `HEADLINES`.
        gaps: metric that has both matchings to the mean by order less the mean by nearness.
    """

    objects: int
    failures: Mapping[str, str]
    overall: Mapping[str, Estimate]
    by_category: Mapping[str, Mapping[str, Estimate]]
    by_parts: Mapping[str, Mapping[str, Estimate]]
    gaps: Mapping[str, float]


def summary(records: Sequence[Record]) -> Summary:
    """Estimates over records; objects without prediction count with the worst of bounded metrics
    and are left out of the others, whose counts tell."""
    overall = {name: _estimate(records, name) for name in METRICS}
    return Summary(
        objects=len(records),
        failures={r.name: r.failure for r in records if r.failure is not None},
        overall=overall,
        by_category=_grouped(records, lambda record: record.category or "unknown"),
        by_parts=_grouped(records, lambda record: f"{record.parts:02d}"),
        gaps=_gaps(overall),
    )


def _estimate(records: Sequence[Record], name: str) -> Estimate:
    values = [record.metrics.get(name, ()) for record in records]
    return estimate(values, Stream(0, "evaluation", "intervals", name))


def _grouped(
    records: Sequence[Record], key: Callable[[Record], str]
) -> dict[str, dict[str, Estimate]]:
    groups: dict[str, list[Record]] = {}
    for record in (own for own in records if own.parts):  # 0 where the truth cannot be read.
        groups.setdefault(key(record), []).append(record)
    return {
        group: {name: _estimate(own, name) for name in HEADLINES}
        for group, own in sorted(groups.items())
    }


def _gaps(overall: Mapping[str, Estimate]) -> dict[str, float]:
    order, nearest = (f".{name}." for name in MATCHINGS)
    gaps = {}
    for name, own in overall.items():
        if order in name:
            other = overall[name.replace(order, nearest)]
            if own.mean is not None and other.mean is not None:
                gaps[name.replace(order, ".")] = own.mean - other.mean
    return gaps
