"""A PartNet-Mobility folder as a ForeignObject: JSON for the kinematics, labels from semantics."""

import math
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.types import JointType
from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.errors import ArtgenError, IngestError
from artgen.core.jsonio import content_hash, file_hash
from artgen.export.kinematics import vector
from artgen.export.partnet.nodes import MOVING, ROOT, Node
from artgen.export.partnet.rule import link_name
from artgen.export.partnet.write import NOTE, NOTE_SCHEMA, OBJS
from artgen.ingest.foreign import ForeignJoint, ForeignObject, ForeignPart, ForeignShape
from artgen.ingest.meshes.objfile import read_obj_soup
from artgen.ingest.partnet.compare import disagreements
from artgen.ingest.partnet.files import (
    read_json,
    read_leaves,
    read_meta,
    read_nodes,
    read_semantics,
)
from artgen.ingest.partnet.numbering import numbering, renumbered, without_junk
from artgen.validate.places import inside
from artgen.validate.xmlfile import read_xml

DATASET = "partnet-mobility"
OWN_EXPORT = "artgen-export"
"""The data set of folders that `artgen export partnet` wrote."""
OBJECT_FROM_MESH = Y_UP_FROM_Z_UP[:3, :3].T
"""Mesh frame (y up, front +z) to ours (z up, front -y)."""
REQUIRED = ("meta.json", "mobility_v2.json", "result.json", OBJS)
MOST_SHOWN = 5
"""Lines of one kind in a report; the rest is counted."""


def read_partnet(root: Path) -> ForeignObject:
    """The object in the folder `root`, whose name is the object's id: `anno_id` is not, as folders
    of six digits have that of another object.

    Raises:
        IngestError: a file that is needed is missing or damaged, or the nodes make no tree.
    """
    if missing := [name for name in REQUIRED if not (root / name).exists()]:
        raise IngestError(
            f"{', '.join(missing)} missing; a PartNet-Mobility folder holds {', '.join(REQUIRED)}"
        )
    meta = read_meta(root)
    named, objs = read_leaves(root)
    stated, words = read_nodes(root), read_semantics(root)
    robot, doubts = _urdf(root)
    numbers = numbering(stated, objs, words, robot)
    nodes = renumbered(without_junk(stated), numbers)
    if junk := len(stated) - len(nodes):
        doubts.append(f"{junk} junk nodes are left out")
    if any(number != node for node, number in numbers.items()):
        doubts.append("links are numbered without the junk nodes")
    tree = _Tree(nodes, doubts)
    if robot is not None:
        doubts += shortened(disagreements(nodes, objs, robot))
    if named and meta.category and _word(named) != _word(meta.category):
        doubts.append(f"meta.json says {meta.category}, result.json {named}; meta.json counts")
    parts = tuple(_part(root, name, own, objs, words) for name, own in tree.groups.items())
    note = _note(root)
    meters = note.get("meters_per_unit")
    return ForeignObject(
        dataset=OWN_EXPORT if note else DATASET,
        id=root.absolute().name,
        category=meta.category or named,
        digest=annotation_digest(root),
        parts=parts,
        joints=tuple(_joint(node, tree) for node in tree.movers),
        object_from_source=np.array(OBJECT_FROM_MESH),
        doubts=(*doubts, *shortened(unused(root, nodes, objs))),
        meters_per_unit=float(meters) if isinstance(meters, int | float) else None,
        anno_id=meta.anno_id or None,
        note=note,
    )


def shortened(lines: Iterator[str]) -> list[str]:
    """The first few lines, and how many more there are."""
    listed = list(lines)
    more = [f"and {len(listed) - MOST_SHOWN} more such lines"] * (len(listed) > MOST_SHOWN)
    return [*listed[:MOST_SHOWN], *more]


def _word(name: str) -> str:
    """A category's name without what its spellings differ in."""
    return "".join(c for c in name.lower() if c.isalnum())


def _urdf(root: Path) -> tuple[ET.Element | None, list[str]]:
    """The folder's URDF as a cross-check, None where it is not there or cannot be read."""
    if not (root / "mobility.urdf").exists():
        return None, []
    try:
        return read_xml(inside(root, root, "mobility.urdf")), []
    except (ArtgenError, OSError, ET.ParseError, ValueError) as error:
        return None, [f"mobility.urdf is not used: {error}"]


