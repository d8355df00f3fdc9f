"""write_partnet: an object of ours as a folder of PartNet-Mobility's layout."""

import json
import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.types import ArticulatedObject, Joint, Part
from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.jsonio import content_hash, plain
from artgen.core.mesh import Floats
from artgen.export.kinematics import vector
from artgen.export.partnet.fragments import Fragment, fragment_mtl, fragment_obj, fragments_of
from artgen.export.partnet.nodes import ROOT, Leaf, Motion, Node, mobility_json
from artgen.export.partnet.rule import link_name, urdf_text

NOTE = "artgen.json"
"""A file of ours beside theirs: the scale, the licence, and what their format cannot say."""
NOTE_SCHEMA = "artgen-partnet/1"
OBJS = "textured_objs"
IMAGES = "images"
KIND = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slider"}
WORDS = {
    ("door", "revolute"): "rotation_door",
    ("door", "prismatic"): "translation_door",
    ("lid", "revolute"): "rotation_lid",
    ("lid", "prismatic"): "translation_lid",
    ("tray", "prismatic"): "translation_tray",
}
"""Role and joint type to the word of `semantics.txt`, where it is not the role."""


@dataclass(frozen=True, kw_only=True)
class PartTree:
    """Which leaf and which files hold each part's bodies; the base part is the last entry."""

    parts: tuple[Part, ...]
    leaves: Mapping[str, tuple[Leaf, ...]]
    stems: Mapping[int, tuple[str, ...]]
    fragments: tuple[Fragment, ...]


def write_partnet(
    obj: ArticulatedObject,
    folder: Path,
    images: Mapping[str, bytes],
    *,
    doubled: bool = False,
    licence: object = None,
    digest: str | None = None,
) -> None:
    """Fill `folder`, which exists.

    The largest vertex radius about the middle of the object becomes 1 unit; what the format cannot
    say (friction, springs, mimics, preconditions, masses, grips) is named in `artgen.json`.

    Args:
        images: surface name to the content of a PNG file: its color over one tile.
        doubled: write every face a second time, turned around.
        licence: terms of the object, as `artgen.json` states them.
        digest: hash of the manifest of the bundle that it is written from, if any.
    """
    unit, mesh_from_object = normalization(obj)
    tree = part_tree(obj)
    nodes = motion_nodes(obj, tree, mesh_from_object, unit)
    _write_fragments(obj, tree, folder, images, mesh_from_object, doubled)
    _json(folder / "mobility_v2.json", mobility_json(nodes))
    _text(folder / "mobility.urdf", urdf_text(nodes, tree.stems, name=f"partnet_{_model_id(obj)}"))
    _json(folder / "result.json", [_result(obj, tree)])
    _json(folder / "meta.json", _meta(obj))
    _json(folder / "bounding_box.json", _box(obj, mesh_from_object))
    _text(folder / "semantics.txt", semantics(obj, tree))
    _json(folder / NOTE, _note(obj, unit, mesh_from_object, licence, digest))


def normalization(obj: ArticulatedObject) -> tuple[float, Floats]:
    """Meters a unit, and `mesh_from_object` (3, 4): y up, front +z, largest radius 1."""
    vertices = np.concatenate([part.mesh.vertices for part in obj.parts])
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    unit = float(np.linalg.norm(vertices - middle, axis=1).max())
    turn = Y_UP_FROM_Z_UP[:3, :3] / unit
    return unit, np.concatenate([turn, -(turn @ middle)[:, None]], axis=1)


def part_tree(obj: ArticulatedObject) -> PartTree:
    """Leaves and files of all parts; leaf ids follow each other, inner ids come after them."""
    parts = (*obj.parts[1:], obj.parts[0])
    leaves: dict[str, tuple[Leaf, ...]] = {}
    stems: dict[int, tuple[str, ...]] = {}
    fragments: list[Fragment] = []
    for part in parts:
        own = fragments_of(part, first=len(fragments) + 1)
        grouped: dict[str, list[Fragment]] = defaultdict(list)
        for fragment in own:
            grouped[fragment.leaf].append(fragment)
        listed = []
        for name, members in grouped.items():
            leaf = Leaf(id=len(stems) + 1, name=name)
            stems[leaf.id] = tuple(fragment.stem for fragment in members)
            listed.append(leaf)
        leaves[part.name] = tuple(listed)
        fragments += own
    return PartTree(parts=parts, leaves=leaves, stems=stems, fragments=tuple(fragments))


def motion_nodes(
    obj: ArticulatedObject, tree: PartTree, mesh_from_object: Floats, unit: float
) -> list[Node]:
    """Movers in the object's order, then the base as the heavy root."""
    numbers = {part.name: number for number, part in enumerate(tree.parts)}
    nodes = []
    for part in tree.parts:
        joint = obj.joint_of(part.name)
        nodes.append(
            Node(
                id=numbers[part.name],
                parent=ROOT if joint is None else numbers[joint.parent],
                kind="heavy" if joint is None else KIND[joint.type],
                name=tree.leaves[part.name][0].name,
                leaves=tree.leaves[part.name],
                motion=None if joint is None else _motion(joint, mesh_from_object, unit),
            )
        )
    return nodes


