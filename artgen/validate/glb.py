"""Bounds of the named nodes of a GLB, from its JSON chunk alone."""

import itertools
import json
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats

MAGIC, JSON_CHUNK = 0x46546C67, 0x4E4F534A


def read_gltf(path: Path) -> Mapping[str, Any]:
    """The glTF document inside a GLB.

    Raises:
        GeometryError: the file is no GLB or is cut short.
    """
    data = path.read_bytes()
    if len(data) < 20:
        raise GeometryError(f"{path.name}: {len(data)} bytes are no GLB; export the asset anew")
    magic, version, length, size, kind = struct.unpack_from("<5I", data)
    if (magic, version, length, kind) != (MAGIC, 2, len(data), JSON_CHUNK):
        raise GeometryError(f"{path.name}: not a whole GLB of version 2; export the asset anew")
    try:
        document: Mapping[str, Any] = json.loads(data[20 : 20 + size])
    except ValueError as error:
        raise GeometryError(f"{path.name}: its JSON cannot be parsed: {error}") from error
    return document


def node_bounds(document: Mapping[str, Any], names: frozenset[str]) -> dict[str, Floats]:
    """Name to (2, 3) bounds in the object frame (z up) of each named node's own geometry.

    A node without a name of its own in `names` counts to its nearest named ancestor.
    """
    nodes = document.get("nodes", [])
    children = {child for node in nodes for child in node.get("children", [])}
    corners: dict[str, list[Floats]] = {}
    waiting = [(i, "", Y_UP_FROM_Z_UP.T) for i in range(len(nodes)) if i not in children]
    while waiting:
        index, owner, pose = waiting.pop()
        node = nodes[index]
        owner = node["name"] if node.get("name") in names else owner
        pose = pose @ _local(node)
        if owner:
            corners.setdefault(owner, []).extend(
                box @ pose[:3, :3].T + pose[:3, 3] for box in _boxes(document, node)
            )
        waiting += [(child, owner, pose) for child in node.get("children", [])]
    stacked = {name: np.concatenate(boxes) for name, boxes in corners.items() if boxes}
    return {name: np.stack([c.min(axis=0), c.max(axis=0)]) for name, c in stacked.items()}


def _local(node: Mapping[str, Any]) -> Floats:
    """(4, 4) transform of a node relative to its parent."""
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, :3] *= node.get("scale", (1.0, 1.0, 1.0))
    pose[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return pose


def _boxes(document: Mapping[str, Any], node: Mapping[str, Any]) -> list[Floats]:
    """(8, 3) corners of each primitive of the node's mesh; glTF requires min and max there."""
    if "mesh" not in node:
        return []
    boxes = []
    for primitive in document["meshes"][node["mesh"]]["primitives"]:
        accessor = document["accessors"][primitive["attributes"]["POSITION"]]
        sides = np.array([accessor["min"], accessor["max"]], float).T
        boxes.append(np.array(list(itertools.product(*sides))))
    return boxes
