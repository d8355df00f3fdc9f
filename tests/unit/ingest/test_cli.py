"""What users may say to `artgen ingest`, and what they are told."""

import json
from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.ingest.cli import IngestPartnet, checked_options, partnet, read_rests, static, urdf
from artgen.ingest.options import GivenRest


def test_a_table_of_rests_is_read(tmp_path: Path) -> None:
    (tmp_path / "r.json").write_text('{"45940": {"3": 90}}')
    assert read_rests(tmp_path / "r.json") == (GivenRest(id="45940", number="3", q=90.0),)


@pytest.mark.parametrize("q", ["NaN", "Infinity", "1e999", '"nan"', '"90"', "true", "null"])
def test_a_rest_that_is_no_finite_number_is_refused(q: str, tmp_path: Path) -> None:
    """JSON as Python reads it holds NaN, which closed a door nowhere."""
    (tmp_path / "r.json").write_text(f'{{"45940": {{"3": {q}}}}}')
    with pytest.raises(UsageError, match=r"is no finite number.*write"):
        read_rests(tmp_path / "r.json")


@pytest.mark.parametrize("option", ["--density", "--thickness", "--meters-per-unit", "--turn"])
@pytest.mark.parametrize("value", ["inf", "nan"])
def test_a_number_that_is_none_is_refused(option: str, value: str, tmp_path: Path) -> None:
    """Infinity was above 0: an object of infinite mass."""
    with pytest.raises(UsageError, match=option):
        urdf([str(tmp_path), option, value, "--out", str(tmp_path / "out")])
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("word", ["BSD-3-Clause", "CC-BY-NC-SA-4.0"])
def test_licences_that_robots_and_scans_come_under_can_be_named(word: str) -> None:
    assert checked_options(IngestPartnet(licence=word)).licence == word
    with pytest.raises(UsageError, match="known:"):
        checked_options(IngestPartnet(licence=f"{word}x"))


def test_a_run_that_found_nothing_is_no_success(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`0 objects`, exit code 0."""
    (tmp_path / "data").mkdir()
    (tmp_path / "data/readme.txt").write_text("")
    assert partnet([str(tmp_path / "data"), "--out", str(tmp_path / "out")]) == 1
    assert "holds no object folder" in capsys.readouterr().out


def test_extensions_may_be_written_large(tmp_path: Path) -> None:
    """`--extensions .GLB` found nothing. This file is none, so that no process is started."""
    (tmp_path / "data").mkdir()
    (tmp_path / "data/a.GLB").symlink_to(tmp_path / "nowhere")
    words = [str(tmp_path / "data"), "--extensions", ".GLB", "--out", str(tmp_path / "out")]
    assert static(words) == 1
    report = json.loads((tmp_path / "out/ingest_report.json").read_text())
    assert [entry["message"] for entry in report["entries"]] == ["is a link that leads nowhere"]
