"""When a claim reproduces: the interval, its side, and how many seeds agree."""

import pytest

from artgen.core.stream import Stream
from model.training_study.claims import DGIOU, Comparison, Expected
from model.training_study.pairs import difference
from model.training_study.rows import told, verdict
from model.training_study.scores import Score


def found(*by_seed: float) -> str:
    return said("worse", *by_seed)


def said(expected: Expected, *by_seed: float) -> str:
    arm, other = (
        {
            seed: Score(metrics={DGIOU: {"a": value, "b": value}}, objects=2, failures={})
            for seed, value in enumerate(values)
        }
        for values in (by_seed, [0.0] * len(by_seed))
    )
    own = Comparison(arm="shuffled", against="boxes", expected=expected)
    return verdict(own, difference(DGIOU, arm, other, Stream(0)))


def test_a_claim_needs_three_seeds_of_one_sign() -> None:
    assert found() == "not yet run"
    assert found(0.1, 0.1) == "not told apart"
    assert found(0.1, 0.1, 0.1) == "reproduces"
    assert found(0.1, 0.1, -0.01) == "not told apart"
    assert found(-0.1, -0.1, -0.2) == "reversed"


def test_where_nobody_claims_anything_the_finding_stands() -> None:
    assert said("open", 0.1, 0.1, 0.2) == "worse"
    assert said("better", -0.1, -0.1, -0.2) == "reproduces"


@pytest.mark.parametrize(("value", "text"), [(None, "-"), (0.01234, "+0.0123"), (-0.5, "-0.5000")])
def test_differences_bear_their_sign(value: float | None, text: str) -> None:
    assert told(DGIOU, value) == text
