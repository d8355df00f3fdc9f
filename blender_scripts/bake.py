"""Baking what only a renderer knows: ambient occlusion on the atlas."""

from collections.abc import Mapping

import bpy
import numpy as np

from artgen.finish_jobs import GltfArrays, OcclusionBake
from blender_scripts import scene as scenes
from blender_scripts.meshes import mesh_from_arrays

MARGIN = 2
"""Texels by which charts bleed into the gaps that the packer left."""


def bake_occlusion(parts: Mapping[str, GltfArrays], bake: OcclusionBake, threads: int) -> None:
    """Write the occlusion of all parts into one gray PNG.

    One mesh holds them all, as Cycles sets up a scene for every object it bakes; parts stand so far
    apart that none darkens another.
    """
    scene = scenes.reset()
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.cycles.samples = bake.samples
    scene.cycles.use_denoising = False
    scene.render.bake.margin = MARGIN
    scene.world = bpy.data.worlds.new("occlusion")
    scene.world.light_settings.distance = bake.reach
    image = bpy.data.images.new("occlusion", bake.size, bake.size)
    image.colorspace_settings.name = "Non-Color"
    node = bpy.data.objects.new("all", _apart(parts, bake.reach, _target(image)))
    scene.collection.objects.link(node)
    bpy.context.view_layer.objects.active = node
    node.select_set(True)
    bpy.ops.object.bake(type="AO")
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "BW"
    scene.render.image_settings.color_depth = "8"
    scene.view_settings.view_transform = "Raw"
    image.save_render(bake.output, scene=scene)


def _target(image: bpy.types.Image) -> bpy.types.Material:
    """A material whose active node is the image that a bake writes to."""
    material = bpy.data.materials.new("baked")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    return material


def _apart(
    parts: Mapping[str, GltfArrays], reach: float, material: bpy.types.Material
) -> bpy.types.Mesh:
    """All parts in one mesh, in a row along x, with more than `reach` between them; the atlas alone
    as UV set."""
    vertices, faces, edge, start = [], [], 0.0, 0
    for own in parts.values():
        low, high = own.vertices.min(axis=0), own.vertices.max(axis=0)
        vertices.append(own.vertices + np.array([edge - low[0], 0.0, 0.0]))
        faces.append(own.faces + start)
        edge += float(high[0] - low[0]) + 2.0 * reach
        start += len(own.vertices)
    atlas = np.concatenate([own.atlas for own in parts.values()])
    joined = GltfArrays(
        vertices=np.concatenate(vertices),
        faces=np.concatenate(faces),
        normals=np.concatenate([own.normals for own in parts.values()]),
        uv=atlas,
        atlas=atlas,
        slot=np.zeros(len(atlas), np.int16),
    )
    mesh = mesh_from_arrays("all", joined, np.zeros(3), [material])
    mesh.uv_layers.remove(mesh.uv_layers[0])
    return mesh
