"""SINGAPO's `object.json` (CAGE's form too): a tree of boxes with joints, y up, front +z.

Angles are in degrees, lengths in the unit of the file; a range is [0, end], and a negative end
turns the axis around here. Screw joints are not moved by SINGAPO's metrics, so they count as fixed.
"""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from artgen.core.errors import ArtgenError, ModelError
from artgen.core.mesh import Floats, TriMesh
from artgen.validate.meshfile import as_bodies, read_mesh
from model.evaluation.adapters.stated_row import Row
from model.evaluation.layout import Layout, unit_axes
from model.evaluation.reshape import turned

Y_UP = np.array([(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)])
"""Turns y up and front +z to z up and front -y."""
TYPES = {
    "fixed": FIXED,
    "screw": FIXED,
    "revolute": REVOLUTE,
    "continuous": REVOLUTE,
    "prismatic": PRISMATIC,
}
TREES = ("diffuse_tree", "arti_tree")


def layout_of_singapo(file: Path) -> Layout:
    """The layout that the file states, in our axes, base first and the others in its order.

    Raises:
        ModelError: the file is not of this form.
    """
    try:
        read = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise ModelError(
            f"{file} is no object.json of SINGAPO ({error}); expected `diffuse_tree` with id, "
            "parent, name, aabb and joint of every part"
        ) from error
    stated = Row(file, "the file", read)
    nodes = [_node(Row(file, f"part {k}", node)) for k, node in enumerate(_listed(stated))]
    meta = stated.stated.get("meta")
    category = meta.get("obj_cat", "") if isinstance(meta, dict) else ""
    return turned(_layout(file, str(category), nodes), Y_UP)


def _listed(stated: Row) -> list[Any]:
    key = next((key for key in TREES if key in stated), TREES[0])
    nodes = stated.value(key)
    if not isinstance(nodes, list) or not nodes:
        raise ModelError(f"{stated.file}: {key} is {nodes!r:.80}, expected a list with a base")
    return nodes


@dataclass(frozen=True, eq=False)
class _Node:
    """A part and its joint in the file's axes; `end` in rad or lengths, vectors (3,)."""

    own: int | str
    parent: int | str
    name: str
    center: Floats
    size: Floats
    kind: str
    end: float
    axis: Floats
    origin: Floats
    plys: list[Any]


def _node(row: Row) -> _Node:
    joint, box = row.below("joint"), row.below("aabb")
    kind = joint.value("type")
    if not isinstance(kind, str) or kind not in TYPES:
        known = ", ".join(sorted(TYPES))
        raise ModelError(f"{row.file}: joint type {kind!r:.80} of {row.told} is none of {known}")
    moves = TYPES[kind] != FIXED  # What a fixed joint states beside its type is passed over.
    end = float(joint.numbers("range", 2)[1]) if moves and "range" in joint else 0.0
    axis = joint.below("axis") if moves and "axis" in joint else None
    plys = row.value("plys") if "plys" in row else None
    return _Node(
        own=row.name("id"),
        parent=row.name("parent"),
        name=str(row.value("name")),
        center=box.vector("center"),
        size=box.vector("size"),
        kind=kind,
        end=math.radians(end) if TYPES[kind] == REVOLUTE else end,
        axis=np.zeros(3) if axis is None else axis.vector("direction"),
        origin=axis.vector("origin") if axis is not None and "origin" in axis else np.zeros(3),
        plys=plys if isinstance(plys, list) else [],
    )


def _layout(file: Path, category: str, nodes: list[_Node]) -> Layout:
    ordered = sorted(nodes, key=lambda node: node.parent != -1)
    places = {node.own: k for k, node in enumerate(ordered)}
    if len(places) < len(ordered):
        raise ModelError(f"{file}: {len(ordered)} parts have {len(places)} ids; each needs its own")
    types = np.array([FIXED, *(TYPES[node.kind] for node in ordered[1:])], np.int8)
    boxes = [(node.center - node.size / 2.0, node.center + node.size / 2.0) for node in ordered]
    ends = np.array([node.end for node in ordered]) * (types != FIXED)
    axes = unit_axes([node.axis for node in ordered], types)
    origins = np.array([node.origin for node in ordered])
    return Layout(
        name=file.parent.name,
        category=category,
        labels=tuple(node.name for node in ordered),
        boxes=np.array(boxes),
        types=types,
        endless=np.array([node.kind == "continuous" for node in ordered]) & (types == REVOLUTE),
        axes=axes * np.where(ends < 0.0, -1.0, 1.0)[:, None],
        origins=np.where((types == REVOLUTE)[:, None], origins, 0.0),
        limits=np.stack([np.zeros(len(ends)), np.abs(ends)], axis=1),
        parents=np.array([places.get(node.parent, -1) for node in ordered], np.int64),
        meshes=tuple(_mesh(file.parent, node.plys) for node in ordered),
    )


def _mesh(folder: Path, names: list[Any]) -> TriMesh | None:
    """The part's meshes together; None where one is not at hand."""
    read = []
    for name in names:
        path = folder / str(name)
        if not path.resolve().is_relative_to(folder.resolve()) or not path.is_file():
            return None
        try:
            read.append(read_mesh(path, np.ones(3)))
        except (ArtgenError, OSError):
            return None
    if not read:
        return None
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in read[:-1])])
    faces = [mesh.faces + start for mesh, start in zip(read, starts, strict=True)]
    return as_bodies(np.concatenate([m.vertices for m in read]), np.concatenate(faces))
