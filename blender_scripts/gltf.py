"""GLB: Blender's exporter writes meshes, materials and images; joints and exact numbers follow."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.finish_jobs import GltfJob, read_gltf_arrays
from blender_scripts import scene
from blender_scripts.bake import bake_occlusion
from blender_scripts.glb import read_glb, write_glb
from blender_scripts.gltf_materials import add_occlusion, principled_material
from blender_scripts.meshes import mesh_from_arrays


def run(job: Mapping[str, Any], threads: int) -> dict[str, Any]:
    """Build the objects, export them, then put the extras and exact translations in."""
    task = GltfJob.from_plain(job)
    if task.occlusion is not None:
        bake_occlusion(read_gltf_arrays(Path(task.arrays)), task.occlusion, threads)
    scene.reset()
    _build(task)
    output = Path(task.output)
    bpy.ops.export_scene.gltf(
        filepath=task.output,
        export_format="GLB",
        export_image_format="AUTO",
        export_yup=True,
        export_animations=False,
        export_skins=False,
        export_morph=False,
        export_extras=False,
        export_cameras=False,
        export_lights=False,
        export_normals=True,
        export_texcoords=True,
        export_tangents=False,
    )
    document, binary = read_glb(output)
    _complete(document, task)
    write_glb(output, document, binary)
    return {"bytes": output.stat().st_size}


def _build(task: GltfJob) -> None:
    """One object a part, parented as the joints are; matrices stay translations."""
    materials = [principled_material(surface) for surface in task.surfaces]
    if task.occlusion is not None:
        for material in materials:
            add_occlusion(material, task.occlusion.output)
    arrays = read_gltf_arrays(Path(task.arrays))
    objects: dict[str, bpy.types.Object] = {}
    origins = {part.name: np.array(part.origin) for part in task.parts}
    for part in task.parts:
        mesh = mesh_from_arrays(part.name, arrays[part.name], origins[part.name], materials)
        node = bpy.data.objects.new(part.name, mesh)
        bpy.context.scene.collection.objects.link(node)
        above = np.zeros(3)
        if part.parent is not None:
            node.parent = objects[part.parent]
            above = origins[part.parent]
        node.location = origins[part.name] - above
        objects[part.name] = node


def _complete(document: dict[str, Any], task: GltfJob) -> None:
    """Extras by name, and translations in float64: Blender passes them through float32."""
    document["asset"] = {"version": "2.0", "generator": f"artgen, {document['asset']['generator']}"}
    document["scenes"][0]["extras"] = dict(task.extras)
    nodes = {node["name"]: node for node in document["nodes"]}
    origins = {part.name: np.array(part.origin) for part in task.parts}
    for part in task.parts:
        node = nodes[part.name]
        node["extras"] = dict(part.extras)
        above = origins[part.parent] if part.parent is not None else np.zeros(3)
        offset = Y_UP_FROM_Z_UP[:3, :3] @ (origins[part.name] - above)
        node.pop("translation", None)
        if offset.any():
            node["translation"] = [float(v) + 0.0 for v in offset]
