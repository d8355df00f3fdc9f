"""Text numbers are exact and short."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.errors import ExportError
from artgen.export.numbers import exact, parsed, rows

finite = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(finite, min_size=1, max_size=6))
def test_text_reads_back_to_the_same_bits(values: list[float]) -> None:
    assert np.array(parsed(exact(values))).tobytes() == (np.array(values) + 0.0).tobytes()


@given(st.integers(-(10**9), 10**9))
def test_finished_vertices_print_short(steps: int) -> None:
    """1e-7 m is at most three digits before and seven after the point, sign and point: 12."""
    assert len(exact(round(steps / 1e7, 7))) <= 12


def test_negative_zero_prints_as_zero() -> None:
    assert exact((-0.0, 0.0)) == "0.0 0.0"


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_refused(value: float) -> None:
    with pytest.raises(ExportError, match="finite"):
        exact((0.0, value))


@given(st.lists(st.tuples(finite, finite), min_size=1, max_size=5))
def test_rows_are_exact(values: list[tuple[float, float]]) -> None:
    lines = list(rows("vt", np.array(values)))
    read = np.array([parsed(line.removeprefix("vt ")) for line in lines])
    assert read.tobytes() == (np.array(values) + 0.0).tobytes()
