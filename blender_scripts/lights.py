"""A light rig in Blender's terms."""

import math

import bpy
from mathutils import Vector

from artgen.render_job import AreaLight, Environment, Ground, LightRig, Sky

RIM = 128
"""Corners of the disc that stands for a ground."""


def add_rig(scene: bpy.types.Scene, rig: LightRig) -> bpy.types.Object | None:
    """All area lights and the surrounding; the ground, if the rig has one."""
    for number, light in enumerate(rig.lights):
        scene.collection.objects.link(_area(f"light_{number}", light))
    scene.world = _world(rig)
    return None if rig.ground is None else _ground(scene, rig.ground)


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


def _world(rig: LightRig) -> bpy.types.World:
    world = bpy.data.worlds.new("surrounding")
    world.use_nodes = True
    # A sky is so smooth that sampling it by the surface's own lobe is enough; a map for importance
    # sampling costs more than it saves. An image may hold a sun, so it gets a map of its own size.
    world.cycles.sampling_method = "NONE" if rig.environment is None else "AUTOMATIC"
    tree = world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    tree.links.new(surrounding_color(tree, direction, rig), background.inputs["Color"])
    return world


def surrounding_color(
    tree: bpy.types.NodeTree, direction: bpy.types.NodeSocket, rig: LightRig
) -> bpy.types.NodeSocket:
    """Radiance that comes from a direction of the world."""
    if rig.environment is None:
        return _sky_color(tree, direction, rig.sky)
    return _environment_color(tree, direction, rig.environment)


def _sky_color(
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


def _environment_color(
    tree: bpy.types.NodeTree, direction: bpy.types.NodeSocket, environment: Environment
) -> bpy.types.NodeSocket:
    """Radiance of the image in a direction.

    With azimuth a = atan2(x, -y), our image has u = 1/2 + a / 2 pi; Blender looks up direction
    (x', y') at u = 1/2 - atan2(y', x') / 2 pi. Both agree for x' = -y, y' = -x.
    """
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    joined = tree.nodes.new("ShaderNodeCombineXYZ")
    tree.links.new(direction, split.inputs[0])
    for source, target in (("Y", "X"), ("X", "Y")):
        turned = tree.nodes.new("ShaderNodeMath")
        turned.operation = "MULTIPLY"
        turned.inputs[1].default_value = -1.0
        tree.links.new(split.outputs[source], turned.inputs[0])
        tree.links.new(turned.outputs[0], joined.inputs[target])
    tree.links.new(split.outputs["Z"], joined.inputs["Z"])
    image = tree.nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(environment.file, check_existing=True)
    image.image.colorspace_settings.name = "Linear Rec.709"
    image.projection, image.interpolation = "EQUIRECTANGULAR", "Linear"
    tree.links.new(joined.outputs[0], image.inputs["Vector"])
    scaled = tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "SCALE"
    scaled.inputs["Scale"].default_value = environment.strength
    tree.links.new(image.outputs["Color"], scaled.inputs[0])
    return scaled.outputs["Vector"]


def _ground(scene: bpy.types.Scene, ground: Ground) -> bpy.types.Object:
    """A disc that shows nothing but the shadow it catches."""
    mesh = bpy.data.meshes.new("ground")
    steps = (2.0 * math.pi * k / RIM for k in range(RIM))
    (x, y), z, radius = ground.center, ground.height, ground.radius
    rim = [(x + radius * math.cos(a), y + radius * math.sin(a), z) for a in steps]
    mesh.from_pydata(rim, [], [tuple(range(RIM))])
    node = bpy.data.objects.new("ground", mesh)
    node.is_shadow_catcher = True
    scene.collection.objects.link(node)
    return node
