"""Parts are moved apart with a stated clearance, and ways are freed, ended or made to wait."""

import math
from collections.abc import Mapping

import numpy as np

from artgen.articulation.types import Joint, Limit
from artgen.geometry.clearance import Mover, overlaps, shape_of_solids
from artgen.geometry.solid import Solid, slab
from artgen.validate.sweep import sweep_poses, sweeps
from model.reconstruct.apart import Cutter, apart_at_rest, clear_ways
from model.reconstruct.freedom import free_share
from model.reconstruct.scene import Scene
from tests.unit.model.reconstruct.perfect import open_box
from tests.unit.model.reconstruct.scenes import stated

CLEARANCE = 1e-3
SHELL = open_box(np.array([-0.3, -0.25, 0.0]), np.array([0.3, 0.25, 0.4]), 0.02, open_to=1, side=0)


def slide(part: str, upper: float, *, parent: str = "base") -> Joint:
    """Toward the front."""
    return stated(part, "prismatic", axis=(0.0, -1.0, 0.0), upper=upper, parent=parent)


def hinge(part: str, origin: tuple[float, float, float], upper: float) -> Joint:
    """About an upright axis; a left one opens to the front."""
    return stated(part, "revolute", axis=(0.0, 0.0, -1.0), origin=origin, upper=upper)


def settled(solids: Mapping[str, Solid], *joints: Joint) -> Scene:
    cutter = Cutter(CLEARANCE)
    return clear_ways(apart_at_rest(Scene(solids=solids, joints=joints), cutter), cutter)


def shared(scene: Scene) -> float:
    """The largest volume that two parts share anywhere that validators look, m3."""
    worst = 0.0
    for sweep in sweeps(scene.joints, scene.rules):
        poses = sweep_poses(scene.base, scene.joints, sweep)
        movers = [
            Mover(name=n, shape=shape_of_solids([s]), poses=poses[n])
            for n, s in scene.solids.items()
        ]
        worst = max([worst, *(overlap.volume for overlap in overlaps(movers))])
    return worst


def test_the_base_gives_way_by_the_clearance() -> None:
    """A door 5 mm deep in the shell's front edges, and the shell ends a clearance before it: the
    cover is grown by 1.5 of it, and merging takes back a tenth at most."""
    door = slab((-0.3, -0.27, 0.0), (0.3, -0.245, 0.4))
    scene = settled({"base": SHELL, "door": door}, hinge("door", (-0.3, -0.27, 0.0), 1.5))
    gap = scene.solids["base"].bounds[0, 1] - door.bounds[1, 1]
    assert 1.0 * CLEARANCE <= gap <= 1.7 * CLEARANCE
    assert scene.solids["door"].volume == door.volume
    assert shared(scene) <= 1e-9


def test_a_film_before_a_drawer_is_cut_out_of_its_way() -> None:
    drawer = slab((-0.27, -0.24, 0.03), (0.27, 0.2, 0.37))
    film = slab((-0.3, -0.25, 0.0), (0.3, -0.245, 0.4))
    scene = settled({"base": SHELL | film, "drawer": drawer}, slide("drawer", 0.3))
    assert scene.joint("drawer_joint").limit == Limit(lower=0.0, upper=0.3)
    assert any("along drawer_joint" in change for change in scene.changes)
    assert shared(scene) <= 1e-9


def test_a_drawer_behind_a_door_waits_for_it() -> None:
    drawer = slab((-0.25, -0.24, 0.03), (0.2, 0.2, 0.37))
    door = slab((-0.3, -0.27, 0.0), (0.3, -0.252, 0.4))
    scene = settled(
        {"base": SHELL, "door": door, "drawer": drawer},
        hinge("door", (-0.3, -0.27, 0.0), math.pi / 2.0),
        slide("drawer", 0.3),
    )
    (rule,) = scene.rules
    assert (rule.joint, rule.requires) == ("drawer_joint", "door_joint")
    assert shared(scene) <= 1e-9


