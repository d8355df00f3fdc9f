"""Plots of a study: error against price, the front marked."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.studies.canvas import Figure, FigureCanvasAgg
from artgen.studies.front import pareto_front

INCHES = (7.2, 4.6)
DPI = 110


@dataclass(frozen=True, kw_only=True)
class Point:
    """One setting: its price, its error, and the series it belongs to."""

    cost: float
    error: float
    series: str
    label: str = ""


def plot_front(
    path: Path,
    points: Sequence[Point],
    *,
    title: str,
    cost: str,
    error: str,
    presets: Mapping[str, tuple[float, float]] | None = None,
    better: str = "lower",
) -> None:
    """Draw points by series, the Pareto front over all of them, and presets by name.

    Args:
        cost, error: what the axes show, with units; the cost axis is logarithmic.
        presets: name to (cost, error) of a ring around a point.
        better: `lower` for errors, on a logarithmic axis; `higher` for qualities such as dB.
    """
    figure = Figure(figsize=INCHES, dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    for name in dict.fromkeys(point.series for point in points):
        own = [point for point in points if point.series == name]
        axes.plot([p.cost for p in own], [p.error for p in own], "o", ms=4, label=name, alpha=0.8)
    sign = 1.0 if better == "lower" else -1.0
    front = pareto_front([p.cost for p in points], [sign * p.error for p in points])
    best = sorted((points[k] for k in np.flatnonzero(front)), key=lambda point: point.cost)
    axes.step([p.cost for p in best], [p.error for p in best], "k-", lw=1.0, where="post")
    for point in best:
        axes.annotate(point.label, (point.cost, point.error), fontsize=6, xytext=(3, 3),
                      textcoords="offset points")  # fmt: skip
    for name, (x, y) in (presets or {}).items():
        axes.plot([x], [y], "o", ms=12, mfc="none", mec="crimson", mew=1.5)
        axes.annotate(name, (x, y), color="crimson", xytext=(8, -10), textcoords="offset points")
    axes.set(title=title, xlabel=cost, ylabel=error, xscale="log")
    if better == "lower":
        axes.set_yscale("log")
    axes.grid(visible=True, which="both", alpha=0.25)
    axes.legend(fontsize=7)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
