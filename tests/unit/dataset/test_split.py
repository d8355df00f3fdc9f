"""Splits are frozen, of the stated sizes, and never share an asset."""

from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.dataset.split import families_of, split_of


def test_the_split_of_an_asset_is_frozen():
    """Changing one of these moves assets between training and testing for everybody."""
    assert [split_of(f"laptop_{index:06d}") for index in range(12)] == [
        "train", "test", "train", "train", "train", "train",
        "train", "train", "train", "test", "train", "train",
    ]  # fmt: skip


def test_ten_per_cent_each_are_kept_for_validation_and_testing():
    """Of 10,000 draws with chance 0.1 the count has a standard deviation of 30; 150 is five."""
    count = Counter(split_of(f"cabinet_{index:06d}") for index in range(10_000))
    assert abs(count["test"] - 1000) < 150
    assert abs(count["val"] - 1000) < 150


NAMES = st.integers(0, 400).map(lambda index: f"laptop_{index:06d}")


@given(donors=st.sets(NAMES, min_size=1, max_size=4))
def test_an_asset_has_the_split_of_its_donors_or_none(donors):
    """Its own name says nothing then; so no part is in two splits, and no asset ever moves when
    others join."""
    splits = {split_of(donor) for donor in donors}
    expected = splits.pop() if len(splits) == 1 else None
    assert split_of("cabinet_000000", donors) == split_of("cabinet_000001", donors) == expected


@given(assets=st.dictionaries(NAMES, st.sets(NAMES, max_size=3), max_size=40))
def test_no_part_is_seen_in_two_splits(assets):
    seen = {}
    for asset_id, donors in assets.items():
        split = split_of(asset_id, donors)
        for owner in donors or {asset_id}:
            if split is not None:
                assert seen.setdefault(owner, split) == split


@pytest.mark.parametrize(
    ("manifest", "families"),
    [
        ({}, ()),
        ({"source": "reconstruction"}, ()),
        ({"source": {"dataset": "artgen", "id": "cabinet_000001"}}, ()),
        ({"source": {"dataset": "urdf", "id": "arm"}}, ("urdf:arm",)),
        ({"source": {"dataset": "urdf", "id": "arm", "family": "cabinet_3"}}, ("cabinet_3",)),
        ({"source": {"dataset": "a+urdf", "id": "arm"}, "donors": ["x", "y"]}, ("x", "y")),
        ({"donors": []}, ()),
    ],
)
def test_families_are_donors_or_that_of_the_foreign_source(manifest, families):
    assert families_of(manifest) == families
