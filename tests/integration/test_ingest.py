"""A run from folders to bundles, and back to folders."""

import json
from pathlib import Path

import pytest

from artgen.assembly.licence import licence_of
from artgen.export import read_bundle
from artgen.ingest.cli import partnet
from artgen.ingest.export_cli import partnet as export_partnet
from artgen.validate import validate_bundle
from tests.unit.ingest.folders import cabinet


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
