"""The whole study: pictures of every series, rows, and how fine the references are."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.worker import BlenderWorker
from renders.study.pictures import SEED, reference, rendered, target
from renders.study.rows import Row, rows, truth
from renders.study.scenes import SCENES, made_bundles
from renders.study.settings import Setting

THREADS = 2
"""Of the Blender process; wall seconds are with so many."""


@dataclass(frozen=True, kw_only=True)
class Extent:
    """What is measured: sizes with the paths a pixel of their references, and the series."""

    references: dict[int, int]
    series: Callable[[int], Sequence[tuple[Setting, ...]]]

    @property
    def steps(self) -> int:
        """How often `measured` reports progress."""
        return len(SCENES) * sum(1 + len(self.series(size)) for size in self.references)


def measured(extent: Extent, work: Path, advance: Callable[[str], None]) -> list[Row]:
    """Rows of all scenes; pictures are kept in `work`, where an interrupted run finds them.

    Args:
        advance: called with a word after every step.
    """
    bundles = made_bundles(work / "scenes")
    found: list[Row] = []
    with BlenderWorker(work / "blender.log", threads=THREADS) as worker:
        for size, samples in extent.references.items():
            for scene, bundle in bundles.items():
                seen = target(scene, bundle, size=size, folder=work)
                kept = work / "pictures"
                true = truth(seen, reference(seen, samples=samples, worker=worker, kept=kept))
                advance(f"{scene} {size} px, reference")
                for series in extent.series(size):
                    pictures = rendered(seen, series, seed=SEED, worker=worker, kept=kept)
                    for setting, images in pictures.items():
                        found += rows(seen, setting, images, true)
                    advance(f"{scene} {size} px, {series[-1].series}")
    return found
