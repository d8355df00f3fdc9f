"""Each hard case holds to its bound, and what happens outside it is seen."""

from pathlib import Path

import pytest

from tests.hard_cases import dynamics, geometry
from tests.hard_cases.case import HardCase

CASES = (*dynamics.CASES, *geometry.CASES)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_the_case_holds_to_its_bound(case: HardCase) -> None:
    assert case.error() <= case.bound


@pytest.mark.parametrize("case", [c for c in CASES if c.seen], ids=lambda case: case.name)
def test_what_happens_outside_is_seen(case: HardCase) -> None:
    assert case.seen is not None
    assert case.seen()


def test_the_page_tells_every_case() -> None:
    page = (Path(__file__).parents[2] / "docs" / "hard_cases.md").read_text(encoding="utf-8")
    for case in CASES:
        assert all(text in page for text in (case.reason, case.derived, case.outside))
