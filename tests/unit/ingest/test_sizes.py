"""Scales: given, stated, assumed."""

import numpy as np
import pytest

from artgen.core.errors import IngestError
from artgen.ingest.sizes import SIZES, chosen_scale

EXTENT = np.array([2.0, 1.0, 4.0])


@pytest.mark.parametrize(
    ("given", "stated", "expected"),
    [(0.1, 0.2, 0.1), (None, 0.2, 0.2), (None, None, 1.75 / 4.0)],
)
def test_the_user_counts_more_than_the_source_and_that_more_than_a_guess(
    given: float | None, stated: float | None, expected: float
) -> None:
    found = chosen_scale("Refrigerator", EXTENT, given=given, stated=stated)
    assert found.meters_per_unit == expected


def test_an_unknown_category_is_said_to_be_one() -> None:
    found = chosen_scale("Contraption", EXTENT, given=None, stated=None)
    assert found.meters_per_unit * 4.0 == pytest.approx(0.6, rel=1e-15)
    assert "unknown" in found.reason


def test_spellings_of_a_category_are_one() -> None:
    scales = {
        chosen_scale(word, EXTENT, given=None, stated=None).meters_per_unit
        for word in ("StorageFurniture", "storage_furniture", "storage furniture")
    }
    assert len(scales) == 1


@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf")])
def test_scales_that_are_none_are_refused(value: float) -> None:
    with pytest.raises(IngestError, match="expected > 0"):
        chosen_scale("Door", EXTENT, given=value, stated=None)


def test_all_46_categories_have_a_size_between_a_lighter_and_a_door() -> None:
    assert len(SIZES) == 46
    assert all(0.05 <= size.meters <= 2.2 for size in SIZES.values())
