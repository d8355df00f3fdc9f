"""Every sample exactly once an epoch, whatever stops, resumes, or changes its number of ranks."""

import json
import multiprocessing
import subprocess
import sys
from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import UsageError
from artgen.dataset.members import encoded
from artgen.dataset.reader import ShardDataset
from artgen.dataset.sampler import ResumableSampler
from artgen.dataset.shard import write_shard
from tests.unit.dataset.scenes import made_sample

SIZES = st.integers(1, 60)
BLOCKS = st.none() | st.integers(1, 20)


def ranks(world_size, *, size, state=None, **options):
    """The samplers of one job."""
    made = [ResumableSampler(size, rank=r, world_size=world_size, **options)
            for r in range(world_size)]  # fmt: skip
    for sampler in made:
        if state is not None:
            sampler.load_state_dict(json.loads(json.dumps(state)))
    return made


def consume(samplers, steps, per_rank=1):
    """Positions that a job sees in so many steps, which it notes as real training does."""
    seen, streams = [], [iter(sampler) for sampler in samplers]
    for _ in range(steps):
        drawn = [x for stream in streams for x in take(stream, per_rank)]
        for sampler in samplers:
            sampler.advance(len(drawn))
        seen += drawn
    return seen


def take(stream, count):
    return list(islice(stream, count))


def rest(samplers):
    return [position for sampler in samplers for position in sampler]


@given(size=SIZES, seed=st.integers(0, 2**64), world_size=st.integers(1, 7), block=BLOCKS)
def test_an_epoch_is_a_permutation_dealt_out_to_the_ranks(size, seed, world_size, block):
    samplers = ranks(world_size, size=size, seed=seed, block=block)
    assert sorted(rest(samplers)) == list(range(size))
    lengths = [len(sampler) for sampler in samplers]
    assert lengths == [len(list(sampler)) for sampler in samplers]
    assert max(lengths) - min(lengths) <= 1


@settings(max_examples=200)
@given(
    size=SIZES,
    seed=st.integers(0, 100),
    block=BLOCKS,
    epoch=st.integers(0, 3),
    phases=st.lists(
        st.tuples(st.sampled_from([1, 2, 3, 4]), st.integers(0, 6), st.integers(1, 3)), max_size=5
    ),
    last=st.sampled_from([1, 2, 3, 4]),
)
def test_any_changes_of_world_size_within_an_epoch_show_every_sample_once(
    size, seed, block, epoch, phases, last
):
    """Each phase is (ranks, steps, samples a rank and step); state passes through JSON."""
    options = {"size": size, "seed": seed, "block": block}
    (first,) = ranks(1, **options)
    for _ in range(epoch):
        first.next_epoch()
    seen, state = [], first.state_dict()
    for world_size, steps, per_rank in phases:
        samplers = ranks(world_size, state=state, **options)
        seen += consume(samplers, steps, per_rank)
        state = samplers[0].state_dict()
        assert all(sampler.state_dict() == state for sampler in samplers)
    seen += rest(ranks(last, state=state, **options))
    assert sorted(seen) == list(range(size))


@given(size=SIZES, cut=st.integers(0, 60), world_size=st.integers(1, 4))
def test_resuming_continues_as_if_nothing_had_happened(size, cut, world_size):
    steps = cut // world_size
    unbroken = [list(sampler) for sampler in ranks(world_size, size=size, seed=3)]
    stopped = ranks(world_size, size=size, seed=3)
    consume(stopped, steps)
    resumed = ranks(world_size, size=size, seed=3, state=stopped[0].state_dict())
    assert [list(sampler) for sampler in resumed] == [stream[steps:] for stream in unbroken]


def test_epochs_differ_and_are_the_same_in_another_process():
    """webdataset's epochs repeat the first one's order in fresh workers (its issue 172)."""
    sampler = ResumableSampler(50, seed=1)
    orders = []
    for _ in range(4):
        orders.append(list(sampler))
        sampler.next_epoch()
    assert len({tuple(order) for order in orders}) == 4
    code = (
        "from artgen.dataset.sampler import ResumableSampler as R\n"
        "s = R(50, seed=1); s.next_epoch(); s.next_epoch(); print(list(s))"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == str(orders[2])


@given(size=SIZES, block=st.integers(1, 20))
def test_blocks_keep_neighbors_together(size, block):
    order = ResumableSampler(size, seed=5, block=block).order() // block
    runs = 1 + np.count_nonzero(np.diff(order))
    assert runs == -(-size // block)


@pytest.mark.parametrize(
    ("key", "value"),
    [("size", 11), ("seed", 2), ("block", 4), ("schema", "other/1")],
)
def test_the_state_of_another_job_is_refused(key, value):
    sampler = ResumableSampler(10, seed=1)
    with pytest.raises(UsageError, match=f"{key} {value!r}"):
        sampler.load_state_dict(sampler.state_dict() | {key: value})


@pytest.mark.parametrize("wrong", [{"size": 0}, {"seed": -1}, {"block": 0}, {"rank": 2}])
def test_numbers_out_of_range_are_refused(wrong):
    with pytest.raises(UsageError):
        ResumableSampler(**{"size": 3, "seed": 0, "world_size": 2} | wrong)


def test_more_than_an_epoch_holds_cannot_be_consumed():
    sampler = ResumableSampler(3, seed=0)
    sampler.advance(2)
    with pytest.raises(UsageError, match="1 of 3 are left"):
        sampler.advance(2)


def asset_id(dataset: ShardDataset, position: int) -> str:
    return dataset.load(position, states=[0], views=[0]).meta.asset_id


def test_two_ranks_of_two_workers_stop_and_four_ranks_go_on(tmp_path):
    """As PyTorch's DataLoader does it: the main process draws positions from the sampler, workers
    call the dataset with them. Workers run ahead; only what was stepped on counts."""
    ids = [f"laptop_{k:06d}" for k in range(14)]
    samples = (encoded(made_sample(name, states=1, views=1, parts=1)) for name in ids)
    write_shard(tmp_path / "train-000000.tar", samples)
    dataset = ShardDataset(tmp_path)
    jobs = ranks(2, size=len(dataset), seed=9)
    seen = []
    with multiprocessing.Pool(2) as workers:
        streams = [workers.imap(_Loader(dataset), sampler) for sampler in jobs]
        for _ in range(3):
            seen += [next(stream) for stream in streams]
            for sampler in jobs:
                sampler.advance(2)
        for sampler in ranks(4, size=len(dataset), seed=9, state=jobs[0].state_dict()):
            seen += workers.imap(_Loader(dataset), sampler)
    assert sorted(seen) == ids


class _Loader:
    """The dataset as workers call it."""

    def __init__(self, dataset: ShardDataset) -> None:
        self.dataset = dataset

    def __call__(self, position: int) -> str:
        return asset_id(self.dataset, position)


@given(size=SIZES, world_size=st.integers(1, 4), batch=st.integers(1, 9))
def test_the_loop_of_the_documentation_ends_with_nothing_left(size, world_size, batch):
    """Ranks step together; at the end some have a smaller batch, or none."""
    samplers = ranks(world_size, size=size, seed=2)
    streams, seen = [iter(sampler) for sampler in samplers], []
    while samplers[0].left:
        drawn = [x for stream in streams for x in take(stream, batch)]
        assert len(drawn) == min(batch * world_size, samplers[0].left)
        for sampler in samplers:
            sampler.advance(min(batch * world_size, sampler.left))
        seen += drawn
    assert sorted(seen) == list(range(size))
