"""Whatever still meets is shortened, or taken away; then nothing meets."""

import math

from artgen.geometry.solid import slab
from model.reconstruct.proof import first_meetings, proven
from tests.unit.model.reconstruct.scenes import scene_of, stated

FLOOR = slab((-1.0, -1.0, -0.1), (1.0, 1.0, 0.0))
BLOCK = slab((-0.1, -0.1, 0.001), (0.1, 0.1, 0.2))


def test_a_way_ends_before_it_meets_something() -> None:
    """A wall 0.2 m before the block; steps of the way are 0.025 m."""
    wall = slab((0.3, -1.0, 0.0), (0.4, 1.0, 1.0))
    slide = stated("block", "prismatic", axis=(1.0, 0.0, 0.0), upper=0.5)
    scene = proven(scene_of(slide, base=FLOOR | wall, block=BLOCK))
    limit = scene.joint("block_joint").limit
    assert limit is not None
    assert 0.2 - 0.025 <= limit.upper <= 0.2
    assert first_meetings(scene) == []


def test_a_part_that_cannot_leave_rest_becomes_a_piece() -> None:
    slide = stated("block", "prismatic", axis=(0.0, 0.0, -1.0), upper=0.05)
    scene = proven(scene_of(slide, base=FLOOR, block=BLOCK))
    assert list(scene.solids) == ["base"]
    assert scene.joints == ()
    assert scene.piece_of("block") == "base"
    assert abs(scene.solids["base"].volume - FLOOR.volume - BLOCK.volume) <= 1e-12
    assert any("block became a piece of base" in change for change in scene.changes)


def test_parts_that_meet_at_rest_become_one() -> None:
    sunk = slab((-0.1, -0.1, -0.05), (0.1, 0.1, 0.2))
    turn = stated("block", "revolute", axis=(0.0, 0.0, 1.0), upper=math.pi)
    assert proven(scene_of(turn, base=FLOOR, block=sunk)).joints == ()


def test_what_meets_nowhere_stays() -> None:
    slide = stated("block", "prismatic", axis=(0.0, 0.0, 1.0), upper=0.1)
    scene = scene_of(slide, base=FLOOR, block=BLOCK)
    assert proven(scene) is scene
