"""`artgen render`: renders what is missing, in any number of processes, and says what is wrong."""

import dataclasses
import hashlib
import json
import re
import shutil
from pathlib import Path

import pytest
from pyarrow import parquet

from artgen.core.errors import UsageError
from artgen.dataset import open_shard
from artgen.dataset.cli import shard
from artgen.export import Bundle
from renders.cli import render
from renders.settings import CameraSettings, SensorSettings, Settings

GENERATED = ("seed", "index", "rule", "params", "versions")
"""Keys of a manifest that only `artgen generate` writes."""
SMALL = ["--views", "1", "--states", "1", "--size", "24", "--accuracy", "2spp"]


def run_folder(bundle: Bundle, root: Path) -> Path:
    """Three copies of the chest; one is damaged."""
    for index in ("000001", "000002", "000003"):
        shutil.copytree(bundle.folder, root / "assets" / "chest" / index)
    for index in ("000002", "000003"):
        copy = root / "assets" / "chest" / index
        manifest = copy / "manifest.json"
        manifest.write_text(manifest.read_text().replace("chest_000001", f"chest_{index}"))
        for mesh in sorted((copy / "meshes").iterdir()):
            mesh.rename(mesh.with_name(mesh.name.replace("000001", index)))
    (root / "assets" / "chest" / "000003" / "asset.glb").write_bytes(b"no GLB")
    return root


def hashes(out: Path) -> dict[str, str]:
    files = [path for path in sorted(out.glob("samples/**/*")) if path.is_file()]
    files.append(out / "contact_sheet.png")
    return {
        path.relative_to(out).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
    }


@pytest.mark.blender
def test_a_bad_asset_fails_alone_and_workers_do_not_show(
    bundle: Bundle, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one = run_folder(bundle, tmp_path / "one")
    assert render([str(one), *SMALL, "--workers", "1"]) == 1
    said = capsys.readouterr().out
    assert "2 of 3 assets rendered" in said
    assert "failed chest_000003: Blender job 'render' failed" in said
    two = run_folder(bundle, tmp_path / "two")
    assert render([str(two), *SMALL, "--workers", "2"]) == 1
    assert hashes(one) == hashes(two)
    shutil.rmtree(one / "assets" / "chest" / "000003")
    (one / "samples" / "chest" / "000002.tar").unlink()
    assert render([str(one), *SMALL, "--workers", "1"]) == 0
    assert hashes(one) == hashes(two)
    assert not list((one / "work" / "render").iterdir())
    report = json.loads((one / "render_report.json").read_text())
    assert report["assets"] == {"rendered": 1, "kept": 1, "failed": 0}
    assert report["images"] == {"composite": 1, "alone": 4}
    assert set(report["cpu_seconds"]) == {"import", "composite", "alone"}
    assert report["effects"]["thin_glass"]["assets"] == 1
    assert report["effects"]["motion_blur"]["assets"] == 0


@pytest.mark.blender
def test_a_second_rendering_lives_beside_the_first(bundle: Bundle, tmp_path: Path) -> None:
    """Options win over their preset; the run's own samples and bundles stay as they are."""
    run = run_folder(bundle, tmp_path / "run")
    shutil.rmtree(run / "assets" / "chest" / "000003")
    fast = ["--size", "24", "--backend", "fast", "--workers", "1"]
    assert render([str(run), *fast]) == 0
    before = hashes(run)
    assert render([str(run), *fast, "--preset", "monocular", "--states=3", "--name", "mono"]) == 0
    assert hashes(run) == before
    report = json.loads((run / "render_report.json").read_text())
    assert "draw" in report["cpu_seconds"]
    assert not report["effects"]
    named = run / "renders" / "mono"
    sample = open_shard(named / "samples" / "chest" / "000001.tar").read("chest_000001")
    assert sample.shape == (3, 1, 4, 24, 24)
    with pytest.raises(UsageError, match=r"other views 1 \(now 4\), states 3 \(now 2\)"):
        render([str(run), *fast, "--name", "mono"])


@pytest.mark.blender
def test_any_folder_of_bundles_is_rendered_beside_itself(bundle: Bundle, tmp_path: Path) -> None:
    scans = tmp_path / "scans"
    manifest = shutil.copytree(bundle.folder, scans / "deep" / "one") / "manifest.json"
    stated = json.loads(manifest.read_text())
    manifest.write_text(json.dumps({k: v for k, v in stated.items() if k not in GENERATED}))
    before = sorted(scans.rglob("*"))
    words = ["--size", "24", "--backend", "fast", "--workers", "1", "--views", "1"]
    assert render([str(scans), *words]) == 0
    assert sorted(scans.rglob("*")) == before
    beside = tmp_path / "scans-renders"
    assert (beside / "samples" / "chest" / "000001.tar").is_file()
    places = json.loads((beside / "bundles.json").read_text())
    assert places["chest_000001"]["bundle"] == "../scans/deep/one"
    assert shard([str(beside)]) == 0
    (row,) = parquet.read_table(beside / "catalog" / "assets.parquet").to_pylist()
    assert (row["asset_id"], row["folder"]) == ("chest_000001", "../scans/deep/one")
    assert (row["index"], row["verdict"]) == (None, "valid")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--views", "0"], "--views 0: expected 1 to 1024 cameras"),
        (["--size", "8"], "--size 8: expected 16 to 8192 px"),
        (["--accuracy", "fine"], "--accuracy fine is unknown"),
        (["--preset", "trajectory", "--states", "40"], "--states 40: expected 2 to 32 frames"),
        (["--workers", "-1"], "--workers -1: expected at least 1"),
    ],
)
def test_nonsense_is_refused(tmp_path: Path, words: list[str], said: str) -> None:
    with pytest.raises(UsageError, match=said):
        render([str(tmp_path), *words])


def test_help_explains_every_option(capsys: pytest.CaptureFixture[str]) -> None:
    """Words follow every option: a choice, a type, and what it does in which unit."""
    with pytest.raises(SystemExit) as stop:
        render(["--help"])
    assert stop.value.code == 0
    said = " ".join(capsys.readouterr().out.replace("│", " ").split())
    groups = {"": Settings, "cameras.": CameraSettings, "sensor.": SensorSettings}
    for prefix, group in groups.items():
        for field in dataclasses.fields(group):
            if not dataclasses.is_dataclass(field.default_factory):
                option = f"--{prefix}{field.name.replace('_', '-')}"
                assert re.search(rf"{re.escape(option)}\b[^(]*[a-z]{{3,}} [^(]*\(", said), option
    for word in ("--preset", "--name", "--out", "--workers", "--seed"):
        assert word in said


def test_a_missing_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no such folder; name a run of `artgen generate`"):
        render([str(tmp_path / "nowhere")])
