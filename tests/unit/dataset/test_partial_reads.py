"""What is read of a shard is what was asked for: counted in bytes and in calls of `pread`."""

import os
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.dataset.members import encoded
from artgen.dataset.reader import ShardDataset
from artgen.dataset.shard import HEADER, write_shard
from artgen.dataset.store import NEAR, runs
from tests.unit.dataset.scenes import made_sample, with_extras

STATES, VIEWS = 12, 12


@pytest.fixture(scope="module")
def dataset(tmp_path_factory) -> ShardDataset:
    """Two samples of 144 views; the second is read."""
    folder = tmp_path_factory.mktemp("views")
    samples = [
        with_extras(made_sample(f"laptop_00000{k}", states=STATES, views=VIEWS, parts=2, seed=k))
        for k in (0, 2)
    ]
    write_shard(folder / "train-000000.tar", map(encoded, samples))
    dataset = ShardDataset(folder)
    dataset.load(0, states=[0], views=[0])  # the index is read once
    return dataset


@pytest.fixture
def preads(monkeypatch) -> list[tuple[int, int]]:
    """Offset and size of every read of a shard."""
    calls, pread = [], os.pread

    def counted(handle, size, offset):
        calls.append((offset, size))
        return pread(handle, size, offset)

    monkeypatch.setattr(os, "pread", counted)
    return calls


@pytest.mark.parametrize(
    ("states", "views"),
    [([3], [1, 2, 3, 4, 5, 6, 7, 8]), ([0, 11], [0, 4, 7, 11]), ([5, 6, 8, 2], [9, 3])],
)
def test_eight_of_144_views_are_read_without_touching_the_rest(dataset, preads, states, views):
    """Neighboring members are read at once, with the header and the padding between them; the
    facts of the sample and each run of neighboring views are one read."""
    sample = dataset.load(1, states=states, views=views)
    assert sample.shape[:2] == (len(states), len(views))
    shard, asset_id = dataset.shard(1)
    chosen = {"meta", "arrays"} | {f"s{t}v{v:02d}" for t in states for v in views}
    places = shard.index[asset_id]
    asked = [place for place in places if place.name.split(".")[0] in chosen]
    between = sum(
        b.offset - (a.offset + a.size)
        for a, b in pairwise(places)
        if a in asked and b in asked
    )  # fmt: skip
    assert sum(size for _, size in preads) == sum(place.size for place in asked) + between
    gaps = sum(b.offset - a.offset - a.size >= 2 * HEADER for a, b in pairwise(asked))
    assert len(preads) == 1 + gaps
    # Beside the facts, the first two members: 8 of 144 views are 5.6 %; those of the last state are
    # a tenth smaller than the others, since its flow is 0.
    facts = places[1].offset + places[1].size
    images = places[-1].offset + places[-1].size - facts
    read = sum(size for _, size in preads) - (facts - places[0].offset)
    assert read < 0.065 * images


def test_a_random_choice_equals_that_of_the_whole(dataset):
    whole = dataset[1]
    rng = np.random.default_rng(0)
    for _ in range(10):
        t, v = rng.integers(STATES, size=2), rng.integers(VIEWS, size=4)
        some = dataset.load(1, states=t.tolist(), views=v.tolist())
        for name in some.images:
            np.testing.assert_array_equal(getattr(some, name), getattr(whole, name)[t][:, v])


RANGES = st.lists(st.tuples(st.integers(0, 20_000), st.integers(0, 3000)), max_size=20)


@settings(max_examples=200)
@given(ranges=RANGES)
def test_runs_hold_every_range_once_and_read_no_gap_over_the_bound(ranges):
    found = list(runs(ranges))
    assert [item for run in found for item in run] == sorted(set(ranges))
    stops = [max(offset + size for offset, size in run) for run in found]
    starts = [run[0][0] for run in found]
    assert all(start - stop > NEAR for stop, start in zip(stops, starts[1:], strict=False))
    for run in found:
        reach = run[0][0]
        for offset, size in run:
            assert offset <= reach + NEAR
            reach = max(reach, offset + size)
