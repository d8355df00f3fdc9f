"""A light rig in Blender's terms."""

import math

import bpy
from mathutils import Vector

from artgen.render_job import AreaLight, LightRig, Sky


def add_rig(scene: bpy.types.Scene, rig: LightRig) -> None:
    """All area lights and the sky."""
    for number, light in enumerate(rig.lights):
        scene.collection.objects.link(_area(f"light_{number}", light))
    scene.world = _world(rig.sky)


def _area(name: str, light: AreaLight) -> bpy.types.Object:
    data = bpy.data.lights.new(name, "AREA")
    data.shape = "RECTANGLE"
    data.size, data.size_y = light.size
    # A Lambertian rectangle of area A and radiance L emits pi * A * L watts.
    strongest = max(light.radiance)
    data.energy = math.pi * light.size[0] * light.size[1] * strongest
    data.color = [value / strongest for value in light.radiance]
    node = bpy.data.objects.new(name, data)
    node.location = light.position
    toward = Vector(light.target) - Vector(light.position)
    node.rotation_mode = "QUATERNION"
    node.rotation_quaternion = toward.to_track_quat("-Z", "Y")
    return node


def _world(sky: Sky) -> bpy.types.World:
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    # The sky is so smooth that sampling it by the surface's own lobe is enough; a map for
    # importance sampling costs more than it saves.
    world.cycles.sampling_method = "NONE"
    tree = world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    tree.links.new(sky_color(tree, direction, sky), background.inputs["Color"])
    return world


def sky_color(
    tree: bpy.types.NodeTree, direction: bpy.types.NodeSocket, sky: Sky
) -> bpy.types.NodeSocket:
    """Radiance of the sky in a direction, blended by its height in three steps."""
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    height = tree.nodes.new("ShaderNodeMapRange")
    height.inputs["From Min"].default_value = -1.0
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.interpolation = "EASE"
    ramp.color_ramp.elements[0].color = (*sky.nadir, 1.0)
    ramp.color_ramp.elements[1].color = (*sky.zenith, 1.0)
    ramp.color_ramp.elements.new(0.5).color = (*sky.horizon, 1.0)
    tree.links.new(direction, split.inputs[0])
    tree.links.new(split.outputs["Z"], height.inputs["Value"])
    tree.links.new(height.outputs["Result"], ramp.inputs["Fac"])
    return ramp.outputs["Color"]
