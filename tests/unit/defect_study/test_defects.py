"""Every kind of defect is caught in a small cupboard, and the sound cupboard passes."""

from pathlib import Path

import pytest

from artgen.defect_study.defect import Defect
from artgen.defect_study.rivals import PYTHON, verdicts
from artgen.defect_study.run import DEFECTS, FILES, foreign_copy, judged, planted
from artgen.export.layout import URDF
from tests.exported import write_without_blender
from tests.unit.validate.cabinet import cupboard


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sound") / "cupboard"
    folder.mkdir()
    return write_without_blender(cupboard(), folder)


@pytest.mark.parametrize("format_", FILES)
def test_the_sound_asset_passes_in_every_format(format_: str, sound: Path, tmp_path: Path) -> None:
    foreign_copy(sound, tmp_path / "copy")
    assert [str(finding) for finding in judged(tmp_path / "copy", format_).findings] == []


@pytest.mark.parametrize("defect", DEFECTS, ids=lambda defect: defect.name)
def test_the_defect_is_caught(defect: Defect, sound: Path, tmp_path: Path) -> None:
    assert planted(defect, sound, tmp_path / "copy"), "the cupboard has a place for every defect"
    assert judged(tmp_path / "copy", defect.format).findings


def test_names_are_unique_and_there_are_enough() -> None:
    names = [defect.name for defect in DEFECTS]
    assert len(set(names)) == len(names) >= 60


def test_a_checker_that_dies_refuses_and_goes_on(sound: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.urdf"
    bad.write_text("<robot>")
    said = verdicts("MuJoCo", [sound / URDF, bad, sound / URDF])
    assert said is not None
    assert said[sound / URDF] == ""
    assert said[bad] != ""
    assert "MuJoCo" in PYTHON