def _motion(joint: Joint, mesh_from_object: Floats, unit: float) -> Motion:
    """Start is the lower limit, end the upper; degrees or mesh units."""
    turn, shift = mesh_from_object[:, :3], mesh_from_object[:, 3]
    size = math.degrees(1.0) if joint.type == "revolute" else 1.0 / unit
    lower, upper = (0.0, 0.0) if joint.limit is None else (joint.limit.lower, joint.limit.upper)
    return Motion(
        origin=vector(turn @ np.array(joint.origin) + shift),
        direction=vector(turn @ np.array(joint.axis) * unit),
        a=lower * size,
        b=upper * size,
        free=joint.limit is None,
    )


def semantics(obj: ArticulatedObject, tree: PartTree) -> str:
    """`semantics.txt`: link, kind and label a line."""
    lines = []
    for number, part in enumerate(tree.parts):
        joint = obj.joint_of(part.name)
        if joint is None:
            lines.append(f"{link_name(number)} heavy {obj.category}_body")
        else:
            word = WORDS.get((part.label, joint.type.replace("continuous", "revolute")), part.label)
            lines.append(f"{link_name(number)} {KIND[joint.type]} {word}")
    return "\n".join(lines) + "\n"


def _write_fragments(
    obj: ArticulatedObject,
    tree: PartTree,
    folder: Path,
    images: Mapping[str, bytes],
    mesh_from_object: Floats,
    doubled: bool,
) -> None:
    (folder / OBJS).mkdir()
    names = {name: f"texture_{number}.png" for number, name in enumerate(sorted(images))}
    if names:
        (folder / IMAGES).mkdir()
    for name, file in names.items():
        (folder / IMAGES / file).write_bytes(images[name])
    paths = {name: f"../{IMAGES}/{file}" for name, file in names.items()}
    meshes = {part.name: part.mesh for part in obj.parts}
    for fragment in tree.fragments:
        mesh = meshes[fragment.part]
        text = fragment_obj(mesh, fragment, obj.surfaces, mesh_from_object, doubled=doubled)
        slots = np.unique(np.asarray(mesh.slot)[np.asarray(mesh.body) == fragment.body]).tolist()
        _text(folder / OBJS / f"{fragment.stem}.obj", text)
        _text(folder / OBJS / f"{fragment.stem}.mtl", fragment_mtl(obj.surfaces, slots, paths))


def _result(obj: ArticulatedObject, tree: PartTree) -> dict[str, Any]:
    """The part tree: the object, its parts, their leaves with the stems of their files."""
    inner = len(tree.stems) + 1
    children = []
    for number, part in enumerate(tree.parts):
        leaves = [
            {"id": leaf.id, "name": leaf.name, "text": leaf.name, "objs": [*tree.stems[leaf.id]]}
            for leaf in tree.leaves[part.name]
        ]
        node = {"id": inner + number, "name": part.label, "text": part.name, "children": leaves}
        children.append(node)
    return {"id": 0, "name": obj.category, "text": obj.category, "children": children}


def _model_id(obj: ArticulatedObject) -> str:
    return content_hash([obj.category, obj.asset_id])[:32]


def _meta(obj: ArticulatedObject) -> dict[str, Any]:
    return {
        "model_id": _model_id(obj),
        "anno_id": obj.asset_id,
        "user_id": "artgen",
        "time_in_sec": "0",
        "version": "v1",
        "model_cat": "".join(word.capitalize() for word in obj.category.split("_")),
    }


def _box(obj: ArticulatedObject, mesh_from_object: Floats) -> dict[str, list[float]]:
    points = np.concatenate([part.mesh.vertices for part in obj.parts])
    moved = points @ mesh_from_object[:, :3].T + mesh_from_object[:, 3]
    return {"min": moved.min(axis=0).tolist(), "max": moved.max(axis=0).tolist()}


def _note(
    obj: ArticulatedObject,
    unit: float,
    mesh_from_object: Floats,
    licence: object,
    digest: str | None,
) -> dict[str, Any]:
    """Scale, origin and what was left out."""
    lost = {
        "springs": [joint.name for joint in obj.joints if joint.spring is not None],
        "latches": [joint.name for joint in obj.joints if joint.latch is not None],
        "mimics": [joint.name for joint in obj.joints if joint.mimic is not None],
        "preconditions": [rule.joint for rule in obj.preconditions],
        "grips": [grip.name for part in obj.parts for grip in part.grips],
    }
    kept = {key: obj.provenance[key] for key in ("source", "donors") if key in obj.provenance}
    source = obj.provenance.get("source")
    family = source.get("family") if isinstance(source, Mapping) else None
    return {
        "schema": NOTE_SCHEMA,
        "asset_id": obj.asset_id,
        "family": family or obj.asset_id,
        "meters_per_unit": unit,
        "mesh_from_object": mesh_from_object,
        "left_out": {key: names for key, names in lost.items() if names},
        "licence": licence,
        "digest": digest,
        **kept,
    }


def _json(path: Path, value: Sequence[Any] | Mapping[str, Any]) -> None:
    _text(path, json.dumps(plain(value), allow_nan=False, indent=1) + "\n")


def _text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")
