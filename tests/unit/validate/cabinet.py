"""A sound little cabinet, and its bundle without Blender: the battery's good asset.

0.6 x 0.4 x 0.7 m: carcass of five boards, a drawer of five above a door with a bar handle. All
clear each other by 2 mm or more.
"""

import json
import math
import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from artgen.articulation.types import (
    ArticulatedObject,
    Joint,
    Limit,
    Mass,
    Part,
    Precondition,
)
from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.jsonio import write_json
from artgen.core.mesh import Floats, TriMesh
from artgen.export.files import write_meshes
from artgen.export.layout import (
    GLB,
    MANIFEST,
    MJCF,
    URDF,
    atlas_path,
    pivots,
)
from artgen.export.manifest import manifest
from artgen.export.mjcf import mjcf_text
from artgen.export.urdf import urdf_text
from artgen.geometry.measure import combined, moments
from artgen.geometry.solid import chamfered_box, slab
from tests.strategies import DENSITY, STEEL, WOOD, Corners, mesh_of, piece

ASSET = "cupboard_000004"

CARCASS: tuple[Corners, ...] = (
    ((-0.3, -0.18, 0.0), (-0.282, 0.205, 0.7)),
    ((0.282, -0.18, 0.0), (0.3, 0.205, 0.7)),
    ((-0.282, -0.18, 0.0), (0.282, 0.195, 0.018)),
    ((-0.282, -0.18, 0.682), (0.282, 0.195, 0.7)),
    ((-0.282, 0.195, 0.0), (0.282, 0.205, 0.7)),
)
DRAWER: tuple[Corners, ...] = (
    ((-0.298, -0.2, 0.502), (0.298, -0.182, 0.698)),
    ((-0.27, -0.182, 0.51), (0.27, 0.17, 0.52)),
    ((-0.27, -0.182, 0.52), (-0.258, 0.17, 0.64)),
    ((0.258, -0.182, 0.52), (0.27, 0.17, 0.64)),
    ((-0.258, 0.158, 0.52), (0.258, 0.17, 0.64)),
)
DOOR: tuple[Corners, ...] = (
    ((-0.298, -0.2, 0.002), (0.298, -0.182, 0.498)),
    ((0.2, -0.205, 0.2), (0.21, -0.2, 0.35)),
)


def board_part(
    name: str, boards: Sequence[Corners], *, density: float = DENSITY, hull: bool = False
) -> Part:
    """A part of boards, each with its own box for collision; `hull` puts a chamfered one last."""
    mesh = mesh_of(boards)
    pieces = [piece(slab(low, high)) for low, high in boards]
    weighed = combined((density, moments(one.triangles)) for one in pieces)
    if hull:
        low, high = np.array(boards[-1])
        foot = ((low + high) / 2.0) * (1.0, 1.0, 0.0) + (0.0, 0.0, low[2])
        pieces[-1] = piece(chamfered_box(high - low, 0.002, at=foot))
    return Part(
        name=name,
        label=name,
        mesh=mesh,
        collision=tuple(pieces),
        mass=Mass(mass=weighed[0], center=weighed[1], inertia=weighed[2]),
        densities=(density,) * len(boards),
    )


SLIDE = Joint(
    name="slide", type="prismatic", parent="base", child="drawer", axis=(0.0, -1.0, 0.0),
    limit=Limit(lower=0.0, upper=0.3), friction=12.0, damping=4.0, effort=60.0,
)  # fmt: skip
HINGE = Joint(
    name="hinge", type="revolute", parent="base", child="door", axis=(0.0, 0.0, -1.0),
    origin=(-0.298, -0.2, 0.0), limit=Limit(lower=0.0, upper=math.radians(110)),
    friction=0.5, damping=0.05, effort=5.0,
)  # fmt: skip


def cupboard(
    *,
    carcass: Sequence[Corners] = CARCASS,
    drawer: Sequence[Corners] = DRAWER,
    door: Sequence[Corners] = DOOR,
    slide: Joint = SLIDE,
    hinge: Joint = HINGE,
    order: Sequence[int] = (0, 1, 2),
    preconditions: tuple[Precondition, ...] = (),
) -> ArticulatedObject:
    """The cabinet, or one with something changed before export."""
    made = (
        board_part("base", carcass),
        board_part("door", door, hull=True),
        board_part("drawer", drawer),
    )
    return ArticulatedObject(
        category="cupboard",
        asset_id=ASSET,
        parts=tuple(made[i] for i in order),
        joints=(hinge, slide),
        surfaces=(WOOD, STEEL),
        preconditions=preconditions,
        provenance={"seed": 7, "index": 4, "rule": {"version": 1, "digest": "0" * 64}},
    )


def write_quick_bundle(obj: ArticulatedObject, folder: Path) -> Path:
    """What `write_bundle` makes of an object, but no USD, and a GLB of positions alone."""
    (folder / "textures").mkdir(parents=True)
    write_meshes(obj, folder)
    image = atlas_path(obj.asset_id)
    Image.new("RGB", (8, 8), (120, 90, 60)).save(folder / image)
    (folder / URDF).write_text(urdf_text(obj))
    (folder / MJCF).write_text(mjcf_text(obj))
    (folder / GLB).write_bytes(plain_glb(obj))
    write_json(folder / MANIFEST, manifest(obj, folder))
    return folder


def plain_glb(obj: ArticulatedObject) -> bytes:
    """A GLB with one node a part at its joint's origin, nested as the joints are."""
    frames, turn = pivots(obj), Y_UP_FROM_Z_UP[:3, :3]
    names = [part.name for part in obj.parts]
    nodes: list[dict[str, object]] = []
    meshes, accessors = [], []
    for index, part in enumerate(obj.parts):
        joint = obj.joint_of(part.name)
        start = frames[joint.parent] if joint else np.zeros(3)
        shift = turn @ (frames[part.name] - start)
        nodes.append({"name": part.name, "mesh": index, "translation": shift.tolist()})
        meshes.append({"primitives": [{"attributes": {"POSITION": index}}]})
        accessors.append(position_accessor(part.mesh, frames[part.name], turn))
    for part, node in zip(obj.parts, nodes, strict=True):
        below = [names.index(j.child) for j in obj.joints if j.parent == part.name]
        if below:
            node["children"] = below
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": nodes, "meshes": meshes, "accessors": accessors,
    }  # fmt: skip
    return packed_glb(document)


def position_accessor(mesh: TriMesh, pivot: Floats, turn: Floats) -> dict[str, object]:
    """Bounds of a mesh in its node's frame, in float32 as in any GLB."""
    points = ((mesh.vertices - pivot) @ turn.T).astype(np.float32).astype(float)
    return {
        "componentType": 5126, "count": len(points), "type": "VEC3",
        "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist(),
    }  # fmt: skip


def packed_glb(document: dict[str, object]) -> bytes:
    """The GLB container around a glTF document."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    header = struct.pack("<5I", 0x46546C67, 2, 20 + len(text), len(text), 0x4E4F534A)
    return header + text
