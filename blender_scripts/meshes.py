"""Arrays to Blender objects."""

import bpy
import numpy as np

from artgen.core.mesh import Floats
from artgen.finish_jobs import GltfArrays

UV, ATLAS = "uv", "atlas"


def mesh_from_arrays(
    name: str, arrays: GltfArrays, origin: Floats, materials: list[bpy.types.Material]
) -> bpy.types.Mesh:
    """A mesh about `origin`: both UV sets, given corner normals, only the materials it uses."""
    mesh = bpy.data.meshes.new(name)
    count = len(arrays.faces)
    mesh.vertices.add(len(arrays.vertices))
    mesh.vertices.foreach_set("co", _flat(arrays.vertices - origin))
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", arrays.faces.astype(np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    used, index = np.unique(arrays.slot, return_inverse=True)
    mesh.polygons.foreach_set("material_index", index.reshape(-1).astype(np.int32))
    for layer, values in ((UV, arrays.uv), (ATLAS, arrays.atlas)):
        mesh.uv_layers.new(name=layer, do_init=False).uv.foreach_set("vector", _flat(values))
    for slot in used:
        mesh.materials.append(materials[slot])
    mesh.update(calc_edges=True)
    mesh.normals_split_custom_set(arrays.normals.reshape(-1, 3).tolist())
    return mesh


def _flat(values: Floats) -> np.ndarray:
    return np.asarray(values, np.float32).ravel()
