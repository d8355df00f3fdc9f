"""A whole study of ablations on four objects: it resumes, divides, and says what was not run."""

from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.studies.table import read_table
from model.training_study import runs
from model.training_study.ablations import study
from model.training_study.claims import ARMS
from model.training_study.course import Course
from model.training_study.prices import updates_price
from model.training_study.rows import ClaimRow, ScoreRow
from tests.unit.model.training_study.small_study import FEW_RAYS, SMALL, small_library

OPTIONS = (
    *("--steps", "2", "--batch", "2", "--objects", "4", "--held-out", "2", "--scenes", "1"),
    *("--device", "cpu", "--seeds", "2"),
)


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_library(tmp_path_factory.mktemp("study"))


def ablations(library: Path, out: Path, *more: str) -> None:
    assert study(["--library", str(library), "--out", str(out), *OPTIONS, *more]) == 0


def test_a_study_resumes_and_tells_what_was_not_run(
    library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = ("--claims", "order", "--set", *SMALL)
    ablations(library, tmp_path, *words, "--share", "1/2")
    page = (tmp_path / "ablations.md").read_text()
    assert "2 of 4 are done" in page
    assert "| Parts have a canonical order | `shuffled` less `boxes` | dgIoU | - |" in page
    ablations(library, tmp_path, *words)
    page = (tmp_path / "ablations.md").read_text()
    assert "4 of 4 are done" in page
    assert "`first_rest` less `boxes`: not yet run." in page
    rows = read_table(tmp_path / "ablations_claims.csv", ClaimRow)
    order = [row for row in rows if row.claim == "order"]
    assert {(row.seeds, row.objects) for row in order if "line" not in row.metric} == {(2, 2)}
    assert {row.verdict for row in rows if row.claim == "views"} == {"not yet run"}
    scores = read_table(tmp_path / "ablations.csv", ScoreRow)
    assert {(row.arm, row.seed) for row in scores} == {
        (arm, seed) for arm in ("boxes", "shuffled") for seed in (0, 1)
    }
    assert (tmp_path / "ablations.png").exists()

    def never(*_: object, **__: object) -> Path:
        raise AssertionError("nothing is left to train")

    monkeypatch.setattr(runs, "trained", never)
    before = (tmp_path / "ablations_claims.csv").read_bytes()
    ablations(library, tmp_path, *words)
    assert (tmp_path / "ablations_claims.csv").read_bytes() == before


def test_arms_with_shapes_are_judged_by_images(library: Path, tmp_path: Path) -> None:
    words = ("--claims", "part_loss", "pretraining", "--seeds", "1", "--set", *SMALL, *FEW_RAYS)
    ablations(library, tmp_path, *words, "--steps", "4")
    rows = {
        (row.arm, row.metric): row
        for row in read_table(tmp_path / "ablations_claims.csv", ClaimRow)
    }
    for arm in ("composite", "pretrained"):
        assert rows[arm, "images.psnr"].objects == 2
    assert rows["composite", "masks.nearest.moving"].objects == 2


def test_other_settings_in_the_same_folder_are_refused(library: Path, tmp_path: Path) -> None:
    words = ("--claims", "images", "--seeds", "1", "--set", *SMALL)
    ablations(library, tmp_path, *words)
    for score in tmp_path.rglob("score.json"):
        score.unlink()
    with pytest.raises(UsageError, match=r"other settings: config\.train\.clip_norm"):
        ablations(library, tmp_path, *words, "train.clip_norm=3")


def test_nothing_is_trained_when_dry(library: Path, tmp_path: Path) -> None:
    ablations(library, tmp_path, "--dry")
    assert "0 of 24 are done" in (tmp_path / "ablations.md").read_text()
    assert not (tmp_path / "cells").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--claims", "ordre"), "no such claim.*'order'"),
        (("--seeds", "0"), "--seeds 0"),
        (("--share", "3/2"), "expected K/N"),
    ],
)
def test_what_cannot_be_is_told(
    library: Path, tmp_path: Path, words: tuple[str, ...], message: str
) -> None:
    with pytest.raises(UsageError, match=message):
        ablations(library, tmp_path, *words)


def test_prices_are_measured_and_summed(
    library: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Static pre-training renders from its first update, so its run costs more than the usual
    one's share; nothing is written."""
    words = ("--claims", "pretraining", "--set", *SMALL, *FEW_RAYS)
    ablations(library, tmp_path, "--price", *words, "--steps", "4")
    said = capsys.readouterr().out
    assert "| `shapes` |" in said
    assert "| `pretrained` |" in said
    assert "2 seeds: 0.0 h" in said
    assert list(tmp_path.iterdir()) == []


def test_a_run_costs_its_casting_and_its_updates() -> None:
    """Two fifths of the updates of `nano` do not render; pre-training renders from the first."""
    course = Course(size="nano", steps=100, batch=8, scenes=None)
    stages = [
        course.cell(ARMS[name], Path("l.npz"), seed=0).stages for name in ("shapes", "pretrained")
    ]
    assert updates_price(stages[0][-1], 1.0, 3.0) == pytest.approx(40 * 1.0 + 60 * 3.0)
    assert updates_price(stages[1][0], 1.0, 3.0) == pytest.approx(25 * 3.0)
