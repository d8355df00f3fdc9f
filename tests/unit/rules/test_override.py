"""Parameters set from outside: what is set is what is drawn, all else stays, faults are told."""

from dataclasses import asdict

import pytest

from artgen.core.errors import RuleError, UsageError
from artgen.core.stream import Stream
from artgen.generators import load_builder
from artgen.pipeline import plan
from artgen.rules import load_rule, overridden, parse_override, sample
from artgen.rules.sample import Sampled

RULE = load_rule("dishwasher")
BUILDER = load_builder("dishwasher")


def drawn(*words: str, index: int = 0) -> Sampled:
    return sample(
        overridden(RULE, [parse_override(word) for word in words]),
        Stream(5, "dishwasher", index),
        params_type=BUILDER.params_type,
        invariants=BUILDER.invariants,
    )


def test_what_is_set_is_drawn_and_all_else_stays() -> None:
    """`blades` takes part in no invariant, so that no draw is made anew."""
    before, after = drawn(), drawn("dishwasher.blades=3")
    assert after.params.blades == 3
    assert asdict(after.params) | {"blades": before.params.blades} == asdict(before.params)
    assert after.surfaces == before.surfaces


def test_values_have_the_type_that_the_builder_expects() -> None:
    """A whole number for a length in meters is a float in the params."""
    assert drawn("dishwasher.opening_deg=90").params.opening_deg == 90.0
    assert isinstance(drawn("dishwasher.opening_deg=90").params.opening_deg, float)
    assert drawn("dishwasher.slim=true").params.slim is True
    assert drawn("dishwasher.form=built_under").params.form == "built_under"


def test_a_table_narrows_the_range() -> None:
    for index in range(8):
        params = drawn("dishwasher.depth={ uniform = [0.60, 0.601] }", index=index).params
        assert 0.60 <= params.depth < 0.601


def test_surfaces_can_be_set() -> None:
    for index in range(8):
        front = drawn("dishwasher.surfaces.front=enamel_black", index=index).surfaces["front"]
        assert front.recipe == "enamel"


def test_the_digest_tells_overrides_apart() -> None:
    one, other = (overridden(RULE, [parse_override(f"dishwasher.blades={k}")]) for k in (2, 3))
    assert len({one.digest, other.digest, RULE.digest}) == 3
    assert overridden(RULE, []).digest == RULE.digest
    assert overridden(RULE, [parse_override("laptop.width=0.3")]) is RULE


@pytest.mark.parametrize(
    ("word", "told"),
    [
        ("blades", "expected CATEGORY.KEY=VALUE"),
        ("dishwasher=3", "expected CATEGORY.KEY=VALUE"),
        ("dishwasher.blades=", "expected CATEGORY.KEY=VALUE"),
        ("dishwasher.baldes=3", "has no 'baldes' (did you mean 'blades'?)"),
        ("dishwasher.blades=4", "4 is none of 2, 3"),
        ("dishwasher.blades=3.0", "3.0 is none of 2, 3"),
        ("dishwasher.beads=9", "9 is no whole number in [2, 4]"),
        ("dishwasher.beads=2.5", "2.5 is no whole number in [2, 4]"),
        ("dishwasher.beads=true", "True is no whole number in [2, 4]"),
        ("dishwasher.depth=0.7", "0.7 is no number in [0.588, 0.606]"),
        ("dishwasher.depth=nan", "is no number in [0.588, 0.606]"),
        ("dishwasher.depth=deep", "'deep' is no number in [0.588, 0.606]"),
        ("dishwasher.slim=1", "1 is neither true nor false"),
        ("dishwasher.depth={ uniform = [0.7, 0.6] }", "write the smaller bound first"),
        ("dishwasher.depth={ unifrom = [0.5, 0.6] }", "did you mean 'uniform'"),
        ("dishwasher.depth={ uniform = [0.5", "is not TOML"),
        ("dishwasher.surfaces.fornt=oak", "did you mean 'front'"),
        ("dishwasher.surfaces.front=walnut", "'walnut' is none of 'stainless_brushed'"),
    ],
)
def test_faults_are_told_with_the_word_and_the_bound(word: str, told: str) -> None:
    with pytest.raises(RuleError) as error:
        overridden(RULE, [parse_override(word)])
    assert told in str(error.value)
    assert f"--set {word}" in str(error.value)


def test_an_override_of_a_category_that_is_not_made_is_refused() -> None:
    with pytest.raises(UsageError, match="'laptop' is not among the categories made: dishwasher"):
        plan(["dishwasher"], 1, 0, overrides=[parse_override("laptop.width=0.3")])
