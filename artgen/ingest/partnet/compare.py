"""Where a folder's URDF says something else than its JSON does by the rule; JSON counts."""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from artgen.core.errors import ArtgenError
from artgen.export.partnet.nodes import Node
from artgen.export.partnet.rule import HELPER, RuleJoint, link_name, rule_joints
from artgen.ingest.partnet.numbering import linked_meshes

CLOSE = 1e-6
"""Units or rad: files of 2019 print six digits after the point."""


def disagreements(
    nodes: Sequence[Node], objs: Mapping[int, Sequence[str]], robot: ET.Element
) -> Iterator[str]:
    """One line for each link or joint that differs.

    Args:
        nodes: without junk, under the numbers of their links.
    """
    meshes = linked_meshes(robot)
    for node in nodes:
        link = link_name(node.id)
        expected = {stem for leaf in node.leaves for stem in objs.get(leaf.id, ())}
        if link not in meshes:
            yield f"URDF has no {link}"
        elif meshes[link] != expected:
            count = len(meshes[link] ^ expected)
            yield f"URDF and JSON differ in {count} meshes of {link}"
    expected_links = {link_name(node.id) for node in nodes}
    for name in sorted(set(meshes) - expected_links):
        if name != "base" and not name.endswith(HELPER):
            yield f"URDF has {name}, which the JSON does not know"
    stated = {_word(joint, "child", "link"): joint for joint in robot.iterfind("joint")}
    for joint in rule_joints(nodes):
        if joint.child not in stated:
            yield f"URDF moves {joint.child} by no joint"
            continue
        yield from _differences(joint, stated[joint.child])


def _differences(rule: RuleJoint, stated: ET.Element) -> Iterator[str]:
    kind = stated.get("type", "")
    if kind != rule.type:
        yield f"URDF joint of {rule.child} is {kind}, JSON says {rule.type}"
        return
    if (parent := _word(stated, "parent", "link")) != rule.parent:
        yield f"URDF hangs {rule.child} on {parent}, JSON on {rule.parent}"
    if not _equal(_word(stated, "origin", "xyz") or "0 0 0", rule.offset):
        yield f"URDF puts {rule.child} elsewhere than the JSON: {_word(stated, 'origin', 'xyz')}"
    if rule.axis is not None and not _equal(_word(stated, "axis", "xyz"), rule.axis):
        yield f"URDF turns the axis of {rule.child}: {_word(stated, 'axis', 'xyz')}"
    if rule.lower is not None and rule.upper is not None:
        for word, value in (("lower", rule.lower), ("upper", rule.upper)):
            if not _equal(_word(stated, "limit", word), (value,)):
                text = _word(stated, "limit", word) or "not stated"
                yield f"URDF {word} limit of {rule.child} is {text}, JSON says {value:.6g}"


def _word(element: ET.Element, tag: str, key: str) -> str:
    found = element.find(tag)
    return "" if found is None else found.get(key, "")


def _equal(text: str, values: Sequence[float]) -> bool:
    """Whether words separated by blanks or commas are these numbers."""
    try:
        found = [float(word) for word in text.replace(",", " ").split()]
    except (ValueError, ArtgenError):
        return False
    return len(found) == len(values) and bool(np.abs(np.subtract(found, values)).max() <= CLOSE)
