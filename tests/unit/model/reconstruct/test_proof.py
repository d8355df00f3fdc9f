"""Whatever still meets is shortened, or taken away; then nothing meets."""

import math

import pytest

from artgen.articulation.states import travel
from artgen.articulation.types import Precondition
from artgen.geometry.clearance import shape_of_solids
from artgen.geometry.solid import slab
from artgen.validate.sweep import crossings
from model.reconstruct.proof import first_meetings, proven
from model.reconstruct.scene import Scene
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


def worst_crossing(scene: Scene) -> float:
    """m3 that validators find two parts to share at most."""
    shapes = {name: shape_of_solids([solid]) for name, solid in scene.solids.items()}
    found = crossings(scene.base, scene.joints, scene.rules, shapes)
    return max((crossing.overlap.volume for crossing in found), default=0.0)


@pytest.mark.parametrize("chained", [False, True], ids=["both", "chained"])
def test_no_joint_waits_for_two_that_meet(chained: bool) -> None:
    """A flap waits for two blocks that slide into one place from both sides, or for one that waits
    for the other: each finds nothing in its way alone, 0.02 x 0.2 x 0.199 m3 are shared by both."""
    left, right = BLOCK.at(x=-0.4), BLOCK.at(x=0.4)
    flap = slab((-0.1, 0.5, 0.001), (0.1, 0.7, 0.02))
    joints = (
        stated("flap", "revolute", axis=(1.0, 0.0, 0.0), origin=(0.0, 0.5, 0.001), upper=1.0),
        stated("left", "prismatic", axis=(1.0, 0.0, 0.0), upper=0.31),
        stated("right", "prismatic", axis=(-1.0, 0.0, 0.0), upper=0.31),
    )
    waits = "left_joint" if chained else "flap_joint"
    rules = (
        Precondition(joint="flap_joint", requires="left_joint", at_least=0.31),
        Precondition(joint=waits, requires="right_joint", at_least=0.31),
    )
    solids = {"base": FLOOR, "flap": flap, "left": left, "right": right}
    scene = Scene(solids=solids, joints=joints, rules=rules)
    assert worst_crossing(scene) == pytest.approx(0.02 * 0.2 * 0.199)
    found = proven(scene)
    assert worst_crossing(found) == 0.0
    assert {joint.name for joint in found.joints} == {joint.name for joint in joints}
    assert len(found.rules) == 1 + chained
    uppers = {joint.name: travel(joint)[1] for joint in found.joints}
    assert all(rule.at_least <= uppers[rule.requires] for rule in found.rules)
    assert any("waits no more" in change for change in found.changes) != chained
