"""The row of items is one and the same, however it is read."""

import dataclasses
import itertools
from functools import cache

import pytest
import torch

from artgen.core.errors import ModelError
from model.batch import Batch
from model.data import loader
from model.data.loader import batches
from model.data.merge import chosen, merged
from model.data.soup_source import SoupSource
from tests.unit.model.data.small import CONFIG, assert_equal, library


@cache
def source() -> SoupSource:
    return SoupSource(library(), slots=6)


def _taken(count: int, cursor: int = 0, **options) -> list[Batch]:
    settings = {key: options.pop(key) for key in ("workers", "batch") if key in options}
    config = dataclasses.replace(CONFIG, **settings)
    return list(itertools.islice(batches(source(), config, cursor, **options), count))


@cache
def expected() -> Batch:
    """The first twelve items."""
    return merged(_taken(3))


@pytest.mark.parametrize("workers", [1, 2])
def test_batches_are_the_same_at_any_number_of_workers(workers):
    assert_equal(merged(_taken(3, workers=workers)), expected())


@pytest.mark.parametrize("cursor", [1, 4, 7])
def test_a_run_resumed_at_any_cursor_sees_the_same_items(cursor):
    (found,) = _taken(1, cursor)
    assert_equal(found, chosen(expected(), range(cursor, cursor + 4)))


@pytest.mark.parametrize("world", [2, 4])
def test_ranks_share_every_batch(world):
    shares = [_taken(2, rank=rank, world=world) for rank in range(world)]
    found = merged([shares[rank][k] for k in range(2) for rank in range(world)])
    assert_equal(found, chosen(expected(), range(8)))


def test_another_batch_size_continues_the_same_row():
    found = merged([*_taken(1, 0), *_taken(2, 4, batch=2)])
    assert_equal(found, chosen(expected(), range(8)))


def test_an_epoch_holds_every_object_once_and_another_look_comes_each_time():
    ids = expected().asset_ids
    assert sorted(ids[:5]) == sorted(ids[5:10]) == sorted(set(ids))
    again = ids.index(ids[0], 5)
    rgb = expected().images.rgb_BTV3HW
    assert not torch.equal(rgb[0], rgb[again])


@pytest.mark.parametrize("workers", [0, 2])
def test_a_device_of_its_own_gives_the_same_batches_to_rounding(workers, monkeypatch):
    """As with a GPU: workers draw, and whole batches are cast where the training is."""
    monkeypatch.setattr(loader, "_shown_by_workers", lambda device: False)
    found = merged(_taken(2, workers=workers))
    wanted = chosen(expected(), range(8))
    assert found.asset_ids == wanted.asset_ids
    assert_equal(found.truth, wanted.truth)
    for name in ("rgb_BTV3HW", "alpha_BTVHW", "intrinsics_BTV33", "camera_from_world_BTV44"):
        one, other = getattr(found.images, name), getattr(wanted.images, name)
        torch.testing.assert_close(one, other, msg=lambda text, name=name: f"{name}: {text}")
    assert found.rays is not None
    assert wanted.rays is not None
    torch.testing.assert_close(found.rays.part_rgb_BPR3, wanted.rays.part_rgb_BPR3)
    torch.testing.assert_close(found.rays.direction_BR3, wanted.rays.direction_BR3)


@pytest.mark.parametrize("workers", [0, 1])
def test_a_fault_is_told_in_its_own_words(workers):
    config = dataclasses.replace(CONFIG, slots=2, workers=workers)
    with pytest.raises(ModelError) as caught:
        next(batches(source(), config))
    assert str(caught.value).endswith("do not fit into 2 slots; raise DataConfig.slots")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "options", [{"cursor": -1}, {"rank": 2, "world": 2}, {"rank": 0, "world": 3}]
)
def test_ranks_that_do_not_fit_are_refused(options):
    with pytest.raises(ModelError, match="multiple of the ranks"):
        next(batches(source(), CONFIG, **options))
