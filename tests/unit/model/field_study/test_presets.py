"""Presets are the cheapest settings of the front that keep their promise."""

from model.field_study.presets import MESH_PROMISES, combined, mesh_presets, render_presets
from model.field_study.rows import MeshRow, SamplesRow


def row(samples: int, ms: float, *decibels: float) -> list[SamplesRow]:
    return [
        SamplesRow(
            samples=samples,
            coarse=0,
            quadrature="point",
            inverse_beta=sharp,
            psnr_db=db,
            part_psnr_db=db + 1.0,
            forward_ms=ms / 3.0,
            step_ms=ms,
        )
        for sharp, db in zip((30.0, 100.0), decibels, strict=True)
    ]


ROWS = [
    *row(4, 1.0, 35.0, 28.0),
    *row(8, 2.0, 45.0, 33.0),
    *row(16, 4.0, 60.0, 41.0),
    *row(24, 5.0, 60.0, 40.5),
    *row(32, 8.0, 70.0, 48.0),
]


def test_the_worst_sharpness_counts() -> None:
    assert [setting.psnr_db for setting in combined(ROWS)] == [28.0, 33.0, 41.0, 40.5, 48.0]


def test_the_cheapest_that_keeps_its_promise() -> None:
    """30 dB from 8 samples on, 40 from 16; nothing reaches 50, so the best stands in."""
    found = {preset.name: preset.samples for preset in render_presets(ROWS)}
    assert found == {"draft": 8, "standard": 16, "reference": 32}


def test_meshes_keep_their_volume() -> None:
    rows = [
        MeshRow(
            resolution=cells,
            distance_error=0.0,
            worst_error=0.0,
            volume_error=error,
            triangles=1,
            ms=float(cells),
        )
        for cells, error in ((16, 0.5), (32, 0.2), (48, 0.3), (64, 0.05))
    ]
    found = {name: row.resolution for name, row in mesh_presets(rows).items()}
    assert list(found) == list(MESH_PROMISES)
    assert found == {"draft": 32, "standard": 64, "reference": 64}
