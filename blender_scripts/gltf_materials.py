"""Surfaces as Principled materials that Blender's glTF exporter understands."""

from pathlib import Path

import bpy

from artgen.finish_jobs import GltfSurface
from blender_scripts.meshes import ATLAS, UV

OCCLUSION_GROUP = "glTF Material Output"


def principled_material(surface: GltfSurface) -> bpy.types.Material:
    """Factors where there is no image, images by the first UV set where there is one."""
    material = bpy.data.materials.new(surface.name)
    material.use_nodes = True
    material.use_backface_culling = True  # closed bodies: single-sided in glTF
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    put = shader.inputs
    put["Base Color"].default_value = (*surface.color, 1.0)
    put["Roughness"].default_value = surface.roughness
    put["Metallic"].default_value = surface.metallic
    put["IOR"].default_value = surface.ior
    put["Transmission Weight"].default_value = surface.transmission
    put["Emission Color"].default_value = (*surface.color, 1.0)
    put["Emission Strength"].default_value = surface.emission
    images = surface.images
    if images.color is not None:
        tree.links.new(_image(tree, images.color, "sRGB").outputs["Color"], put["Base Color"])
    if images.emission is not None and surface.emission > 0.0:
        node = _image(tree, images.emission, "sRGB")
        tree.links.new(node.outputs["Color"], put["Emission Color"])
    if images.orm is not None:
        split = tree.nodes.new("ShaderNodeSeparateColor")
        tree.links.new(_image(tree, images.orm, "Non-Color").outputs["Color"], split.inputs[0])
        tree.links.new(split.outputs["Green"], put["Roughness"])
        tree.links.new(split.outputs["Blue"], put["Metallic"])
    if images.normal is not None:
        bump = tree.nodes.new("ShaderNodeNormalMap")
        bump.uv_map = UV
        tree.links.new(_image(tree, images.normal, "Non-Color").outputs["Color"], bump.inputs[1])
        tree.links.new(bump.outputs["Normal"], put["Normal"])
    return material


def add_occlusion(material: bpy.types.Material, path: str) -> None:
    """Ambient occlusion by the atlas; the exporter looks for a group of this name."""
    group = bpy.data.node_groups.get(OCCLUSION_GROUP)
    if group is None:
        group = bpy.data.node_groups.new(OCCLUSION_GROUP, "ShaderNodeTree")
        group.interface.new_socket("Occlusion", in_out="INPUT", socket_type="NodeSocketFloat")
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    split = tree.nodes.new("ShaderNodeSeparateColor")
    tree.links.new(_image(tree, path, "Non-Color", ATLAS).outputs["Color"], split.inputs[0])
    tree.links.new(split.outputs["Red"], node.inputs["Occlusion"])


def _image(
    tree: bpy.types.NodeTree, path: str, space: str, layer: str = UV
) -> bpy.types.ShaderNodeTexImage:
    """A texture node that reads the file by a UV set; one image block a file."""
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(path, check_existing=True)
    node.image.name = Path(path).stem
    node.image.colorspace_settings.name = space
    place = tree.nodes.new("ShaderNodeUVMap")
    place.uv_map = layer
    tree.links.new(place.outputs["UV"], node.inputs["Vector"])
    return node
