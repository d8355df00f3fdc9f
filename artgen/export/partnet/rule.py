"""The rule by which PartNet-Mobility's URDF follows from its JSON.

Link frames are parallel to the mesh frame and stand at the joint's origin, so all origins cancel
at q = 0 and every vertex is where its OBJ says, turned by the root's rotation alone.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.articulation.types import Vector
from artgen.export.numbers import exact
from artgen.export.partnet.nodes import MOVING, ROOT, Node

ROOT_RPY = "1.570796326794897 0 -1.570796326794897"
"""Of the fixed joint below `base`: mesh (x, y, z) becomes (-z, -x, y) of the URDF's world."""
NOWHERE: Vector = (0.0, 0.0, 0.0)
HELPER = "_helper"


@dataclass(frozen=True, kw_only=True)
class RuleJoint:
    """A joint as the rule states it.

    Attributes:
        type: fixed, revolute, continuous or prismatic.
        offset: `<origin xyz>`, mesh units.
        axis: None for a fixed joint.
        lower: rad or mesh units; None where there is no `<limit>`, and so is `upper`.
    """

    name: str
    type: str
    parent: str
    child: str
    offset: Vector
    axis: Vector | None = None
    lower: float | None = None
    upper: float | None = None


def link_name(number: int) -> str:
    """The URDF's name of a node's link."""
    return f"link_{number}"


def frame_of(node: Node) -> Vector:
    """Where the node's link frame stands, mesh frame: on its axis, or at zero."""
    if node.kind in MOVING and node.parent != ROOT and node.motion is not None:
        return node.motion.origin
    return NOWHERE


def rule_joints(nodes: Sequence[Node]) -> list[RuleJoint]:
    """All joints but those from `base`, node by node; a turning slider makes two, with an empty
    helper link between them, whose joints are numbered after all others."""
    by_id = {node.id: node for node in nodes}
    spare = max(by_id) + 1
    joints: list[RuleJoint] = []
    for node in nodes:
        if node.parent == ROOT:
            continue
        offset = _minus(frame_of(node), frame_of(by_id[node.parent]))
        ends = link_name(node.parent), link_name(node.id)
        if node.motion is None or node.kind not in MOVING:
            joints.append(_joint(node.id, "fixed", *ends, offset))
        elif node.kind == "slider" and node.motion.rotates:
            helper = ends[1] + HELPER
            joints.append(_limited(spare, "prismatic", (ends[0], helper), offset, node))
            axis = node.motion.direction
            joints.append(_joint(node.id, "continuous", helper, ends[1], NOWHERE, axis))
            spare += 1
        else:
            kind = {"hinge": "revolute", "slider": "prismatic"}[node.kind]
            joints.append(_limited(node.id, kind, ends, offset, node))
    return joints


def _joint(
    number: int, kind: str, parent: str, child: str, offset: Vector, axis: Vector | None = None
) -> RuleJoint:
    name = f"joint_{number}"
    return RuleJoint(name=name, type=kind, parent=parent, child=child, offset=offset, axis=axis)


def _limited(
    number: int, kind: str, ends: tuple[str, str], offset: Vector, node: Node
) -> RuleJoint:
    """A joint with the signed axis of the node's motion, and limits unless it is free."""
    motion = node.motion
    if motion is None:
        raise ValueError(f"node {node.id} does not move")
    axis = motion.direction
    if motion.free:
        kind = "continuous" if kind == "revolute" else kind
        return _joint(number, kind, *ends, offset, axis)
    unit = math.radians if kind == "revolute" else float
    x, y, z = (motion.sign * value for value in axis)
    return RuleJoint(
        name=f"joint_{number}",
        type=kind,
        parent=ends[0],
        child=ends[1],
        offset=offset,
        axis=(x, y, z),
        lower=unit(motion.sign * motion.a),
        upper=unit(motion.sign * motion.b),
    )


def _minus(one: Vector, other: Vector) -> Vector:
    x, y, z = (a - b for a, b in zip(one, other, strict=True))
    return x, y, z


def urdf_text(nodes: Sequence[Node], objs: Mapping[int, Sequence[str]], *, name: str) -> str:
    """`mobility.urdf`: `objs[leaf id]` are the stems of its OBJ files."""
    robot = ET.Element("robot", name=name)
    ET.SubElement(robot, "link", name="base")
    joints = {joint.child: joint for joint in rule_joints(nodes)}
    helpers = [joint for child, joint in joints.items() if child.endswith(HELPER)]
    for node in nodes:
        _put_link(robot, node, objs)
        if node.parent == ROOT:
            root = ET.SubElement(robot, "joint", name=f"joint_{node.id}", type="fixed")
            ET.SubElement(root, "origin", rpy=ROOT_RPY, xyz="0 0 0")
            ET.SubElement(root, "child", link=link_name(node.id))
            ET.SubElement(root, "parent", link="base")
        else:
            _put_joint(robot, joints[link_name(node.id)])
    for joint in helpers:
        ET.SubElement(robot, "link", name=joint.child)
        _put_joint(robot, joint)
    ET.indent(robot, " ")
    return '<?xml version="1.0" ?>\n' + ET.tostring(robot, encoding="unicode") + "\n"


def _put_link(robot: ET.Element, node: Node, objs: Mapping[int, Sequence[str]]) -> None:
    link = ET.SubElement(robot, "link", name=link_name(node.id))
    place = exact(_minus(NOWHERE, frame_of(node)))
    for leaf in node.leaves:
        for kind in ("visual", "collision"):
            for stem in objs.get(leaf.id, ()):
                named = {"name": f"{leaf.name}-{leaf.id}"} if kind == "visual" else {}
                shape = ET.SubElement(link, kind, named)
                ET.SubElement(shape, "origin", xyz=place)
                geometry = ET.SubElement(shape, "geometry")
                ET.SubElement(geometry, "mesh", filename=f"textured_objs/{stem}.obj")


def _put_joint(robot: ET.Element, joint: RuleJoint) -> None:
    element = ET.SubElement(robot, "joint", name=joint.name, type=joint.type)
    ET.SubElement(element, "origin", xyz=exact(joint.offset))
    if joint.axis is not None:
        ET.SubElement(element, "axis", xyz=exact(joint.axis))
    ET.SubElement(element, "child", link=joint.child)
    ET.SubElement(element, "parent", link=joint.parent)
    if joint.lower is not None and joint.upper is not None:
        ET.SubElement(element, "limit", lower=exact(joint.lower), upper=exact(joint.upper))
