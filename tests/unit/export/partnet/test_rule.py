"""The rule from JSON to URDF, on the examples that the data set shows."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from artgen.export.partnet.nodes import Leaf, Motion, Node
from artgen.export.partnet.rule import RuleJoint, rule_joints, urdf_text

X = (1.0, 0.0, 0.0)


def node(number: int, parent: int, kind: str, motion: Motion | None = None) -> Node:
    return Node(
        id=number,
        parent=parent,
        kind=kind,
        name="n",
        leaves=(Leaf(id=number + 10, name="leaf"),),
        motion=motion,
    )


def moving(kind: str, a: float, b: float, **more: bool) -> RuleJoint:
    motion = Motion(origin=(0.1, 0.2, 0.3), direction=X, a=a, b=b, **more)
    return rule_joints([node(0, 1, kind, motion), node(1, -1, "heavy")])[0]


def test_drawer_keeps_its_axis() -> None:
    joint = moving("slider", 0.0, 0.64)
    assert (joint.type, joint.axis, joint.lower, joint.upper) == ("prismatic", X, 0.0, 0.64)


def test_door_that_opens_to_minus_90_has_its_axis_turned() -> None:
    joint = moving("hinge", 0.0, -90.0)
    assert joint.axis == (-1.0, 0.0, 0.0)
    assert (joint.lower, joint.upper) == (0.0, math.radians(90.0))


def test_bucket_handle_from_128_down_to_minus_113() -> None:
    """2.2494 and 1.9855 are what the data set's URDF prints."""
    joint = moving("hinge", 128.88, -113.76)
    assert joint.axis == (-1.0, 0.0, 0.0)
    assert joint.lower == pytest.approx(-2.2494, abs=5e-5)
    assert joint.upper == pytest.approx(1.9855, abs=5e-5)


def test_bottle_lid_keeps_limits_without_zero() -> None:
    joint = moving("slider", -0.108, -0.008)
    assert (joint.axis, joint.lower, joint.upper) == (X, -0.108, -0.008)


def test_free_hinge_is_continuous_whatever_a_and_b_say() -> None:
    joint = moving("hinge", 5.0, -5.0, free=True)
    assert (joint.type, joint.axis, joint.lower) == ("continuous", X, None)


def test_turning_slider_makes_a_helper_whose_joint_is_numbered_last() -> None:
    motion = Motion(origin=(0.0, 0.0, 0.0), direction=X, a=0.1, b=0.0, rotates=True, turn=180.0)
    nodes = [node(0, 2, "slider", motion), node(1, 2, "static"), node(2, -1, "free")]
    slide, turn, still = rule_joints(nodes)
    assert (slide.name, slide.parent, slide.child) == ("joint_3", "link_2", "link_0_helper")
    assert (slide.axis, slide.lower, slide.upper) == ((-1.0, 0.0, 0.0), -0.1, 0.0)
    assert (turn.name, turn.type, turn.axis) == ("joint_0", "continuous", X)
    assert (turn.parent, turn.child, turn.offset) == ("link_0_helper", "link_0", (0.0, 0.0, 0.0))
    assert (still.type, still.axis) == ("fixed", None)


def test_stale_motion_of_a_root_moves_no_frame() -> None:
    """Old exports leave an axis with the root; frames of its children count from zero."""
    stale = Motion(origin=(9.0, 9.0, 9.0), direction=X, a=0.0, b=1.0)
    child = Motion(origin=(0.1, 0.2, 0.3), direction=X, a=0.0, b=1.0)
    joints = rule_joints([node(0, 1, "hinge", child), node(1, -1, "hinge", stale)])
    assert joints[0].offset == (0.1, 0.2, 0.3)


def test_origins_cancel_along_every_chain() -> None:
    """At q = 0 a vertex is where its OBJ says: offsets and the visual's origin sum to zero. Each
    sum of three numbers of size 1 rounds twice by half an ulp, 2.2e-16 in all; 1e-15 is allowed."""
    places = [(0.3, -0.1, 0.7), (0.1, 0.9, -0.2)]
    inner = [Motion(origin=place, direction=X, a=0.0, b=9.0) for place in places]
    nodes = [node(0, 1, "hinge", inner[0]), node(1, 2, "slider", inner[1]), node(2, -1, "heavy")]
    robot = ET.fromstring(urdf_text(nodes, {10: ["a"], 11: ["b"], 12: ["c"]}, name="r"))
    offsets = {
        joint.find("child").get("link"): (joint.find("parent").get("link"), xyz(joint))
        for joint in robot.iterfind("joint")
    }
    for link in robot.iterfind("link"):
        if (visual := link.find("visual")) is None:
            continue
        total, name = xyz(visual), link.get("name")
        while name in offsets:
            name, offset = offsets[name]
            total = total + offset
        assert np.abs(total).max() <= 1e-15


def test_root_is_the_last_numbered_link_and_base_the_first() -> None:
    nodes = [node(0, 1, "hinge", Motion(origin=(0, 0, 0), direction=X, a=0.0, b=9.0)),
             node(1, -1, "heavy")]  # fmt: skip
    robot = ET.fromstring(urdf_text(nodes, {}, name="r"))
    assert [link.get("name") for link in robot.iterfind("link")] == ["base", "link_0", "link_1"]
    assert robot.find("joint/limit").attrib.keys() == {"lower", "upper"}


def xyz(element: ET.Element) -> np.ndarray:
    return np.array([float(word) for word in element.find("origin").get("xyz").split()])
