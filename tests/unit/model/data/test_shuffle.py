"""The ablation of part order: the same object, its movable parts in slots that its id decides."""

import dataclasses

import torch

from artgen.core.stream import Stream
from model.batch import Batch
from model.data.shuffle import shuffled
from model.data.soup_source import SoupSource
from model.field.kinematics import world_from_rest
from tests.unit.model.data.small import CONFIG, assert_equal, library

SHUFFLED = dataclasses.replace(CONFIG, part_order="shuffled")


def items(config=CONFIG) -> Batch:
    source = SoupSource(library(), split=None, slots=CONFIG.slots)
    planned = [source.plan(k, config, Stream(1, k)) for k in range(len(source))]
    return source.batch(planned, config, torch.device("cpu"))


def places(one: Batch, other: Batch, item: int) -> list[int]:
    """Slot of `one` to slot of `other` with the same box."""
    boxes = [torch.cat([b.truth.center_BP3, b.truth.size_BP3], dim=-1)[item] for b in (one, other)]
    return [int((boxes[1] == box).all(dim=-1).nonzero()[0, 0]) for box in boxes[0]]


def test_every_part_keeps_its_poses_and_its_colors() -> None:
    plain, mixed = items(), items(SHUFFLED)
    poses = [world_from_rest(batch.truth) for batch in (plain, mixed)]
    moved = 0
    for item, count in enumerate(plain.truth.valid_BP.sum(dim=1).tolist()):
        to = places(plain, mixed, item)[:count]
        assert sorted(to) == list(range(count))
        assert to[0] == 0
        moved += to != list(range(count))
        assert torch.equal(poses[0][item][:, :count], poses[1][item][:, to])
        for name in ("part_rgb_BPR3", "part_alpha_BPR"):
            ours, theirs = (getattr(batch.rays, name)[item] for batch in (plain, mixed))
            assert torch.equal(ours[:count], theirs[to])
        parents = plain.truth.parent_BP[item, 1:count].tolist()
        assert [to[p] for p in parents] == mixed.truth.parent_BP[item, to[1:]].tolist()
    assert moved > 0


def test_images_stay_and_the_order_is_always_the_same() -> None:
    plain, mixed = items(), items(SHUFFLED)
    assert_equal(plain.images, mixed.images)
    assert_equal(mixed, shuffled(plain))
    assert torch.equal(plain.truth.valid_BP, mixed.truth.valid_BP)
    alone = dataclasses.replace(plain, rays=None)
    assert_equal(shuffled(alone).truth, mixed.truth)
