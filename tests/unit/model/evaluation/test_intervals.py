"""Bootstrap intervals: against theory, by clusters, reproducible."""

import math

import numpy as np
import pytest

from artgen.core.stream import Stream
from model.evaluation.intervals import estimate

STREAM = Stream(0, "test")


def test_a_mean_has_the_interval_of_its_standard_error() -> None:
    """For 400 values the percentile interval is 1.96 deviations wide on each side; with 2000 draws
    its ends have a deviation of about 2 % of the width, so 10 % is beyond chance."""
    values = np.random.Generator(np.random.PCG64(1)).normal(3.0, 2.0, 400)
    found = estimate([[float(v)] for v in values], STREAM)
    half = 1.96 * values.std() / math.sqrt(400)
    assert found.mean == pytest.approx(values.mean(), abs=1e-12)
    assert found.upper is not None
    assert found.lower is not None
    assert found.upper - values.mean() == pytest.approx(half, rel=0.1)
    assert values.mean() - found.lower == pytest.approx(half, rel=0.1)


def test_values_of_one_object_are_drawn_together() -> None:
    """Ten copies of each value bring no information: the interval stays that of the objects."""
    values = np.random.Generator(np.random.PCG64(2)).normal(0.0, 1.0, 50).tolist()
    alone, copied = (estimate([[v] * n for v in values], STREAM) for n in (1, 10))
    assert copied.lower == pytest.approx(alone.lower, abs=1e-12)
    assert copied.upper == pytest.approx(alone.upper, abs=1e-12)
    assert (copied.values, copied.objects) == (500, 50)


def test_few_objects_have_no_interval() -> None:
    assert estimate([], STREAM).mean is None
    one = estimate([[1.0, 3.0], []], STREAM)
    assert (one.mean, one.median, one.lower, one.objects) == (2.0, 2.0, None, 1)


def test_the_same_again() -> None:
    values = [[1.0], [2.0], [4.0]]
    assert estimate(values, STREAM) == estimate(values, STREAM)
