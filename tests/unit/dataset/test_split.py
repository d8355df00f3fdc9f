"""Splits are frozen, of the stated sizes, and never share an asset."""

from collections import Counter

from artgen.dataset.split import split_of


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
