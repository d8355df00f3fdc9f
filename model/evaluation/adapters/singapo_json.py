"""SINGAPO's `object.json` (CAGE's form too): a tree of boxes with joints, y up, front +z.

Angles are in degrees, lengths in the unit of the file; a range is [0, end], and a negative end
turns the axis around here. Screw joints are not moved by SINGAPO's metrics, so they count as fixed.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from artgen.core.errors import ArtgenError, ModelError
from artgen.core.mesh import TriMesh
from artgen.validate.meshfile import as_bodies, read_mesh
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
        stated = json.loads(file.read_text(encoding="utf-8"))
        nodes = next(stated[key] for key in TREES if key in stated)
        return turned(_layout(file, stated, nodes), Y_UP)
    except (OSError, ValueError, KeyError, TypeError, StopIteration) as error:
        raise ModelError(
            f"{file} is no object.json of SINGAPO ({error!r}); expected `diffuse_tree` with id, "
            "parent, name, aabb and joint of every part"
        ) from error


def _layout(file: Path, stated: dict[str, Any], nodes: list[dict[str, Any]]) -> Layout:
    ordered = sorted(nodes, key=lambda node: node["parent"] != -1)
    places = {node["id"]: k for k, node in enumerate(ordered)}
    kinds = [node["joint"]["type"] for node in ordered]
    types = np.array([TYPES[kind] for kind in kinds], np.int8)
    types[0] = FIXED
    centers = np.array([node["aabb"]["center"] for node in ordered], float)
    halves = np.array([node["aabb"]["size"] for node in ordered], float) / 2.0
    axes = [node["joint"].get("axis", {}).get("direction", (0.0, 0.0, 0.0)) for node in ordered]
    origins = [node["joint"].get("axis", {}).get("origin", (0.0, 0.0, 0.0)) for node in ordered]
    ends = np.array([float(node["joint"].get("range", (0.0, 0.0))[1]) for node in ordered])
    ends = np.where(types == REVOLUTE, np.radians(ends), ends) * (types != FIXED)
    return Layout(
        name=file.parent.name,
        category=str(stated.get("meta", {}).get("obj_cat", "")),
        labels=tuple(str(node["name"]) for node in ordered),
        boxes=np.stack([centers - halves, centers + halves], axis=1),
        types=types,
        endless=np.array([kind == "continuous" for kind in kinds]) & (types == REVOLUTE),
        axes=unit_axes(axes, types) * np.where(ends < 0.0, -1.0, 1.0)[:, None],
        origins=np.where((types == REVOLUTE)[:, None], np.array(origins, float), 0.0),
        limits=np.stack([np.zeros(len(ends)), np.abs(ends)], axis=1),
        parents=np.array([places.get(node["parent"], -1) for node in ordered], np.int64),
        meshes=tuple(_mesh(file.parent, node.get("plys", ())) for node in ordered),
    )


def _mesh(folder: Path, names: list[str]) -> TriMesh | None:
    """The part's meshes together; None where one is not at hand."""
    read = []
    for name in names:
        path = folder / name
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
