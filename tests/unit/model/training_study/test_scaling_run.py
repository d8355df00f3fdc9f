"""A whole study of scaling on four objects: curves over objects and updates, beside the mean."""

from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.studies.table import read_table
from model.training_study.claims import DGIOU
from model.training_study.scaling import study
from model.training_study.scaling_page import CurveRow
from tests.unit.model.training_study.small_study import SMALL, small_library

OPTIONS = (
    *("--counts", "2", "4", "--steps", "4", "--points", "2", "--batch", "2", "--held-out", "2"),
    *("--seeds", "1", "--scenes", "1", "--device", "cpu"),
)


def scaling(library: Path, out: Path, *more: str) -> list[CurveRow]:
    assert study(["--library", str(library), "--out", str(out), *OPTIONS, *more]) == 0
    return read_table(out / "scaling.csv", CurveRow)


def test_curves_over_objects_and_updates(tmp_path: Path) -> None:
    """The last point of the curve over updates is the network of the run itself."""
    library = small_library(tmp_path)
    rows = scaling(library, tmp_path / "out", "--set", *SMALL)
    found = {(r.axis, r.series, r.x): r.mean for r in rows if r.metric == DGIOU}
    assert set(found) == {
        *(("objects", who, x) for who in ("network", "mean layout") for x in (2, 4)),
        *(("updates", "network", x) for x in (2, 4)),
    }
    assert found["updates", "network", 4] == found["objects", "network", 4]
    page = (tmp_path / "out" / "scaling.md").read_text()
    assert "2 of 2 runs are done" in page
    for picture in ("scaling_objects.png", "scaling_updates.png"):
        assert (tmp_path / "out" / picture).exists()
        assert picture in page
    before = (tmp_path / "out" / "scaling.csv").read_bytes()
    scaling(library, tmp_path / "out", "--dry", "--set", *SMALL)
    assert (tmp_path / "out" / "scaling.csv").read_bytes() == before


def test_what_was_not_run_is_told(tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert study(["--library", "none.npz", "--out", str(out), *OPTIONS, "--dry"]) == 0
    page = (out / "scaling.md").read_text()
    assert page.count("Not yet run.") == 2
    assert "0 of 2 runs are done" in page


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--counts", "4", "2"), "each larger than the one before"),
        (("--points", "0"), "--points 0 must be at least 1"),
        (("--steps", "5"), "5 steps do not divide into 2"),
    ],
)
def test_what_cannot_be_is_told(tmp_path: Path, words: tuple[str, ...], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        scaling(tmp_path / "library.npz", tmp_path, *words)
