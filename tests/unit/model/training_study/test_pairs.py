"""Paired differences: closed forms, missing values, and which way is better."""

import numpy as np
import pytest

from artgen.core.stream import Stream
from model.training_study.claims import DGIOU, LINE, TYPE
from model.training_study.pairs import crossed_interval, difference
from model.training_study.scores import Score

STREAM = Stream(0, "pairs")


def score(metric: str, **values: float) -> Score:
    return Score(metrics={metric: values}, objects=len(values), failures={})


def test_the_mean_is_over_what_both_have() -> None:
    arm = {0: score(DGIOU, a=1.0, b=2.0, c=9.0), 1: score(DGIOU, a=3.0), 7: score(DGIOU, a=50.0)}
    other = {0: score(DGIOU, a=0.5, b=1.0), 1: score(DGIOU, a=1.0, b=4.0)}
    found = difference(DGIOU, arm, other, STREAM)
    assert found is not None
    assert found.mean == pytest.approx((0.5 + 1.0 + 2.0) / 3.0)
    assert found.by_seed == {0: pytest.approx(0.75), 1: pytest.approx(2.0)}
    assert found.objects == 2


def test_nothing_shared_is_nothing() -> None:
    assert difference(DGIOU, {0: score(DGIOU, a=1.0)}, {1: score(DGIOU, a=1.0)}, STREAM) is None
    assert difference(LINE, {0: score(DGIOU, a=1.0)}, {0: score(DGIOU, a=1.0)}, STREAM) is None


def test_a_constant_difference_has_no_width() -> None:
    table = np.full((3, 5), 0.25)
    assert crossed_interval(table, STREAM) == pytest.approx((0.25, 0.25))


def test_one_seed_gives_the_interval_over_objects() -> None:
    """Normal theory: 1.96 standard errors. 2000 draws place a 2.5 % quantile within some 5 % of a
    standard error; 400 values, their own deviation within 4 %."""
    values = Stream(1, "normal").generator().normal(2.0, 1.0, (1, 400))
    lower, upper = crossed_interval(values, STREAM)
    width = 2.0 * 1.96 * values.std() / 20.0
    assert upper - lower == pytest.approx(width, rel=0.1)
    assert (lower + upper) / 2.0 == pytest.approx(values.mean(), abs=0.1 * width)


def test_seeds_that_disagree_widen_the_interval() -> None:
    objects = Stream(2, "objects").generator().normal(0.0, 0.1, 50)
    alike = np.stack([objects, objects, objects])
    apart = alike + np.array([[-0.5], [0.0], [0.5]])
    narrow, wide = crossed_interval(alike, STREAM), crossed_interval(apart, STREAM)
    assert wide[1] - wide[0] > 5.0 * (narrow[1] - narrow[0])


def test_unknown_values_count_nothing() -> None:
    table = np.array([[1.0, np.nan, 1.0], [np.nan, 1.0, 1.0]])
    assert crossed_interval(table, STREAM) == pytest.approx((1.0, 1.0))


@pytest.mark.parametrize(
    ("metric", "sign", "finding"),
    [(DGIOU, 1.0, "worse"), (DGIOU, -1.0, "better"), (TYPE, 1.0, "better"), (TYPE, -1.0, "worse")],
)
def test_findings_follow_the_metrics_own_direction(metric: str, sign: float, finding: str) -> None:
    arm = {0: score(metric, a=sign, b=sign)}
    found = difference(metric, arm, {0: score(metric, a=0.0, b=0.0)}, STREAM)
    assert found is not None
    assert found.finding == finding


def test_an_interval_about_zero_tells_nothing_apart() -> None:
    arm = {0: score(DGIOU, a=1.0, b=-1.0, c=0.5)}
    found = difference(DGIOU, arm, {0: score(DGIOU, a=0.0, b=0.0, c=0.0)}, STREAM)
    assert found is not None
    assert found.finding == "not told apart"
