"""Is memory flat? Many small renders by one worker: resident size after each of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import psutil
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from artgen.export import Bundle
from artgen.progress import progress
from artgen.studies.table import write_table
from artgen.worker import BlenderWorker
from renders.asset import render_asset
from renders.backends import CyclesBackend
from renders.settings import Settings

TINY = Settings(views=1, states=1, size=32, accuracy="1spp")


@dataclass(frozen=True, kw_only=True)
class Size:
    """Resident MB after `objects` objects; a worker is replaced after 100 jobs."""

    objects: int
    blender_mb: float
    driver_mb: float


def measure_memory(
    bundles: Sequence[Bundle], scratch: Path, out: Path, *, objects: int
) -> list[Size]:
    """Render the bundles in turn; memory.csv and memory.png in `out`."""
    me = psutil.Process()
    sizes = []
    with BlenderWorker(scratch / "blender.log") as worker, progress("memory", objects) as advance:
        for k in range(objects):
            bundle = bundles[k % len(bundles)]
            render_asset(
                bundle,
                scratch / "sample.tar",
                settings=TINY,
                seed=k,
                scratch=scratch / "images",
                backend=CyclesBackend(worker),
            )
            blender = sum(child.memory_info().rss for child in me.children()) / 2**20
            driver = me.memory_info().rss / 2**20
            sizes.append(Size(objects=k + 1, blender_mb=blender, driver_mb=driver))
            advance(bundle.asset_id)
    write_table(out / "memory.csv", sizes)
    _plot(out / "memory.png", sizes)
    return sizes


def _plot(path: Path, sizes: Sequence[Size]) -> None:
    figure = Figure(figsize=(7.2, 3.6), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.plot([s.objects for s in sizes], [s.blender_mb for s in sizes], label="Blender")
    axes.plot([s.objects for s in sizes], [s.driver_mb for s in sizes], label="driver")
    axes.set(xlabel="objects rendered", ylabel="resident MB", ylim=(0, None))
    axes.grid(visible=True, alpha=0.25)
    axes.legend()
    figure.savefig(path, metadata={"Software": None})
