"""The page of `artgen study scaling`, written from its rows; what was not run is told."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from artgen.studies.table import markdown_table
from model.training_study.claims import NAMES
from model.training_study.rows import NOT_RUN, plainly
from model.training_study.scaling import Scaling

HEAD = """# What more objects and more updates buy

Written by `artgen study scaling`; the CSV file beside this page holds every number. All figures are
means over the same {held_out} held-out objects; where there are several seeds, the mean over them,
with the least and the greatest in brackets.

Runs: `{kind}`, size `{size}`, {steps} updates of {batch} objects each, {seeds} seeds, sets of
{counts} objects; {done} of {cells} runs are done. {scenes}
"""
SAME_SCENES = """Every object is seen in {scenes} scenes that come again, so more objects are more
scenes as well, in proportion: the curve does not tell one from the other."""
NEW_SCENES = """Scenes are drawn anew each time, so all runs see as many of them: the curve is
that of objects alone."""
UPDATES = """The same runs on {most} objects, judged on the way. Their learning rate falls on one
cosine over all {steps} updates, so that points on the way lie below what a run of that length would
reach.
"""


@dataclass(frozen=True, kw_only=True)
class CurveRow:
    """One metric at one point of a curve.

    Attributes:
        axis: what is varied: `objects` or `updates`.
        series: who was judged.
        x: how many.
        mean: over held-out objects.
        objects: how many of them have a value.
    """

    axis: str
    series: str
    x: int
    seed: int
    metric: str
    mean: float
    objects: int


def page(rows: Sequence[CurveRow], command: Scaling, *, cells: int, pictures: Sequence[str]) -> str:
    """The page."""
    done = {(row.x, row.seed) for row in rows if (row.axis, row.series) == ("objects", "network")}
    seen = NEW_SCENES if command.scenes is None else SAME_SCENES
    head = HEAD.format(
        scenes=seen.format(scenes=command.scenes),
        held_out=command.held_out,
        kind=command.kind,
        size=command.size,
        steps=command.steps,
        batch=command.batch,
        seeds=command.seeds,
        counts=", ".join(str(count) for count in command.counts),
        done=len(done),
        cells=cells,
    )
    parts = [head, "## Objects", _table(rows, "objects")]
    parts += [f"![Quality by objects]({name})" for name in pictures if "objects" in name]
    parts += ["## Updates", UPDATES.format(most=command.counts[-1], steps=command.steps)]
    parts.append(_table(rows, "updates"))
    parts += [f"![Quality by updates]({name})" for name in pictures if "updates" in name]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def _table(rows: Sequence[CurveRow], axis: str) -> str:
    own = [row for row in rows if row.axis == axis]
    if not own:
        return f"{NOT_RUN.capitalize()}."
    metrics = [metric for metric in NAMES if any(row.metric == metric for row in own)]
    places = sorted(
        dict.fromkeys((row.series, row.x) for row in own), key=lambda place: (place[1], place[0])
    )
    lines = [
        (
            str(x),
            series,
            *(_cell([r for r in own if (r.series, r.x, r.metric) == (series, x, metric)])
              for metric in metrics),
        )
        for series, x in places
    ]  # fmt: skip
    return markdown_table((axis, "who", *(NAMES[metric] for metric in metrics)), lines)


def _cell(rows: Sequence[CurveRow]) -> str:
    if not rows:
        return "-"
    means, metric = [row.mean for row in rows], rows[0].metric
    middle = plainly(metric, float(np.mean(means)))
    if len(means) == 1:
        return middle
    return f"{middle} ({plainly(metric, min(means))} .. {plainly(metric, max(means))})"
