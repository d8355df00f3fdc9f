"""`artgen evaluate` from folders to a report, and again."""

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from artgen.core.errors import ModelError, UsageError
from model.evaluation.cli import evaluate
from model.evaluation.metrics import METRICS
from tests.unit.model.evaluation.adapters.outputs import (
    write_paris,
    write_singapo,
    write_urdf,
)

OPTIONS = ["--points", "200", "--part-points", "200", "--mask-pixels", "16", "--workers", "1"]


@pytest.fixture
def folders(tmp_path: Path) -> Path:
    """SINGAPO's trees as truth; URDFs as predictions, of which one is missing and one broken."""
    for name in ("a", "b", "c"):
        write_singapo(tmp_path / "truth" / name)
    write_urdf(tmp_path / "guess" / "a")
    broken = tmp_path / "guess" / "b" / "b.urdf"
    broken.parent.mkdir(parents=True)
    broken.write_text("<robot", encoding="utf-8")
    for side, shade in (("truth", 255), ("guess", 128)):
        place = tmp_path / side / "a" / "images"
        place.mkdir()
        Image.fromarray(np.full((16, 16, 3), shade, np.uint8)).save(place / "0.png")
    return tmp_path


def run(folder: Path, *more: str) -> dict[str, object]:
    out = folder / "out"
    arguments = [str(folder / "guess"), "--truth", str(folder / "truth"), "--out", str(out)]
    assert evaluate([*arguments, *OPTIONS, *more]) == 0
    found: dict[str, object] = json.loads((out / "evaluation.json").read_text(encoding="utf-8"))
    return found


def test_one_command_makes_a_json_and_a_page(folders: Path) -> None:
    found = run(folders)
    summary = found["summary"]
    assert isinstance(summary, dict)
    assert set(summary["overall"]) == set(METRICS)
    assert set(summary["failures"]) == {"b", "c"}
    assert summary["overall"]["images.psnr"]["mean"] == pytest.approx(6.06, abs=0.01)
    assert summary["overall"]["images.lpips"]["mean"] is None
    page = (folders / "out" / "report.html").read_text(encoding="utf-8")
    assert "http" not in re.sub(r"http-equiv", "", page)  # Nothing is fetched.
    assert page.count("data:image/png;base64,") == 1
    assert "SINGAPO (paper)" in page
    assert "no prediction of that name" in page

    before = (folders / "out" / "evaluation.json").read_bytes()
    stamp = (folders / "out" / "objects" / "a.json").stat().st_mtime_ns
    run(folders)
    assert (folders / "out" / "evaluation.json").read_bytes() == before
    assert (folders / "out" / "objects" / "a.json").stat().st_mtime_ns == stamp

    with pytest.raises(UsageError, match="choose another --out"):
        run(folders, "--align", "uniform")
    shutil.copytree(folders / "guess" / "a", folders / "guess" / "c")
    found = run(folders)
    assert isinstance(found["summary"], dict)
    assert set(found["summary"]["failures"]) == {"b"}


def test_a_folder_of_something_else_is_not_touched(folders: Path) -> None:
    (folders / "mine").mkdir()
    (folders / "mine" / "notes.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(UsageError, match=r"holds notes\.txt already"):
        run(folders, "--out", str(folders / "mine"))
    with pytest.raises(UsageError, match="is a file"):
        run(folders, "--out", str(folders / "mine" / "notes.txt"))


def test_names_that_do_not_meet_are_told(folders: Path) -> None:
    (folders / "guess" / "a").rename(folders / "guess" / "x")
    shutil.rmtree(folders / "guess" / "b")
    with pytest.raises(UsageError, match="name predictions as the true objects are named"):
        run(folders)
    with pytest.raises(UsageError, match="expected at least 100"):
        run(folders, "--points", "3")


def test_every_system_may_bring_a_bad_object(tmp_path: Path) -> None:
    """The good one is scored, the bad ones are told, the run ends well."""
    for name in ("a", "b", "c"):
        write_singapo(tmp_path / "truth" / name)
        write_paris(tmp_path / "guess" / name, "rotate")
    motion = "it20000_test_motion.json"
    (tmp_path / "guess" / "b" / motion).write_text("{}", encoding="utf-8")
    (tmp_path / "truth" / "c" / "object.json").write_text('{"arti_tree": []}', encoding="utf-8")
    found = run(tmp_path)
    summary = found["summary"]
    assert isinstance(summary, dict)
    assert set(summary["failures"]) == {"b", "c"}
    assert f"b/{motion}: motion states no type" in summary["failures"]["b"]
    # Two joints each of a and b, of which one is found to turn; c counts nowhere.
    assert summary["overall"]["joints.nearest.type_right"]["values"] == 4
    assert summary["overall"]["gates.passed"]["mean"] is None  # PARIS states no simulation.
    assert found["notes"] == ["1 true objects cannot be read and count nowhere: c."]


def test_results_of_other_options_are_not_overwritten(folders: Path) -> None:
    run(folders, "--no-gates")
    with pytest.raises(UsageError, match="choose another --out"):
        run(folders, "--gates")
    with pytest.raises(UsageError, match="choose another --out"):
        run(folders, "--no-gates", "--format", "urdf")
    (folders / "out" / "run.json").write_text("{", encoding="utf-8")
    with pytest.raises(UsageError, match="choose another --out"):
        run(folders, "--no-gates")


def test_weights_that_are_none_are_told_before_anything_is_scored(folders: Path) -> None:
    with pytest.raises(ModelError, match="LPIPS needs trunk and heads"):
        run(folders, "--lpips", str(folders))
    assert not (folders / "out").exists()
