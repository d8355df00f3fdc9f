"""Which poses are looked at, and where the parts are in them."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Joint, Limit, Precondition
from artgen.validate.sweep import POSES, Sweep, sweep_poses, sweeps
from tests.strategies import trees


def slide(name: str, parent: str, child: str, upper: float = 0.4) -> Joint:
    return Joint(
        name=name, type="prismatic", parent=parent, child=child, axis=(0.0, -1.0, 0.0),
        limit=Limit(lower=0.0, upper=upper), friction=1.0, damping=0.0, effort=10.0,
    )  # fmt: skip


DOOR, RACK = slide("door", "base", "d"), slide("rack", "base", "r", 0.5)


def test_rest_comes_first_and_each_joint_reaches_both_ends() -> None:
    rest, door, rack = sweeps((DOOR, RACK), ())
    assert rest == Sweep(joint="", states=({},))
    for sweep, joint in ((door, DOOR), (rack, RACK)):
        assert len(sweep.states) == POSES
        assert joint.limit is not None
        assert [sweep.states[0], sweep.states[-1]] == [
            {joint.name: 0.0},
            {joint.name: joint.limit.upper},
        ]


def test_a_precondition_is_held_at_its_value_and_fully_open() -> None:
    rule = Precondition(joint="rack", requires="door", at_least=0.3)
    found = [s for s in sweeps((DOOR, RACK), (rule,)) if s.joint == "rack"]
    assert [{state["door"] for state in sweep.states} for sweep in found] == [{0.3}, {0.4}]


def test_preconditions_chain() -> None:
    """The tray needs the rack out, which needs the door open."""
    tray = slide("tray", "r", "t")
    rules = (
        Precondition(joint="rack", requires="door", at_least=0.3),
        Precondition(joint="tray", requires="rack", at_least=0.2),
    )
    found = [s for s in sweeps((DOOR, RACK, tray), rules) if s.joint == "tray"]
    assert found[0].states[0] == {"door": 0.3, "rack": 0.2, "tray": 0.0}


def test_a_state_is_told_in_words() -> None:
    sweep = Sweep(joint="rack", states=({"door": 0.3, "rack": 0.25},))
    assert sweep.told(sweep.states[0]) == "at rack = 0.25 with door = 0.3"
    assert Sweep(joint="", states=({},)).told({}) == "at rest"


@settings(deadline=None, max_examples=60)
@given(tree=trees(), data=st.data())
def test_poses_over_a_sweep_are_those_of_forward_kinematics(
    tree: tuple[Joint, ...], data: st.DataObject
) -> None:
    """Only moving parts are computed anew, all poses at once; products may be summed in another
    order: four of them lose 4 ulp of 2.2e-16 each, in a tree of some meters."""
    chosen = data.draw(st.sampled_from(list(sweeps(tree, ()))))
    poses = sweep_poses("part_0", tree, chosen)
    for k, state in enumerate(chosen.states):
        for name, pose in forward_kinematics("part_0", tree, state).items():
            np.testing.assert_allclose(poses[name][k], pose, rtol=0, atol=1e-14)
