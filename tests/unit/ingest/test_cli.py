"""What users may say to `artgen ingest`."""

from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.ingest.cli import read_rests
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
