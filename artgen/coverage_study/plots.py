"""Histograms of every parameter of a category, as one picture."""

import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from artgen.coverage_study.drawn import Drawn
from artgen.coverage_study.neighbours import TWIN, Neighbour
from artgen.coverage_study.rows import column
from artgen.rules.schema import CategoryRule
from artgen.studies.canvas import Axes, Figure, FigureCanvasAgg

COLUMNS = 8
CELL = (1.5, 1.15)
"""Inches."""
BINS = 16
DPI = 80


def write_histograms(
    path: Path, rule: CategoryRule, objects: Sequence[Drawn], nearest: Sequence[Neighbour]
) -> None:
    """A histogram of every parameter, of parts, and of the difference from the nearest neighbor."""
    rows = math.ceil((len(rule.draws) + 2) / COLUMNS)
    figure = Figure(figsize=(COLUMNS * CELL[0], rows * CELL[1]))
    FigureCanvasAgg(figure)
    axes = [figure.add_subplot(rows, COLUMNS, k + 1) for k in range(len(rule.draws) + 2)]
    for own, key in zip(axes, rule.draws, strict=False):
        _histogram(own, key, column(objects, key))
    _histogram(axes[-2], "(parts)", [sum(drawn.roles.values()) for drawn in objects])
    _histogram(axes[-1], "(nearest neighbor)", [n.differing for n in nearest])
    axes[-1].axvline(TWIN, color="tab:red", lw=0.8)
    figure.tight_layout(pad=0.4)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=DPI, metadata={"Software": None})


def _histogram(axes: Axes, title: str, values: Sequence[object]) -> None:
    axes.set_title(title, fontsize=6, pad=2)
    axes.tick_params(labelsize=5, length=1.5, pad=1)
    axes.set_yticks([])
    if all(isinstance(value, float) for value in values):
        axes.hist([float(str(value)) for value in values], bins=BINS, color="tab:blue")
        return
    counts = Counter(str(value) for value in values)
    words = sorted(counts, key=_by_number)
    axes.bar(range(len(words)), [counts[word] for word in words], color="tab:green")
    axes.set_xticks(range(len(words)), words, rotation=30 if max(map(len, words)) > 3 else 0)


def _by_number(word: str) -> tuple[float, str]:
    try:
        return float(word), word
    except ValueError:
        return math.inf, word
