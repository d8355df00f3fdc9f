"""All measurements of `artgen study render-field`, its tables, plots and page."""

from collections.abc import Sequence
from pathlib import Path

import torch

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


def measured(out: Path, *, device: str, px: int, steps: int, stream: Stream) -> Path:
    """The page, after all tables and plots beside it.

    Raises:
        UsageError: there is no such device.
    """
    if device == "cuda" and not torch.cuda.is_available():
        raise UsageError("--device cuda: torch sees no GPU here; measure with --device cpu")
    place = scene(px, device)
    total = 3 + len(SAMPLES) + len(PLANES) + len(RESOLUTIONS)
    with progress(NAME, total) as told:
        taught = Taught(place.field, PLANE_PX, steps, stream.child("taught"))
        field = taught.field()
        told("taught")
        samples = list(sample_rows(field, place, device, told))
        write_table(out / f"{NAME}_samples.csv", samples)
        precisions = list(precision_rows(taught, place, stream, device, told))
        write_table(out / f"{NAME}_precision.csv", precisions)
        meshes = list(mesh_rows(field, place, device, told))
        write_table(out / f"{NAME}_meshes.csv", meshes)
        planes = list(plane_rows(place, steps, stream, device, told))
        write_table(out / f"{NAME}_planes.csv", planes)
    _plot(out, samples, planes, meshes)
    path = out / f"{NAME}.md"
    text = page(
        *(samples, planes, precisions, meshes),
        hardware=_hardware(device),
        px=px,
        steps=steps,
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
