"""Closed poses: the least room, then contact, then the start."""

import numpy as np
import pytest

from artgen.core.mesh import Floats
from artgen.geometry.solid import box
from artgen.ingest.foreign import ForeignJoint
from artgen.ingest.rest import Rest, found_rests, outline

CASE = box((1.0, 0.5, 1.0)).trimesh().triangles


def joint(kind: str, lower: float | None, upper: float | None, **more: object) -> ForeignJoint:
    given = {"start": lower, "axis": (0.0, -1.0, 0.0), "origin": (0.0, 0.0, 0.0), **more}
    return ForeignJoint(
        name="j", type=kind, parent="base", child="mover", lower=lower, upper=upper, **given
    )


def rest_of(one: ForeignJoint, mover: Floats, label: str) -> Rest:
    outlines = {"base": outline(CASE, "base"), "mover": outline(mover, "mover")}
    return found_rests("base", [one], {"base": "base", "mover": label}, outlines)["j"]


def drawer(out: float = 0.0) -> Floats:
    """Inside the case, or drawn so far out."""
    return box((0.8, 0.4, 0.3), at=(0.0, -out, 0.3)).trimesh().triangles


def test_a_drawer_closes_where_it_takes_the_least_room() -> None:
    assert rest_of(joint("prismatic", 0.0, 0.4), drawer(), "drawer").q == 0.0
    found = rest_of(joint("prismatic", -0.4, 0.0), drawer(out=0.4), "drawer")
    assert (found.q, found.confidence) == (-0.4, "high")


def test_the_end_is_not_taken_for_the_start() -> None:
    """The negative control: b as rest would leave the drawer out."""
    one = joint("prismatic", 0.0, 0.4, start=0.4)
    assert rest_of(one, drawer(), "drawer").q == 0.0


def test_what_swings_to_both_sides_rests_as_drawn() -> None:
    """A bucket's handle from 128.88 to -113.76 degrees has no closed end."""
    handle = box((0.9, 0.02, 0.4), at=(0.0, 0.0, 1.0)).trimesh().triangles
    one = joint("revolute", np.radians(-113.76), np.radians(128.88), axis=(1.0, 0.0, 0.0),
                start=np.radians(128.88), origin=(0.0, 0.0, 1.0))  # fmt: skip
    found = rest_of(one, handle, "handle")
    assert (found.q, found.confidence) == (0.0, "medium")


def test_a_wheel_rests_as_drawn() -> None:
    wheel = box((0.05, 0.2, 0.2)).trimesh().triangles
    one = joint("continuous", None, None, axis=(1.0, 0.0, 0.0))
    assert rest_of(one, wheel, "wheel").q == 0.0


def test_a_lid_out_of_reach_of_its_pose_as_drawn_goes_to_the_nearer_end() -> None:
    """A bottle's lid from -0.108 to -0.008, hidden in the box of the case at both ends and touching
    nothing: q = 0 is outside its limits."""
    lid = box((0.01, 0.01, 0.01), at=(0.2, 0.0, 0.5)).trimesh().triangles
    one = joint("prismatic", -0.108, -0.008, axis=(0.0, 0.0, 1.0))
    found = rest_of(one, lid, "lid")
    assert (found.q, found.confidence) == (-0.008, "low")


def test_equal_boxes_are_told_apart_by_contact() -> None:
    """A flap inside the case's box touches its parent at the end of its way only."""
    flap = box((0.4, 0.02, 0.3), at=(0.0, 0.2, 0.6)).trimesh().triangles
    hollow = (box((1.0, 0.5, 1.0)) - box((0.9, 0.4, 0.9), at=(0.0, 0.0, 0.05))).trimesh().triangles
    outlines = {"base": outline(hollow, "base"), "mover": outline(flap, "mover")}
    one = joint("prismatic", 0.0, 0.3, start=0.3)
    found = found_rests("base", [one], {"base": "base", "mover": "door"}, outlines)["j"]
    assert (found.q, found.confidence) == (0.0, "medium")


def test_an_open_door_does_not_hide_what_a_drawer_takes() -> None:
    """Both start open; the drawer comes first and is decided again once the door is shut."""
    door = box((0.9, 0.02, 0.5), at=(0.0, -0.27, 0.0)).trimesh().triangles
    outlines = {"base": outline(CASE, "base"), "mover": outline(drawer(), "mover"),
                "door": outline(door, "door")}  # fmt: skip
    second = ForeignJoint(name="d", type="revolute", parent="base", child="door",
                          axis=(0.0, 0.0, 1.0), origin=(-0.45, -0.26, 0.0), lower=-1.57, upper=0.0,
                          start=-1.57)  # fmt: skip
    labels = {"base": "base", "mover": "drawer", "door": "door"}
    first = joint("prismatic", 0.0, 0.4, start=0.4)
    found = found_rests("base", [first, second], labels, outlines)
    assert (found["j"].q, found["j"].confidence) == (0.0, "high")
    assert found["d"].q == 0.0


def test_the_users_word_counts_most() -> None:
    one = joint("prismatic", 0.0, 0.4, rest=0.4)
    assert rest_of(one, drawer(), "drawer") == Rest(
        q=0.4, reason="given by the user", confidence="given"
    )


@pytest.mark.parametrize("seed", range(3))
def test_outlines_do_not_depend_on_when_they_are_drawn(seed: int) -> None:
    first, second = outline(CASE, str(seed)), outline(CASE, str(seed))
    np.testing.assert_array_equal(first.surface, second.surface)
    assert len(first.outer) == 8
