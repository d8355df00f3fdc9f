"""Presets and decibels against the shipped table, and the table against its own front."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.errors import UsageError
from artgen.core.jsonio import canonical_json
from artgen.studies.front import pareto_front
from renders.accuracy import PRESETS, SETTING, Measured, cheapest, quality, shipped
from renders.study.shipped import PRESET_SIZE

SIZES = sorted({row.size_px for row in shipped()})


def at(size: int) -> list[Measured]:
    return [row for row in shipped() if row.size_px == size]


@pytest.mark.parametrize("size", SIZES)
def test_the_shipped_front_is_the_front_of_the_shipped_table(size: int) -> None:
    rows = list({tuple(getattr(r, name) for name in SETTING): r for r in at(size)}.values())
    front = pareto_front([row.cpu_s for row in rows], [-row.psnr_db for row in rows])
    assert [row.front for row in rows] == front.tolist()


@pytest.mark.parametrize("name", PRESETS)
def test_presets_lie_on_the_front_where_they_are_read(name: str) -> None:
    (row,) = [row for row in at(PRESET_SIZE) if row.preset == name]
    assert row.front


def test_better_presets_promise_more_and_cost_more() -> None:
    promises = [quality(name, 256).promise for name in PRESETS]
    known = [promise for promise in promises if promise is not None]
    assert len(known) == len(PRESETS)
    assert [p.psnr_db for p in known] == sorted(p.psnr_db for p in known)
    assert [p.cpu_s for p in known] == sorted(p.cpu_s for p in known)


def test_standard_promises_36_db_at_256_px() -> None:
    promise = quality("standard", 256).promise
    assert promise is not None
    assert promise.psnr_db >= 36.0


@pytest.mark.parametrize("size", SIZES)
def test_decibels_choose_the_cheapest_row_that_holds_them(size: int) -> None:
    chosen = quality("33dB", size)
    rows = [row for row in at(size) if row.psnr_db >= 33.0]
    assert chosen.promise is not None
    assert chosen.promise.psnr_db >= 33.0
    assert chosen.promise.cpu_s == min(row.cpu_s for row in rows)
    assert quality("33.0 dB", size).promise == chosen.promise


LINE = replace(shipped()[0], size_px=100)
OFFERS = st.lists(
    st.builds(
        lambda samples, psnr, cpu: replace(LINE, samples=samples, psnr_db=psnr, cpu_s=cpu),
        st.integers(1, 999),
        st.floats(20, 45),
        st.floats(0.1, 100),
    ),
    min_size=1,
    max_size=8,
    unique_by=lambda row: row.samples,
)


@given(OFFERS, st.floats(20, 45))
def test_what_is_chosen_holds_and_nothing_that_holds_is_cheaper(
    table: list[Measured], decibels: float
) -> None:
    holding = [row for row in table if row.psnr_db >= decibels]
    if holding:
        chosen = cheapest(table, decibels, 100)
        assert chosen in holding
        assert chosen.cpu_s == min(row.cpu_s for row in holding)
    else:
        with pytest.raises(UsageError, match="out of reach at 100 px: the best that was measured"):
            cheapest(table, decibels, 100)


def test_a_size_between_two_takes_the_worse() -> None:
    table = [LINE, replace(LINE, size_px=200, psnr_db=LINE.psnr_db - 3.0)]
    worse = LINE.psnr_db - 3.0
    assert cheapest(table, worse, 150).psnr_db == worse
    with pytest.raises(UsageError):
        cheapest(table, LINE.psnr_db, 150)
    assert cheapest(table, LINE.psnr_db, 50).psnr_db == LINE.psnr_db


def test_paths_that_nobody_measured_promise_nothing() -> None:
    asked = quality("17spp", 128)
    assert (asked.samples, asked.part_samples, asked.promise) == (17, 8, None)


@pytest.mark.parametrize("word", ["fine", "0spp", "35", "dB", "-3dB"])
def test_other_words_are_refused(word: str) -> None:
    with pytest.raises(UsageError, match="is unknown; ask for draft, standard, high, reference"):
        quality(word, 128)


def test_what_a_sample_records_is_json() -> None:
    told = quality("standard", 128).described()
    assert '"accuracy":"standard"' in canonical_json(told)
    assert '"psnr_db":' in canonical_json(told["promise"])
