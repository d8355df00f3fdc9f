"""`artgen study render-field`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import torch
import tyro

from artgen.core.errors import UsageError
from artgen.core.stream import Stream
from artgen.progress import progress
from artgen.studies.plot import Point, plot_front
from artgen.studies.table import write_table
from model.field_study.measure import (
    PLANE_PX,
    PLANES,
    RESOLUTIONS,
    SAMPLES,
    mesh_rows,
    plane_rows,
    precision_rows,
    sample_rows,
)
from model.field_study.page import page
from model.field_study.presets import combined, render_presets
from model.field_study.rows import MeshRow, PlanesRow, SamplesRow
from model.field_study.scene import scene
from model.field_study.taught import Taught

NAME = "render_field"


@dataclass(frozen=True, kw_only=True)
class RenderField:
    """Samples per ray, plane resolution, precision and marching cubes: error against time.

    A hollow cabinet known in closed form is taught to hexa-planes and rendered in many ways. Takes
    some minutes on one CPU core.
    """

    out: Annotated[Path, tyro.conf.Positional] = Path("docs/studies")
    """Folder that receives render_field_*.csv, render_field_*.png and render_field.md."""
    device: Literal["cpu", "cuda"] = "cpu"
    """Where to measure; on `cpu`, times are CPU times of this process."""
    px: int = 24
    """Width and height of the images."""
    steps: int = 250
    """Updates of planes and networks when they are taught the scene."""
    seed: int = 0
    """Root of all chance."""


def study(argv: Sequence[str]) -> int:
    """Rendered fields and extracted meshes: samples, planes, precision, cells."""
    command = tyro.cli(RenderField, args=list(argv), prog="artgen study render-field")
    if command.device == "cuda" and not torch.cuda.is_available():
        raise UsageError("--device cuda: torch sees no GPU here; measure with --device cpu")
    path = measured(command)
    print(f"page: {path}")  # noqa: T201
    return 0


def measured(command: RenderField) -> Path:
    """The page, after all tables and plots beside it."""
    stream = Stream(command.seed, NAME)
    place = scene(command.px, command.device)
    total = 3 + len(SAMPLES) + len(PLANES) + len(RESOLUTIONS)
    with progress(NAME, total) as told:
        taught = Taught(place.field, PLANE_PX, command.steps, stream.child("taught"))
        field = taught.field()
        told("taught")
        samples = list(sample_rows(field, place, command.device, told))
        write_table(command.out / f"{NAME}_samples.csv", samples)
        precisions = list(precision_rows(taught, place, stream, command.device, told))
        write_table(command.out / f"{NAME}_precision.csv", precisions)
        meshes = list(mesh_rows(field, place, command.device, told))
        write_table(command.out / f"{NAME}_meshes.csv", meshes)
        planes = list(plane_rows(place, command.steps, stream, command.device, told))
        write_table(command.out / f"{NAME}_planes.csv", planes)
    _plot(command.out, samples, planes, meshes)
    path = command.out / f"{NAME}.md"
    text = page(
        *(samples, planes, precisions, meshes),
        hardware=_hardware(command.device),
        px=command.px,
        steps=command.steps,
    )
    path.write_text(text, encoding="utf-8")
    return path


def _hardware(device: str) -> str:
    if device == "cuda":
        return f"one {torch.cuda.get_device_name()}"
    return f"{torch.get_num_threads()} thread(s) of a CPU"


def _plot(
    folder: Path,
    samples: Sequence[SamplesRow],
    planes: Sequence[PlanesRow],
    meshes: Sequence[MeshRow],
) -> None:
    plot_front(
        folder / f"{NAME}_samples.png",
        [
            Point(
                cost=setting.step_ms,
                error=setting.psnr_db,
                series=f"{setting.quadrature}, coarse {setting.coarse}",
                label=str(setting.samples),
            )
            for setting in combined(samples)
        ],
        title="samples along rays",
        cost="ms of 1,000 rays that meet a box, forward and backward",
        error="PSNR, dB, worst of three sharpnesses",
        presets={p.name: (p.step_ms, p.psnr_db) for p in render_presets(samples)},
        better="higher",
    )
    plot_front(
        folder / f"{NAME}_planes.png",
        [
            Point(
                cost=float(row.numbers),
                error=row.distance_error,
                series="hexa-planes",
                label=str(row.plane_px),
            )
            for row in planes
        ],
        title="resolution of the planes",
        cost="numbers a part",
        error="error of distance at the surface, radii",
    )
    plot_front(
        folder / f"{NAME}_meshes.png",
        [
            Point(cost=row.ms, error=row.volume_error, series="cells", label=str(row.resolution))
            for row in meshes
        ],
        title="marching cubes",
        cost="ms of three parts",
        error="relative error of volume, worst part",
    )
