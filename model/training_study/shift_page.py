"""The table and the page of `artgen study shift`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.core.stream import Stream
from artgen.studies.table import markdown_table
from model.evaluation.intervals import estimate
from model.training_study.claims import NAMES
from model.training_study.pairs import difference
from model.training_study.rows import plainly, told
from model.training_study.scores import Score

HEAD = """# A network where it was not trained

Written by `artgen study shift` for `{network}`; the CSV file beside this page holds every number.
Means over held-out objects with 95 % bootstrap intervals; below each table, the difference from the
condition named there on the very same objects, object by object. Cameras and states are drawn anew
for ray-cast images and are those of the file in shards, so a difference between a renderer and ray
casting holds that of the cameras, too; two renderers of the same jobs share theirs.
"""


@dataclass(frozen=True, kw_only=True)
class ShiftRow:
    """One metric under one condition, beside one other; a condition that is compared with several
    has a row for each.

    Attributes:
        mean, lower, upper: over objects.
        objects: that have a value.
        against: the condition compared with; empty where there is none.
        change, change_lower, change_upper: the paired difference from it.
        pairs: objects that both have.
    """

    condition: str
    metric: str
    mean: float
    lower: float | None
    upper: float | None
    objects: int
    against: str
    change: float | None
    change_lower: float | None
    change_upper: float | None
    pairs: int


def shift_rows(scores: Mapping[str, Score], against: Mapping[str, Sequence[str]]) -> list[ShiftRow]:
    """Every metric of the studies that a condition has."""
    return [
        _row(name, metric, scores, other)
        for name, score in scores.items()
        for other in against[name] or ("",)
        for metric in NAMES
        if metric in score.metrics
    ]


def _row(name: str, metric: str, scores: Mapping[str, Score], against: str) -> ShiftRow:
    score = scores[name]
    stream = Stream(0, "training study", "shift", name, metric)
    own = estimate([[value] for value in score.metrics[metric].values()], stream)
    both = {0: score}, {0: scores[against]} if against else {}
    found = difference(metric, *both, stream.child(against))
    return ShiftRow(
        condition=name,
        metric=metric,
        mean=score.mean(metric),
        lower=own.lower,
        upper=own.upper,
        objects=own.objects,
        against=against,
        change=found.mean if found else None,
        change_lower=found.lower if found else None,
        change_upper=found.upper if found else None,
        pairs=found.objects if found else 0,
    )


def page(rows: Sequence[ShiftRow], *, network: str, picture: str | None) -> str:
    """The page."""
    metrics = [metric for metric in NAMES if any(row.metric == metric for row in rows)]
    conditions = list(dict.fromkeys(row.condition for row in rows))
    table = {(row.condition, row.metric): row for row in rows}
    header = ("condition", "objects", *(NAMES[metric] for metric in metrics))
    means = [
        (
            name,
            str(max(row.objects for row in rows if row.condition == name)),
            *(_mean(table.get((name, metric))) for metric in metrics),
        )
        for name in conditions
    ]
    compared: dict[str, list[ShiftRow]] = {}
    for row in rows:
        if row.pairs:
            compared.setdefault(f"{row.condition} - {row.against}", []).append(row)
    changes = [
        (
            name,
            str(max(row.pairs for row in own)),
            *(_change({row.metric: row for row in own}.get(metric)) for metric in metrics),
        )
        for name, own in compared.items()
    ]
    parts = [HEAD.format(network=network), "## Means", markdown_table(header, means)]
    if changes:
        parts += ["## Differences", markdown_table(("difference", *header[1:]), changes)]
    if picture:
        parts.append(f"![Differences with intervals]({picture})")
    return "\n\n".join(part.strip() for part in parts) + "\n"


def _mean(row: ShiftRow | None) -> str:
    if row is None:
        return "-"
    middle = plainly(row.metric, row.mean)
    if row.lower is None or row.upper is None:
        return middle
    return f"{middle} ({plainly(row.metric, row.lower)} .. {plainly(row.metric, row.upper)})"


def _change(row: ShiftRow | None) -> str:
    if row is None or row.change is None:
        return "-"
    middle = told(row.metric, row.change)
    if row.change_lower is None or row.change_upper is None:
        return middle
    return (
        f"{middle} ({told(row.metric, row.change_lower)} .. {told(row.metric, row.change_upper)})"
    )
