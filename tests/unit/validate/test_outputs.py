"""What a run writes: verdicts that resume, JUnit XML and a page that stand alone; nothing beside
the assets."""

import json
import shutil
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from artgen.validate import validate_bundle
from artgen.validate.batch import Judgement, Task, judge
from artgen.validate.bounds import shipped_bounds
from artgen.validate.cli import validate
from artgen.validate.junit import junit_xml
from artgen.validate.levels import Selection
from artgen.validate.page import page
from artgen.validate.report import Finding, Report, Skipped
from artgen.validate.subject import Source
from tests.unit.validate.cabinet import cupboard, write_quick_bundle

HOSTILE = "<script>alert(1)</script>\x00"
FINDING = Finding(
    check="mesh.size", part=HOSTILE, value=HOSTILE, bound="1", cause="big & bad", remedy="cut"
)
SKIPPED = Skipped(name="mesh.glb", reason="no <manifest>")
REPORT = Report(
    asset=HOSTILE, findings=(FINDING,), skipped=(SKIPPED,), judged=("mesh.size", "mesh.closed")
)


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_quick_bundle(cupboard(), tmp_path_factory.mktemp("sound") / "bundle")


@pytest.fixture
def spoilt(sound: Path, tmp_path: Path) -> Path:
    """A bundle whose URDF reaches nowhere."""
    shutil.copytree(sound, tmp_path / "in" / "bundle")
    (tmp_path / "in" / "bundle" / "asset.glb").unlink()
    return tmp_path / "in" / "bundle"


def bytes_below(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_run_writes_what_it_is_told_to_and_nothing_beside_the_assets(
    spoilt: Path, tmp_path: Path
) -> None:
    before, out = bytes_below(spoilt), tmp_path / "out"
    places = ["--out", out, "--junit", out / "j.xml", "--html", out / "p.html"]
    assert validate([str(spoilt), "--workers", "1", *map(str, places)]) == 1
    assert bytes_below(spoilt) == before
    stated = json.loads((out / "report.json").read_text())
    assert [asset["ok"] for asset in stated["assets"]] == [False]
    assert stated["bounds"]["overlap"]["reason"] == shipped_bounds().overlap.reason
    suite = ET.parse(out / "j.xml").getroot().find("testsuite")
    assert suite is not None
    assert suite.get("failures") == "1"
    assert "asset.glb" in (out / "p.html").read_text()


def task(folder: Path, kept: Path, **changed: object) -> Task:
    source = Source(format="bundle", file=folder / "manifest.json", root=folder)
    plain = {"selection": Selection(), "bounds": shipped_bounds(), "kept": kept, "drawn": False}
    return Task(source=source, **{**plain, **changed})  # type: ignore[arg-type]


def test_a_verdict_is_kept_until_bytes_bounds_or_selection_change(
    sound: Path, tmp_path: Path
) -> None:
    shutil.copytree(sound, tmp_path / "b")
    folder, kept = tmp_path / "b", tmp_path / "kept"
    assert [judge(task(folder, kept)).again for _ in range(2)] == [False, True]
    assert judge(task(folder, kept)).report == validate_bundle(folder)
    quick = Selection(profile="quick")
    assert not judge(task(folder, kept, selection=quick)).again
    with (folder / "asset.urdf").open("a") as stream:
        stream.write("\n")
    changed = judge(task(folder, kept))
    assert not changed.again
    assert not changed.report.ok


def test_a_result_that_was_cut_short_is_made_anew(sound: Path, tmp_path: Path) -> None:
    judge(task(sound, tmp_path))
    (place,) = tmp_path.iterdir()
    place.write_bytes(place.read_bytes()[:40])
    assert not judge(task(sound, tmp_path)).again


def test_junit_counts_what_ran_failed_and_did_not_run() -> None:
    root = ET.fromstring(junit_xml({"a/b": REPORT, "c": REPORT}))
    assert (root.get("tests"), root.get("failures"), root.get("skipped")) == ("6", "2", "2")
    suites = root.findall("testsuite")
    cases = {case.get("name"): [child.tag for child in case] for case in suites[0]}
    assert cases == {"size": ["failure"], "closed": [], "glb": ["skipped"]}


def test_a_page_is_inert_whatever_assets_call_themselves() -> None:
    source = Source(format="urdf", file=Path("x.urdf"), root=Path())
    text = page([(HOSTILE, Judgement(source=source, report=REPORT))])
    assert "<script" not in text
    assert "http://" not in text.replace("http-equiv", "")
    assert "&lt;script&gt;" in text
    assert "default-src 'none'" in text
