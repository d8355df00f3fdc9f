"""A run from folders to bundles, and back to folders."""

import json
import shutil
from pathlib import Path

import pytest

from artgen.core.licence import licence_of
from artgen.export import read_bundle
from artgen.ingest.cli import partnet
from artgen.ingest.export_cli import partnet as export_partnet
from artgen.validate import validate_bundle
from tests.integration.places import files_of
from tests.unit.ingest.folders import cabinet, slide


@pytest.mark.blender
def test_folders_become_valid_bundles_and_a_second_run_keeps_them(tmp_path: Path) -> None:
    """One good folder (path with blanks), one without annotation, one zip: the run goes on, exits
    with 1, and the same command again makes nothing anew."""
    data, out = tmp_path / "my data", tmp_path / "out"
    cabinet().write(data / "45940")
    cabinet().write(data / "100")
    (data / "100/mobility_v2.json").unlink()
    (data / "7.zip").write_bytes(b"PK")
    words = [str(data), "--out", str(out), "--workers", "1"]
    assert partnet(words) == 1
    report = json.loads((out / "ingest_report.json").read_text())
    assert report["counts"] == {"valid": 1, "flawed": 0, "refused": 2}
    home = out / "assets/storage_furniture/pm_45940"
    assert validate_bundle(home).ok
    bundle = read_bundle(home)
    assert [part.label for part in bundle.parts] == ["base", "door", "drawer"]
    assert not licence_of(bundle.manifest).distributable
    assert "never handed on" in bundle.manifest["license"]
    before = (home / "manifest.json").stat().st_mtime_ns
    assert partnet(words) == 1
    assert (home / "manifest.json").stat().st_mtime_ns == before
    assert json.loads((out / "ingest_report.json").read_text()) == report
    assert export_partnet([str(home), "--out", str(tmp_path / "back")]) == 0
    assert (tmp_path / "back/pm_45940/mobility_v2.json").exists()
    note = json.loads((tmp_path / "back/pm_45940/artgen.json").read_text())
    assert note["licence"]["id"] == "LicenseRef-PartNet-Mobility"


@pytest.mark.blender
@pytest.mark.slow
def test_any_number_of_workers_and_a_resumed_run_make_the_same_bytes(tmp_path: Path) -> None:
    """Two objects by one process after the other, and side by side; then one is deleted and made
    anew, while the other is left as it is."""
    data, one, two = (tmp_path / name for name in ("data", "one", "two"))
    cabinet().write(data / "45940")
    cabinet(drawer=slide(0.0, 0.3)).write(data / "45941")
    words = [str(data), "--pieces", "0", "--out"]
    assert partnet([*words, str(one), "--workers", "1"]) == 0
    assert partnet([*words, str(two), "--workers", "2"]) == 0
    made = files_of(one / "assets")
    assert files_of(two / "assets") == made
    assert files_of(one)["ingest_report.json"] == files_of(two)["ingest_report.json"]
    homes = [two / f"assets/storage_furniture/pm_{name}" for name in ("45940", "45941")]
    assert {path.split("/")[1] for path in made} == {home.name for home in homes}
    kept = {path: path.stat().st_mtime_ns for path in homes[1].rglob("*")}
    shutil.rmtree(homes[0])
    assert partnet([*words, str(two), "--workers", "2"]) == 0
    assert files_of(two / "assets") == made
    assert {path: path.stat().st_mtime_ns for path in homes[1].rglob("*")} == kept
