"""Plots of the training studies: differences with intervals, and curves with their seeds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.studies.canvas import Axes, Figure, FigureCanvasAgg
from model.evaluation.metrics import METRICS
from model.training_study.claims import NAMES
from model.training_study.pairs import Difference

DPI = 110
COLORS = {"better": "tab:green", "worse": "tab:red", "not told apart": "gray"}


def plot_differences(
    path: Path, rows: Mapping[str, Sequence[Difference]], metrics: Sequence[str]
) -> None:
    """A panel for each metric, a line for each comparison: mean, interval and single seeds."""
    figure = Figure(
        figsize=(2.4 * len(metrics) + 2.2, 0.42 * len(rows) + 1.4), dpi=DPI, layout="constrained"
    )
    FigureCanvasAgg(figure)
    panels = np.atleast_1d(figure.subplots(1, len(metrics), sharey=True))
    for axes, metric in zip(panels.tolist(), metrics, strict=True):
        for y, name in enumerate(rows):
            for own in rows[name]:
                if own.metric == metric:
                    _difference(axes, y, own)
        axes.axvline(0.0, color="black", lw=0.8)
        axes.set_title(NAMES[metric], fontsize=8)
        axes.tick_params(labelsize=7)
        axes.grid(visible=True, axis="x", alpha=0.25)
    panels[0].set_yticks(range(len(rows)), list(rows), fontsize=7)
    panels[0].invert_yaxis()
    _save(figure, path)


def _difference(axes: Axes, y: float, own: Difference) -> None:
    color = COLORS[own.finding]
    if own.lower is not None and own.upper is not None:
        axes.plot([own.lower, own.upper], [y, y], "-", color=color, lw=2.5, alpha=0.6)
    axes.plot([own.mean], [y], "D", color=color, ms=5)
    seeds = list(own.by_seed.values())
    axes.plot(seeds, [y + 0.18] * len(seeds), "o", color=color, ms=2.5)


@dataclass(frozen=True, kw_only=True)
class CurvePoint:
    """One point of a curve: what it costs, and the quality of every seed there."""

    series: str
    x: float
    values: tuple[float, ...]


def plot_curves(
    path: Path, points: Mapping[str, Sequence[CurvePoint]], *, title: str, x: str
) -> None:
    """A panel for each metric, a line for each series through the means of its seeds."""
    count = max(len(points), 1)
    figure = Figure(figsize=(3.0 * count + 0.4, 3.4), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    panels = np.atleast_1d(figure.subplots(1, count))
    for axes, (metric, own) in zip(panels.tolist(), points.items(), strict=False):
        for k, series in enumerate(dict.fromkeys(point.series for point in own)):
            listed = sorted((p for p in own if p.series == series), key=lambda point: point.x)
            color = f"C{k}"
            means = [float(np.mean(point.values)) for point in listed]
            axes.plot([p.x for p in listed], means, "-o", color=color, ms=4, label=series)
            for point in listed:
                axes.plot([point.x] * len(point.values), point.values, ".", color=color, ms=3)
        better = METRICS[metric].better
        axes.set(xscale="log", xlabel=x)
        axes.set_title(f"{NAMES[metric]} ({better} is better)", fontsize=8)
        axes.tick_params(labelsize=7)
        axes.grid(visible=True, which="both", alpha=0.25)
    panels[0].legend(fontsize=7)
    figure.suptitle(title, fontsize=9)
    _save(figure, path)


def _save(figure: Figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
