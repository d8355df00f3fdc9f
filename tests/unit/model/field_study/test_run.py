"""The whole study, as small as can be: tables that read back, plots, a page."""

from pathlib import Path

import pytest
import torch

from artgen.core.errors import UsageError
from artgen.core.stream import Stream
from artgen.studies.table import read_table
from model.field_study import images, measure, run, taught
from model.field_study.cli import study
from model.field_study.images import PSNR_MOST, psnr, rendered
from model.field_study.measure import usual
from model.field_study.rows import MeshRow, PlanesRow, PrecisionRow, SamplesRow
from model.field_study.scene import scene


def test_equal_images_and_unequal_ones() -> None:
    place = scene(8, "cpu")
    one = rendered(place.field, place, usual(100.0))
    assert psnr(one, one) == PSNR_MOST
    other = one.mapped(lambda tensor: tensor + 0.1)
    # Color and coverage are 0.1 more, so over white they are equal again.
    assert psnr(one, other) > 100.0
    brighter = type(one)(**(vars(one) | {"rgb_BR3": one.rgb_BR3 + 0.1}))
    assert psnr(one, brighter) == pytest.approx(20.0, abs=1e-3)


def test_the_study_writes_its_tables_plots_and_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """More samples are never worse here, and bfloat16 is worse than float32."""
    for module in (measure, run):
        monkeypatch.setattr(module, "SAMPLES", (4, 16))
        monkeypatch.setattr(module, "PLANES", (4,))
        monkeypatch.setattr(module, "RESOLUTIONS", (10, 14))
        monkeypatch.setattr(module, "PLANE_PX", 8, raising=False)
    monkeypatch.setattr(measure, "COARSE", (0,))
    monkeypatch.setattr(measure, "SURFACE_POINTS", 64)
    monkeypatch.setattr(images, "REFERENCE_SAMPLES", 64)
    monkeypatch.setattr(measure, "SHARPNESS", (30.0, 100.0))
    monkeypatch.setattr(taught, "BATCH", 128)
    path = run.measured(tmp_path, device="cpu", px=6, steps=3, stream=Stream(0, "study"))
    samples = read_table(tmp_path / "render_field_samples.csv", SamplesRow)
    assert len(samples) == 2 * 2 * 2
    few, many = (min(row.psnr_db for row in samples if row.samples == count) for count in (4, 16))
    assert many > few
    precise = read_table(tmp_path / "render_field_precision.csv", PrecisionRow)
    errors = {row.precision: row.distance_error for row in precise}
    assert errors["bfloat16"] > 100 * errors["float32"]
    assert len(read_table(tmp_path / "render_field_planes.csv", PlanesRow)) == 1
    meshes = read_table(tmp_path / "render_field_meshes.csv", MeshRow)
    assert meshes[1].triangles > meshes[0].triangles
    text = path.read_text(encoding="utf-8")
    for picture in ("samples", "planes", "meshes"):
        assert (tmp_path / f"render_field_{picture}.png").exists()
        assert f"render_field_{picture}.png" in text
    assert "| standard |" in text


def test_a_device_that_is_not_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    with pytest.raises(UsageError, match="--device cuda"):
        study([str(tmp_path), "--device", "cuda"])
