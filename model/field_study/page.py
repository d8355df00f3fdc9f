"""The page of `artgen study render-field`, written from its rows."""

from collections.abc import Sequence

from artgen.studies.front import pareto_front
from artgen.studies.table import markdown_table
from model.field_study.presets import (
    MESH_PROMISES,
    RENDER_PROMISES,
    combined,
    mesh_presets,
    render_presets,
)
from model.field_study.rows import MeshRow, PlanesRow, PrecisionRow, SamplesRow

HEAD = """# What accuracy of rendered fields and extracted meshes costs

Written by `artgen study render-field` on {hardware}; the CSV files beside this page hold every
number. Times move with the machine and its load, so read ratios.

The scene is a hollow cabinet of boards 0.015 to 0.03 radii thick with a drawer and a door, closed
and open, seen by two cameras in images of {px} px; its distance and colors are known in closed
form. Hexa-planes of 64 px and 16 channels under networks of 64 x 2 were taught it by regression.
"""
SAMPLES = """## Samples along rays

Against the same hexa-planes with 512 samples, whole and parts alone over white, at 1 / beta = 30,
100 and 300; the worst counts. `coarse` points are asked for distance alone, without gradient, and
draw the `samples` to the surface. `linear` takes the distance as linear between samples and
integrates its density in closed form; `point` takes the density at each sample, as is usual. ms are
of 1,000 rays that meet a box, at 1 / beta = 100, forward and backward.

A preset is the cheapest setting on the front that keeps its promise
({promises}), or else the most accurate.
"""
PLANES = """## Resolution of the planes

The same scene taught for {steps} steps to planes of growing resolution. The error of distances is
at points of the true surface; images are held against the true field.
"""
PRECISION = """## Precision of the networks

Against float64 everywhere. Geometry, distances of the ball, densities and sums are float32 at
least; only the matrix products of the two networks are rounded further. A CPU that has no bfloat16
arithmetic gains no time by it.
"""
MESHES = """## Resolution of marching cubes

Vertices and middles of triangles against the boards in closed form, mean and 99th percentile;
volume of the worst part. Boards thinner than a cell are lost or swell, which only the volume tells,
so presets keep it to {promises}. ms are of all three parts, asked of the hexa-planes.
"""


def page(
    samples: Sequence[SamplesRow],
    planes: Sequence[PlanesRow],
    precisions: Sequence[PrecisionRow],
    meshes: Sequence[MeshRow],
    *,
    hardware: str,
    px: int,
    steps: int,
) -> str:
    """Markdown."""
    promises = ", ".join(f"{name} {promise:g} dB" for name, promise in RENDER_PROMISES.items())
    lengths = ", ".join(f"{name} {promise:.0%}" for name, promise in MESH_PROMISES.items())
    return "\n".join(
        [
            HEAD.format(hardware=hardware, px=px),
            SAMPLES.format(promises=promises),
            _render_presets(samples),
            "![error against time](render_field_samples.png)\n",
            _front(samples),
            PLANES.format(steps=steps),
            _planes(planes),
            "![error against numbers](render_field_planes.png)\n",
            PRECISION,
            _precision(precisions),
            MESHES.format(promises=lengths),
            _meshes(meshes),
            "![error against time](render_field_meshes.png)\n",
        ]
    )


def _render_presets(rows: Sequence[SamplesRow]) -> str:
    return _table(
        ["preset", "samples", "coarse", "quadrature", "worst dB", "ms"],
        [
            [
                preset.name,
                str(preset.samples),
                str(preset.coarse),
                preset.quadrature,
                f"{preset.psnr_db:.1f}",
                f"{preset.step_ms:.1f}",
            ]
            for preset in render_presets(rows)
        ],
    )


def _front(rows: Sequence[SamplesRow]) -> str:
    settings = sorted(combined(rows), key=lambda setting: setting.step_ms)
    front = pareto_front([s.step_ms for s in settings], [-s.psnr_db for s in settings])
    return "The front:\n\n" + _table(
        ["samples", "coarse", "quadrature", "worst dB", "ms"],
        [
            [
                str(setting.samples),
                str(setting.coarse),
                setting.quadrature,
                f"{setting.psnr_db:.1f}",
                f"{setting.step_ms:.1f}",
            ]
            for setting, on_front in zip(settings, front, strict=True)
            if on_front
        ],
    )


def _planes(rows: Sequence[PlanesRow]) -> str:
    return _table(
        ["planes, px", "numbers a part", "error of distance, radii", "PSNR, dB", "ms"],
        [
            [
                str(row.plane_px),
                f"{row.numbers:,}",
                f"{row.distance_error:.4f}",
                f"{row.psnr_db:.1f}",
                f"{row.step_ms:.1f}",
            ]
            for row in rows
        ],
    )


def _precision(rows: Sequence[PrecisionRow]) -> str:
    return _table(
        ["networks", "1 / beta", "error of distance, radii", "PSNR, dB", "forward ms", "step ms"],
        [
            [
                row.precision,
                f"{row.inverse_beta:g}",
                f"{row.distance_error:.1e}",
                f"{row.psnr_db:.1f}",
                f"{row.forward_ms:.1f}",
                f"{row.step_ms:.1f}",
            ]
            for row in rows
        ],
    )


def _meshes(rows: Sequence[MeshRow]) -> str:
    names = {row.resolution: name for name, row in reversed(mesh_presets(rows).items())}
    return _table(
        ["cells", "preset", "mean, radii", "99 %, radii", "volume", "triangles", "ms"],
        [
            [
                str(row.resolution),
                names.get(row.resolution, ""),
                f"{row.distance_error:.5f}",
                f"{row.worst_error:.5f}",
                f"{100.0 * row.volume_error:.1f} %",
                f"{row.triangles:,}",
                f"{row.ms:.0f}",
            ]
            for row in rows
        ],
    )


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    return markdown_table(header, rows) + "\n"
