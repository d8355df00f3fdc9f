import itertools
from collections import Counter

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from model.data.library import packed
from model.data.loader import batches
from model.data.merge import merged
from model.data.mixed import BLOCK, Mixed, mixed_by_number
from model.data.soup_source import SoupSource
from tests.unit.model.data.small import CONFIG, assert_equal, soup

CABINETS = SoupSource(packed([soup("cabinet", k) for k in range(3)]))
OTHERS = SoupSource(packed([soup("laptop"), soup("cardboard_box")]), slots=8)


def test_every_hundred_places_hold_the_shares_exactly():
    mixed = Mixed([(CABINETS, 3.0), (OTHERS, 1.0)])
    row = mixed.order(0)
    for block in range(3):
        found = Counter(row.at(block * BLOCK + k) >= 3 for k in range(BLOCK))
        assert found == {False: 75, True: 25}


def test_each_source_passes_through_its_items_at_its_own_pace():
    row = Mixed([(CABINETS, 1.0), (OTHERS, 1.0)]).order(4)
    places = [row.at(place) for place in range(2 * BLOCK)]
    first = [k for k in places if k < 3]
    second = [k - 3 for k in places if k >= 3]
    for found, size in ((first, 3), (second, 2)):
        for start in range(0, len(found) - size, size):
            assert sorted(found[start : start + size]) == list(range(size))


def test_a_place_of_the_mix_depends_on_nothing_but_its_number():
    mixed = Mixed([(CABINETS, 2.0), (OTHERS, 1.0)])
    forward = [mixed.order(1).at(place) for place in range(250)]
    row = mixed.order(1)
    assert [row.at(place) for place in reversed(range(250))] == forward[::-1]


def test_a_batch_keeps_the_order_of_the_row():
    mixed = Mixed([(CABINETS, 1.0), (OTHERS, 1.0)])
    batch = next(batches(mixed, CONFIG))
    row = mixed.order(CONFIG.seed)
    sources = [CABINETS.library.ids, OTHERS.library.ids]
    ids = [(*sources[0], *sources[1])[row.at(place)] for place in range(CONFIG.batch)]
    assert list(batch.asset_ids) == ids
    plans = [mixed.plan(row.at(k), CONFIG, Stream(CONFIG.seed, "item", k)) for k in range(4)]
    alone = [mixed.batch([plan], CONFIG, torch.device("cpu")) for plan in plans]
    assert_equal(batch, merged(alone))
    together = mixed.batch(plans, CONFIG, torch.device("cpu"))
    assert together.asset_ids == batch.asset_ids
    torch.testing.assert_close(together.images.rgb_BTV3HW, batch.images.rgb_BTV3HW)


def test_what_sources_left_out_is_told():
    short = SoupSource(packed([soup("laptop"), soup("cardboard_box")]), slots=3)
    assert list(Mixed([(CABINETS, 1.0), (short, 1.0)]).left_out) == ["cardboard_box_000000"]


@pytest.mark.parametrize("weights", [(), (1.0, 0.0), (1.0, np.inf), (1000.0, 1.0)])
def test_weights_that_give_a_source_nothing_are_refused(weights):
    pairs = list(itertools.product([CABINETS], weights))
    with pytest.raises(ModelError, match="weight"):
        Mixed(pairs)


class Sized:
    """As much of a source as its share depends on."""

    def __init__(self, size):
        self.size = size

    def __len__(self):
        return self.size


@pytest.mark.parametrize(
    ("sizes", "counts"),
    [
        ((30, 7243), [1, 99]),
        ((7243, 30), [99, 1]),
        ((300, 100), [75, 25]),
        ((1, 1, 10**6), [1, 1, 98]),
        ((1, 160, 9839), [1, 2, 97]),
        ((5,) * 100, [1] * 100),
    ],
)
def test_small_sources_have_a_hundredth_at_least(sizes, counts):
    """Some Cycles shards beside a large library were refused: 30 of 7,273 are no hundredth."""
    assert mixed_by_number([Sized(size) for size in sizes]).counts.tolist() == counts


def test_one_source_alone_is_not_mixed_and_none_or_too_many_are_refused():
    assert mixed_by_number([CABINETS]) is CABINETS
    for count in (0, 101):
        with pytest.raises(ModelError, match="expected 1 to 100"):
            mixed_by_number([Sized(5)] * count)