def test_a_way_ends_where_it_would_go_through_the_base() -> None:
    """A block that stands 0.2 m before a thick wall and is to slide 0.5 m toward it: up to 8 % of
    it in the wall count as noise and are cut, then it ends."""
    wall = slab((-0.5, -0.6, 0.0), (0.5, -0.3, 1.0)) | slab((-0.5, -0.3, 0.0), (0.5, 0.3, 0.1))
    block = slab((-0.1, -0.1, 0.11), (0.1, 0.1, 0.3))
    scene = settled({"base": wall, "block": block}, slide("block", 0.5))
    limit = scene.joint("block_joint").limit
    assert limit is not None
    assert 0.17 <= limit.upper <= 0.2 + 0.08 * 0.2
    assert shared(scene) <= 1e-9


def test_parts_that_are_apart_stay_as_they_are() -> None:
    drawer = slab((-0.25, -0.24, 0.03), (0.25, 0.2, 0.37))
    solids = {"base": SHELL, "drawer": drawer}
    scene = settled(solids, slide("drawer", 0.3))
    assert scene.changes == ()
    assert scene.solids == solids


def test_what_carries_a_part_gives_way_to_it() -> None:
    """A knob let into a door turns in a bore of the door."""
    door = slab((-0.3, -0.27, 0.0), (0.3, -0.252, 0.4))
    knob = slab((0.2, -0.3, 0.18), (0.24, -0.26, 0.22))
    turn = stated(
        "knob", "revolute", axis=(0.0, 1.0, 0.0), origin=(0.22, 0.0, 0.2), upper=1.5, parent="door"
    )
    scene = settled(
        {"base": SHELL, "door": door, "knob": knob},
        hinge("door", (-0.3, -0.27, 0.0), math.pi / 2.0),
        turn,
    )
    assert scene.solids["knob"].volume == knob.volume
    assert scene.joint("knob_joint").limit == Limit(lower=0.0, upper=1.5)
    assert shared(scene) <= 1e-9


def door_and_drawer(hinge_at: float) -> Scene:
    """A door before the left two thirds of a shell, and a drawer behind its right half and beyond,
    whose front stands in the door: across y a plane takes less than across x."""
    door = slab((-0.28, -0.27, 0.05), (0.1, -0.245, 0.35))
    drawer = slab((-0.05, -0.262, 0.1), (0.28, 0.1, 0.3))
    solids = {"base": SHELL, "door": door, "drawer": drawer}
    joints = hinge("door", (hinge_at, -0.27, 0.0), 1.6), slide("drawer", 0.3)
    if hinge_at > 0.0:
        joints = stated("door", "revolute", axis=(0.0, 0.0, 1.0), origin=(hinge_at, -0.27, 0.0),
                        upper=1.6), joints[1]  # fmt: skip
    return Scene(solids=solids, joints=joints)


def test_a_drawer_behind_a_door_that_opens_away_from_it_stays_behind() -> None:
    """Hinged at its left edge the door clears the drawer's way."""
    found = apart_at_rest(door_and_drawer(-0.28), Cutter(CLEARANCE))
    assert any("a plane across y parts them" in change for change in found.changes)
    assert abs(found.solids["door"].volume / (0.38 * 0.025 * 0.3) - 1.0) <= 0.5


def test_a_drawer_whose_door_opens_across_its_way_is_put_beside_it() -> None:
    """Hinged at its right edge the wide open door stands before the drawer still, so that a plane
    across y, which takes less, would leave no way out; both keep one across x."""
    found = apart_at_rest(door_and_drawer(0.1), Cutter(CLEARANCE))
    assert any("a plane across x parts them" in change for change in found.changes)
    assert any("no way out" in change for change in found.changes)
    assert found.solids["door"].bounds[1, 0] < found.solids["drawer"].bounds[0, 0]
    assert free_share(found, "drawer_joint", against=["door"]) == 1.0
    assert free_share(found, "door_joint", against=["drawer"]) == 1.0
