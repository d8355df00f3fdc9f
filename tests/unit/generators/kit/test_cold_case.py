"""The cases of refrigerators: whatever their height, what is on them can be built."""

import numpy as np
import pytest

from artgen.core.stream import Stream
from artgen.generators import load_builder
from artgen.generators.kit.cold_case import BEND, ColdCase, legs_that_fit
from artgen.rules import load_rule, sample


def case_of_height(top: float) -> ColdCase:
    return ColdCase(
        half=0.25, depth=0.5, foot=0.03, top=top, toe_height=0.06, toe_depth=0.04,
        wall=0.045, niche=(0.17, 0.19), density=140.0,
    )  # fmt: skip


@pytest.mark.parametrize("legs", [8, 10])
@pytest.mark.parametrize("top", np.linspace(0.40, 0.90, 11))
def test_a_coil_fits_cases_of_any_height(top: float, legs: int) -> None:
    """A room of 0.04 m up to one of 0.54 m: the bends fit, and the coil stays inside it."""
    (coil,) = case_of_height(top).coil("works", legs=legs)
    low, high = coil.solid.bounds
    assert low[2] >= 0.03 + 0.19 + 0.06 - 0.01 - 1e-9
    assert high[2] <= top - 0.08 + 0.01 + 1e-9


@pytest.mark.parametrize("wanted", [2, 8, 10])
def test_legs_are_fewer_only_where_bends_would_meet(wanted: int) -> None:
    rooms = np.linspace(0.03, 0.6, 400)
    counts = np.array([legs_that_fit(float(room), wanted) for room in rooms])
    assert (counts == wanted)[rooms > 2.0 * BEND * (wanted - 1)].all()
    assert (2.0 * BEND * (counts - 1) < rooms).all()
    assert (np.diff(counts) >= 0).all()


def test_the_lowest_beverage_refrigerator_is_built() -> None:
    """Asset 379 of seed 0 asked for eight legs in 0.163 m, where bends of 0.012 m do not fit."""
    rule, builder = load_rule("beverage_refrigerator"), load_builder("beverage_refrigerator")
    drawn = sample(
        rule,
        Stream(0, "beverage_refrigerator", 379),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )
    draft = builder.build(drawn.params, drawn.surfaces)
    assert draft.parts[0].label == "base"
