"""The front against its definition, and tables that survive a round trip."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.errors import UsageError
from artgen.studies.front import pareto_front
from artgen.studies.table import markdown_table, read_table, write_table

POINT = st.tuples(st.integers(0, 6), st.integers(0, 6))


@given(st.lists(POINT, min_size=1, max_size=20))
def test_the_front_is_what_nothing_beats(points: list[tuple[int, int]]) -> None:
    front = pareto_front([c for c, _ in points], [e for _, e in points])
    for k, (cost, error) in enumerate(points):
        beaten = any(
            (c <= cost and e <= error and (c < cost or e < error))
            or ((c, e) == (cost, error) and j < k)
            for j, (c, e) in enumerate(points)
        )
        assert front[k] == (not beaten)


def test_what_diverged_is_never_on_the_front() -> None:
    assert pareto_front([1.0, 2.0], [np.nan, np.inf]).tolist() == [False, False]


@dataclass(frozen=True, kw_only=True)
class Line:
    name: str
    size: int
    error: float
    cap: int | None
    good: bool
    kind: Literal["wide", "deep"] = "wide"


def test_a_table_survives_a_round_trip(tmp_path: Path) -> None:
    rows = [
        Line(name="a", size=3, error=0.125, cap=None, good=True),
        Line(name="b, c", size=4, error=float("inf"), cap=8, good=False, kind="deep"),
    ]
    write_table(tmp_path / "t.csv", rows)
    assert read_table(tmp_path / "t.csv", Line) == rows


def test_a_missing_or_foreign_table_says_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="run the study"):
        read_table(tmp_path / "none.csv", Line)
    (tmp_path / "t.csv").write_text("x,y\n1,2\n")
    with pytest.raises(UsageError, match="columns x, y, expected name"):
        read_table(tmp_path / "t.csv", Line)


def test_a_page_table_has_a_rule_under_its_header() -> None:
    assert markdown_table(["a", "b"], [["1", "2"]]) == "| a | b |\n| --- | --- |\n| 1 | 2 |"
