"""`artgen study render`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes
from artgen.progress import progress
from artgen.studies.plot import Point, plot_front
from artgen.studies.table import read_table, write_table
from renders.accuracy import SHIPPED, Measured
from renders.study.page import page
from renders.study.rows import Row
from renders.study.run import Extent, measured
from renders.study.settings import Setting, study_series
from renders.study.shipped import Worst, preset_size, presets, shipped_rows, worst_of_scenes

TABLE = "render.csv"
COST = "CPU s an image"


@dataclass(frozen=True, kw_only=True)
class Render:
    """Paths, denoiser, adaptive threshold, bounces and size against PSNR, FLIP and CPU seconds.

    An interrupted run resumes; pictures that are there are not rendered again.
    """

    out: Annotated[Path, tyro.conf.Positional] = Path("docs/studies")
    """Folder that receives render.csv, render_*.png and render.md."""
    work: Path = Path("out/study_render")
    """Folder that keeps scenes and pictures."""
    sizes: tuple[int, ...] = (64, 128, 256)
    """Widths of the images, px."""
    references: tuple[int, ...] = (2048, 1024, 512)
    """Paths a pixel of the reference at each size."""
    shipped: Path = field(default=SHIPPED)
    """The table that `artgen render --accuracy` reads; rewritten."""
    from_table: bool = False
    """Render nothing: write plots, page and shipped table anew from render.csv."""


def render(argv: Sequence[str]) -> int:
    """Paths, denoiser, adaptive sampling, bounces, size: error against CPU seconds."""
    command = tyro.cli(Render, args=list(argv), prog="artgen study render")
    if len(command.references) != len(command.sizes):
        raise UsageError(
            f"--references {command.references}: expected one for each of --sizes {command.sizes}"
        )
    rows = _rows(command)
    _plot_all(command.out, rows)
    write_table(command.shipped, shipped_rows(rows))
    text = page(rows, read_table(command.shipped, Measured))
    write_bytes(command.out / "render.md", text.encode())
    print(f"page: {command.out / 'render.md'}")  # noqa: T201
    return 0


def _rows(command: Render) -> list[Row]:
    if command.from_table:
        return read_table(command.out / TABLE, Row)
    extent = Extent(
        references=dict(zip(command.sizes, command.references, strict=True)), series=study_series
    )
    with progress("pictures", extent.steps) as advance:
        rows = measured(extent, command.work, advance)
    write_table(command.out / TABLE, rows)
    return read_table(command.out / TABLE, Row)  # as rounded as the next reader finds them


def _plot_all(folder: Path, rows: Sequence[Row]) -> None:
    """A plot for every size: worst PSNR of the scenes against mean CPU time, and one of FLIP."""
    table = worst_of_scenes(rows)
    sizes = sorted({size for _, size in table})
    named = presets(table["composite", preset_size(sizes)])
    for size in sizes:
        measured = table["composite", size]
        title = f"{size} px composites, worst of three scenes"
        plot_front(
            folder / f"render_psnr_{size}.png",
            _points(measured, "psnr_db"),
            title=title,
            cost=COST,
            error="PSNR, dB",
            presets=_places(measured, "psnr_db", named),
            better="higher",
        )
        plot_front(
            folder / f"render_flip_{size}.png",
            _points(measured, "flip"),
            title=title,
            cost=COST,
            error="mean FLIP",
            presets=_places(measured, "flip", named),
        )


def _points(measured: Mapping[Setting, Worst], error: str) -> list[Point]:
    return [
        Point(
            cost=worst.cpu_s,
            error=getattr(worst, error),
            series=setting.series,
            label=str(setting.samples),
        )
        for setting, worst in measured.items()
    ]


def _places(
    measured: Mapping[Setting, Worst], error: str, named: Mapping[str, Setting]
) -> dict[str, tuple[float, float]]:
    return {
        name: (measured[setting].cpu_s, getattr(measured[setting], error))
        for name, setting in named.items()
        if setting in measured
    }
