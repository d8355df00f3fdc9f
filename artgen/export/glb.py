"""GLB: the job that Blender's exporter runs, and what the file's extras say about joints.

glTF is y up. Everything in the extras is in the frame of its node: y up, at the joint's origin, so
that a reader needs no knowledge of our frames.
"""

import dataclasses
import json
import struct
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.types import ArticulatedObject, Grip, Joint, Latch, Mimic, Part, Spring
from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.errors import ExportError
from artgen.core.jsonio import plain
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.export import layout
from artgen.export.kinematics import (
    FileGrip,
    FileJoint,
    FileKinematics,
    FileMass,
    as_file_grip,
    vector,
)
from artgen.export.layout import GLB, pivots
from artgen.export.surface_images import SurfaceImages
from artgen.finish_jobs import (
    GltfArrays,
    GltfImages,
    GltfJob,
    GltfPart,
    GltfSurface,
    OcclusionBake,
    write_gltf_arrays,
)
from artgen.geometry.normals import corner_normals
from artgen.worker import BlenderWorker

TIMEOUT_S = 120.0
"""A GLB takes about a second; the limit is for a machine under heavy load."""
TURN = Y_UP_FROM_Z_UP[:3, :3]


def write_glb(
    obj: ArticulatedObject,
    folder: Path,
    images: Mapping[str, SurfaceImages],
    worker: BlenderWorker,
    *,
    occlusion: bool = False,
) -> None:
    """Have Blender write `folder`/asset.glb; images lie in `folder` already.

    Args:
        occlusion: also bake ambient occlusion onto the atlas, about 5 CPU s.

    Raises:
        WorkerError: Blender failed.
    """
    with tempfile.TemporaryDirectory() as scratch:
        arrays = Path(scratch) / "arrays.npz"
        write_gltf_arrays(arrays, {part.name: part_arrays(part, obj) for part in obj.parts})
        job = gltf_job(obj, folder, images, arrays)
        if occlusion:
            baked = folder.resolve() / layout.occlusion_path(obj.asset_id)
            job = dataclasses.replace(job, occlusion=OcclusionBake(output=str(baked)))
        worker.run(plain(job), timeout_s=TIMEOUT_S)


def gltf_job(
    obj: ArticulatedObject, folder: Path, images: Mapping[str, SurfaceImages], arrays: Path
) -> GltfJob:
    """Nodes at the joints' origins, nested as the joints are."""
    frames = pivots(obj)
    parents = {joint.child: joint.parent for joint in obj.joints}
    return GltfJob(
        parts=tuple(
            GltfPart(
                name=part.name,
                parent=parents.get(part.name),
                origin=vector(frames[part.name]),
                extras=part_extras(obj, part, frames[part.name]),
            )
            for part in parents_first(obj)
        ),
        surfaces=tuple(_surface(spec, folder, images) for spec in obj.surfaces),
        extras=scene_extras(obj),
        arrays=str(arrays),
        output=str(folder.resolve() / GLB),
    )


def parents_first(obj: ArticulatedObject) -> list[Part]:
    """Parts in the order of their joints: canonical order may put a child before its parent."""
    parts = {part.name: part for part in obj.parts}
    return [obj.base, *(parts[joint.child] for joint in obj.joints)]


def part_arrays(part: Part, obj: ArticulatedObject) -> GltfArrays:
    """Triangles with corner normals and both UV sets."""
    mesh = part.mesh
    if mesh.uv is None or mesh.atlas is None:
        raise ExportError(f"part {part.name} has no texture coordinates; finish the object first")
    slot = np.asarray(mesh.slot)
    tiles = np.array([surface.tile for surface in obj.surfaces])
    return GltfArrays(
        vertices=mesh.vertices,
        faces=mesh.faces,
        normals=corner_normals(mesh),
        uv=mesh.uv / tiles[slot][:, None, :],
        atlas=mesh.atlas,
        slot=slot,
    )


def _surface(spec: SurfaceSpec, folder: Path, images: Mapping[str, SurfaceImages]) -> GltfSurface:
    own = plain(images.get(spec.name, SurfaceImages()))
    paths = {kind: path and str(folder.resolve() / path) for kind, path in own.items()}
    return GltfSurface.of(spec, GltfImages(**paths))


def scene_extras(obj: ArticulatedObject) -> dict[str, Any]:
    """What concerns the whole object."""
    extras: dict[str, Any] = plain(
        {
            "asset_id": obj.asset_id,
            "category": obj.category,
            "frame": "y up, front +z; a node's extras are in the node's frame; m, kg, rad",
            "preconditions": obj.preconditions,
        }
    )
    return extras


