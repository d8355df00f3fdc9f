"""Runs of `artgen assemble`: processes side by side, and one that was interrupted."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from artgen.assembly.build import sharp
from artgen.assembly.cli import assemble
from artgen.assembly.harvest import embedded, made_source
from artgen.assembly.library import write_library
from tests.integration.places import files_of

COUNTS = {"storage_furniture": 2, "cabinet": 2}


@pytest.fixture
def library(tmp_path: Path) -> Path:
    """Sharp, and of one family, so that all sources lie in one split."""
    sources = [made_source(made, sharp) for made in embedded(COUNTS)]
    folder = tmp_path / "library"
    write_library(folder, [replace(s, family="cabinet_6_000000") for s in sources], recipe={})
    return folder


@pytest.mark.blender
@pytest.mark.slow
def test_any_number_of_workers_and_a_resumed_run_make_the_same_bytes(
    library: Path, tmp_path: Path
) -> None:
    """Three objects by one process and by two; then one is deleted and made anew, while the others
    are left as they are."""
    one, two = tmp_path / "one", tmp_path / "two"
    words = ["storage_furniture", "--count", "3", "--seed", "5", "--library", str(library), "--out"]
    assert assemble([*words, str(one), "--workers", "1"]) == 0
    assert assemble([*words, str(two), "--workers", "2"]) == 0
    made = files_of(one / "assets")
    assert {path.split("/")[1] for path in made} == {"000000", "000001", "000002"}
    assert files_of(two / "assets") == made
    home = two / "assets/assembled/000001"
    shutil.rmtree(home)
    kept = {path: path.stat().st_mtime_ns for path in (two / "assets").rglob("*.*")}
    assert assemble([*words, str(two), "--workers", "2"]) == 0
    assert files_of(two / "assets") == made
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
