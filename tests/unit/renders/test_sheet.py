"""`artgen sheet`: one picture a category; what it prints names nothing that it takes away again."""

import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from PIL import Image

from artgen.core.errors import RuleError, UsageError
from artgen.pipeline import AssetTask, Outcome
from artgen.run_folder import RunFolder
from renders import sheet as sheets


def places_in(said: str) -> list[Path]:
    return [Path(word) for word in re.findall(r"\S*/\S*", said)]


def nothing_passes(folder: RunFolder, tasks: Sequence[AssetTask], *, workers: int) -> list[Outcome]:
    return [
        Outcome(asset_id=task.asset_id, status="failed", message="it falls over") for task in tasks
    ]


@pytest.mark.blender
def test_what_a_sheet_names_is_there_afterwards(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Found: it ended in a table of assets, summary and log in a folder deleted a moment later."""
    small = ["bucket", "--count", "2", "--size", "16", "--paths", "1", "--workers", "1"]
    assert sheets.sheet([*small, "--out", str(tmp_path / "sheets")]) == 0
    named = places_in(capsys.readouterr().out)
    assert named == [tmp_path / "sheets" / "bucket.jpg"]
    with Image.open(named[0]) as picture:
        assert picture.width > 4 * 16, "two assets side by side, each closed and open"


def test_a_category_of_which_nothing_passed_is_told_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sheets, "build_assets", nothing_passes)
    words = ["safe", "bucket", "--count", "1", "--work", str(tmp_path / "run")]
    assert sheets.sheet([*words, "--out", str(tmp_path / "sheets")]) == 1
    assert capsys.readouterr().out.splitlines() == [
        "failed safe_000000: it falls over",
        "failed bucket_000000: it falls over",
        "no sheet of safe: none of its 1 passed",
        "no sheet of bucket: none of its 1 passed",
        f"assets: {tmp_path / 'run'}",
    ]
    assert not (tmp_path / "sheets").exists()


@pytest.mark.parametrize(
    ("words", "error", "message"),
    [
        ([], UsageError, "found 0 categories"),
        (["safe", "--count", "0"], UsageError, "--count 0"),
        (["safe", "--workers", "0"], UsageError, "--workers 0"),
        (["saef"], RuleError, "did you mean 'safe'"),
    ],
)
def test_what_cannot_be_shown_is_refused_before_anything_is_made(
    words: list[str], error: type[Exception], message: str, tmp_path: Path
) -> None:
    with pytest.raises(error, match=re.escape(message)):
        sheets.sheet([*words, "--out", str(tmp_path / "sheets"), "--work", str(tmp_path / "run")])
    assert not list(tmp_path.iterdir())