def part_extras(obj: ArticulatedObject, part: Part, pivot: Floats) -> dict[str, Any]:
    """Label, mass properties and the joint that moves the node, in the node's frame."""
    extras = {
        "label": part.label,
        "mass": part.mass.mass,
        "center_of_mass": TURN @ (part.mass.center - pivot) + 0.0,
        "inertia": TURN @ part.mass.inertia @ TURN.T + 0.0,
    }
    joint = obj.joint_of(part.name)
    if joint is not None:
        extras["joint"] = joint_extras(joint)
    if part.grips:
        extras["grips"] = [grip_extras(grip, pivot) for grip in part.grips]
    turned: dict[str, Any] = plain(extras)
    return turned


def joint_extras(joint: Joint) -> dict[str, Any]:
    """All of a joint but its parent and origin, which the node tree and translation state."""
    return {
        "name": joint.name,
        "type": joint.type,
        "axis": TURN @ joint.axis + 0.0,
        "limit": joint.limit,
        "friction": joint.friction,
        "damping": joint.damping,
        "effort": joint.effort,
        "velocity": joint.velocity,
        "spring": joint.spring,
        "latch": joint.latch,
        "mimic": joint.mimic,
    }


def grip_extras(grip: Grip, pivot: Floats) -> dict[str, Any]:
    """A grip in the node's frame."""
    return {
        "name": grip.name,
        "kind": grip.kind,
        "position": TURN @ (grip.position - pivot) + 0.0,
        "outward": TURN @ grip.outward + 0.0,
        "pull": TURN @ grip.pull + 0.0,
    }


def read_document(path: Path) -> dict[str, Any]:
    """The JSON chunk of a GLB.

    Raises:
        ExportError: the file is no GLB.
    """
    with path.open("rb") as stream:
        header = stream.read(20)
        if len(header) < 20 or header[:4] != b"glTF" or header[16:20] != b"JSON":
            raise ExportError(f"{path} is not a GLB file; export the asset anew")
        document: dict[str, Any] = json.loads(stream.read(struct.unpack_from("<I", header, 12)[0]))
        return document


def load_kinematics(folder: Path) -> FileKinematics:
    """Parts and joints of `folder`/asset.glb in the object frame."""
    document = read_document(folder / GLB)
    nodes = document["nodes"]
    masses: dict[str, FileMass | None] = {}
    joints: list[FileJoint] = []
    grips: list[FileGrip] = []
    roots: list[int] = document["scenes"][document.get("scene", 0)]["nodes"]
    waiting = [(index, "", np.zeros(3)) for index in roots]
    while waiting:
        index, parent, frame = waiting.pop(0)
        node = nodes[index]
        pivot = frame + TURN.T @ np.array(node.get("translation", (0.0, 0.0, 0.0)))
        masses[node["name"]] = _file_mass(node["extras"], pivot)
        if (stated := node["extras"].get("joint")) is not None:
            joints.append(_file_joint(stated, parent, node["name"], pivot))
        grips += [_file_grip(g, node["name"], pivot) for g in node["extras"].get("grips", ())]
        waiting += [(child, node["name"], pivot) for child in node.get("children", ())]
    base = nodes[roots[0]]["name"]
    return FileKinematics(base=base, masses=masses, joints=tuple(joints), grips=tuple(grips))


def _file_grip(stated: Mapping[str, Any], part: str, pivot: Floats) -> FileGrip:
    grip = Grip(
        name=stated["name"],
        kind=stated["kind"],
        position=vector(pivot + TURN.T @ np.array(stated["position"])),
        outward=vector(TURN.T @ np.array(stated["outward"])),
        pull=vector(TURN.T @ np.array(stated["pull"])),
    )
    return as_file_grip(part, grip)


def _file_mass(extras: Mapping[str, Any], pivot: Floats) -> FileMass:
    return FileMass(
        mass=extras["mass"],
        center=pivot + TURN.T @ np.array(extras["center_of_mass"]),
        inertia=TURN.T @ np.array(extras["inertia"]) @ TURN,
    )


def _file_joint(stated: Mapping[str, Any], parent: str, child: str, pivot: Floats) -> FileJoint:
    limit = stated["limit"] or {"lower": None, "upper": None}
    return FileJoint(
        name=stated["name"],
        type=stated["type"],
        parent=parent,
        child=child,
        axis=vector(TURN.T @ np.array(stated["axis"])),
        origin=vector(pivot),
        lower=limit["lower"],
        upper=limit["upper"],
        friction=stated["friction"],
        damping=stated["damping"],
        effort=stated["effort"],
        velocity=stated["velocity"],
        spring=stated["spring"] and Spring(**stated["spring"]),
        latch=stated["latch"] and Latch(**stated["latch"]),
        mimic=stated["mimic"] and Mimic(**stated["mimic"]),
    )
