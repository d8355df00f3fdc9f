"""Which link of the URDF and of semantics.txt is which motion node: junk nodes may shift them."""

import dataclasses
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

from artgen.export.partnet.nodes import ROOT, Node
from artgen.export.partnet.rule import link_name


def without_junk(nodes: Sequence[Node]) -> tuple[Node, ...]:
    """The nodes that are part of the object; what hung on a junk node hangs on its parent."""
    junk = {node.id: node.parent for node in nodes if node.kind == "junk"}
    kept = []
    for node in nodes:
        parent, seen = node.parent, set[int]()
        while parent in junk and parent not in seen:
            seen.add(parent)
            parent = junk[parent]
        if node.kind != "junk":
            kept.append(dataclasses.replace(node, parent=parent if parent not in junk else ROOT))
    return tuple(kept)


def shifted(nodes: Sequence[Node]) -> dict[int, int]:
    """Node id to its number less the junk nodes that the list names before it."""
    numbers, junk = {}, 0
    for node in nodes:
        if node.kind == "junk":
            junk += 1
        else:
            numbers[node.id] = node.id - junk
    return numbers


def numbering(
    nodes: Sequence[Node],
    objs: Mapping[int, Sequence[str]],
    words: Mapping[str, tuple[str, str]],
    robot: ET.Element | None,
) -> dict[int, int]:
    """Node id to the number of its link: its own, or less the junk before it where meshes of the
    URDF and kinds of semantics.txt agree better so."""
    plain = {node.id: node.id for node in nodes if node.kind != "junk"}
    moved = shifted(nodes)
    meshes = {} if robot is None else linked_meshes(robot)

    def agreement(numbers: Mapping[int, int]) -> int:
        kept = [node for node in nodes if node.kind != "junk"]
        told = [words.get(link_name(numbers[node.id]), ("", ""))[0] for node in kept]
        same = sum(word.rstrip("+") == node.kind for word, node in zip(told, kept, strict=True))
        stems = [{stem for leaf in node.leaves for stem in objs.get(leaf.id, ())} for node in kept]
        return same + sum(
            bool(own) and meshes.get(link_name(numbers[node.id])) == own
            for own, node in zip(stems, kept, strict=True)
        )

    return moved if agreement(moved) > agreement(plain) else plain


def linked_meshes(robot: ET.Element) -> dict[str, set[str]]:
    """Link to the stems of the meshes it shows."""
    return {
        link.get("name", ""): {
            mesh.get("filename", "").rpartition("/")[2].removesuffix(".obj")
            for mesh in link.iterfind("visual/geometry/mesh")
        }
        for link in robot.iterfind("link")
    }


def renumbered(nodes: Sequence[Node], numbers: Mapping[int, int]) -> tuple[Node, ...]:
    """Nodes under the numbers of their links."""
    return tuple(
        dataclasses.replace(node, id=numbers[node.id], parent=numbers.get(node.parent, node.parent))
        for node in nodes
    )