def _note(root: Path) -> Mapping[str, Any]:
    """What a folder that artgen wrote says of itself."""
    if not (root / NOTE).exists():
        return {}
    stated = read_json(root, NOTE)
    ours = isinstance(stated, dict) and stated.get("schema") == NOTE_SCHEMA
    return stated if ours else {}


def annotation_digest(root: Path) -> str:
    """Of the annotation: what says which object this is, wherever its folder lies."""
    return content_hash([file_hash(root / name) for name in REQUIRED[:3]])


@dataclass(init=False)
class _Tree:
    """Nodes in groups that move as one, the base's first.

    Attributes:
        groups: link name of the node that moves a group to its nodes.
        movers: nodes with a joint of their own, parents before children.
        owner: node id to the name of its group.
    """

    groups: dict[str, list[Node]]
    movers: list[Node]
    owner: dict[int, str]

    def __init__(self, nodes: Sequence[Node], doubts: list[str]) -> None:
        below: dict[int, list[Node]] = defaultdict(list)
        known = {node.id for node in nodes}
        for node in nodes:
            if node.parent != ROOT and node.parent not in known:
                raise IngestError(f"node {node.id} hangs on node {node.parent}, which is not there")
            below[node.parent].append(node)
        roots = below[ROOT]
        if not roots:
            raise IngestError("no motion node is a root")
        base = max(roots, key=lambda node: (_size(node, below), node.id))
        if len(roots) > 1:
            doubts.append(f"{len(roots)} roots; all are fixed to {link_name(base.id)}")
        self.groups, self.movers = {link_name(base.id): []}, []
        self.owner = {}
        waiting = [base, *(node for node in roots if node is not base)]
        while waiting:
            node = waiting.pop(0)
            moves = node.kind in MOVING and node.parent != ROOT
            name = link_name(base.id if node.parent == ROOT else node.id)
            name = name if moves or node.parent == ROOT else self.owner[node.parent]
            self.groups.setdefault(name, []).append(node)
            self.owner[node.id] = name
            self.movers += [node] if moves else []
            waiting += below[node.id]
        if len(self.owner) != len(nodes):
            raise IngestError("motion nodes hang on each other in a circle")


def _size(node: Node, below: Mapping[int, Sequence[Node]]) -> int:
    """How many nodes hang on a root; a circle cannot be reached from one."""
    count, waiting = 0, [node]
    while waiting:
        count += 1
        waiting += below.get(waiting.pop().id, ())
    return count


def _part(
    root: Path,
    name: str,
    nodes: Sequence[Node],
    objs: Mapping[int, Sequence[str]],
    words: Mapping[str, tuple[str, str]],
) -> ForeignPart:
    shapes = [
        ForeignShape(leaf=leaf.name, label=f"{stem}.obj", read=partial(_read, root, stem))
        for node in nodes
        for leaf in node.leaves
        for stem in objs.get(leaf.id, ())
    ]
    _, word = words.get(name, ("", nodes[0].name))
    return ForeignPart(name=name, word=word, shapes=tuple(shapes))


def _read(root: Path, stem: str) -> Any:
    return read_obj_soup(inside(root, root / OBJS, f"{stem}.obj"), root)


def _joint(node: Node, tree: _Tree) -> ForeignJoint:
    """The joint of a node, along the direction that the JSON states; a may be above b."""
    motion = node.motion
    if motion is None:
        raise IngestError(f"node {node.id} moves without an axis")
    kind: JointType = "prismatic"
    if node.kind == "hinge":
        kind = "continuous" if motion.free else "revolute"
    unit = math.radians if kind == "revolute" else float
    a, b = unit(motion.a), unit(motion.b)
    direction = np.array(motion.direction)
    stops = kind != "continuous" and not motion.free
    return ForeignJoint(
        name=f"joint_{node.id}",
        type=kind,
        parent=tree.owner[node.parent],
        child=link_name(node.id),
        axis=vector(direction / np.linalg.norm(direction)),
        origin=motion.origin,
        lower=min(a, b) if stops else None,
        upper=max(a, b) if stops else None,
        start=a if stops else None,
        turns=motion.rotates,
        number=str(node.id),
    )


def unused(root: Path, nodes: Sequence[Node], objs: Mapping[int, Sequence[str]]) -> Iterator[str]:
    """Meshes in the folder that no node names."""
    named = {stem for node in nodes for leaf in node.leaves for stem in objs.get(leaf.id, ())}
    there = {path.stem for path in (root / OBJS).glob("*.obj")}
    if extra := len(there - named):
        yield f"{extra} meshes belong to no link and are left out"
