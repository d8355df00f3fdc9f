"""Histograms of texel density and stretch, before and after the correction."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from artgen.assembly_study.rows import DENSITY_BINS, STRETCH_BINS, Chunk
from artgen.core.mesh import Floats
from artgen.studies.canvas import Figure, FigureCanvasAgg

INCHES, DPI = (8.6, 3.4), 110


def write_histograms(path: Path, chunks: Sequence[Chunk]) -> None:
    """Areas of fitted fronts over texel density and over stretch, logarithmic."""
    figure = Figure(figsize=INCHES, dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    pairs = (
        (DENSITY_BINS, "density_left", "density_fixed", "texel density over the material's"),
        (STRETCH_BINS, "stretch_left", "stretch_fixed", "stretch: larger over smaller scale"),
    )
    for axes, (bins, left, fixed, label) in zip(figure.subplots(1, 2), pairs, strict=True):
        for name, word in ((left, "as scaled"), (fixed, "corrected")):
            total = summed(chunks, name)
            axes.stairs(total / total.sum(), bins, label=word, fill=False, lw=1.3)
        axes.set(xlabel=label, ylabel="share of the area of fitted fronts", yscale="log")
        axes.set_ylim(1e-5, 1.5)
        axes.grid(visible=True, alpha=0.25)
        axes.legend(fontsize=8)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})


def summed(chunks: Sequence[Chunk], name: str) -> Floats:
    """A histogram over all chunks."""
    return np.sum([getattr(chunk, name) for chunk in chunks], axis=0)


def share_within(total: Floats, bins: Floats, low: float, high: float) -> float:
    """Share of the area in bins that lie between two values."""
    inside = (bins[:-1] >= low - 1e-9) & (bins[1:] <= high + 1e-9)
    return float(total[inside].sum() / total.sum())
