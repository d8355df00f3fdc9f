"""What an exported GLB does not say of its materials, put into the imported ones by name.

Standard library and bpy alone: this runs in Blender's own Python on render farms.
"""

import math
from collections.abc import Iterator

import bpy

from artgen.render_job import Absorption, LightRig, Relief, Subsurface, ThinGlass, Transport
from blender_scripts.lights import surrounding_color

MOST_TRIANGLES = 1_000_000
"""Of a displaced mesh; bounds what a job takes of memory and time."""


def apply_transport(transport: Transport, rig: LightRig) -> None:
    """Rebuild or complete the materials that the transport names."""
    for pane in transport.panes:
        make_thin_glass(pane, rig)
    for body in transport.subsurface:
        make_subsurface(body)
    for body in transport.absorbing:
        make_absorbing(body)
    for body in transport.relief:
        make_relief(body)


def make_thin_glass(pane: ThinGlass, rig: LightRig) -> None:
    """Rebuild an imported material as a pane: light passes straight, the surrounding is mirrored
    by Fresnel's law.

    A mirror closure beside a transparent one makes Cycles toss a coin at every hit, and the coin's
    noise stays in alpha, which no denoiser cleans. Mirrored light as emission needs no coin; it
    leaves out reflections of the object itself. Refraction in a flat pane only shifts the view by a
    fraction of its thickness.
    """
    material = _material(pane.surface)
    if material is None:
        return
    material.cycles.emission_sampling = "NONE"
    tree = material.node_tree
    tree.nodes.clear()
    mirrored = _fresnel(tree, pane.ior)
    passed = tree.nodes.new("ShaderNodeMix")
    passed.data_type = "RGBA"
    passed.inputs["A"].default_value = (*pane.tint, 1.0)
    passed.inputs["B"].default_value = (0.0, 0.0, 0.0, 1.0)
    clear = tree.nodes.new("ShaderNodeBsdfTransparent")
    glow = tree.nodes.new("ShaderNodeEmission")
    both = tree.nodes.new("ShaderNodeAddShader")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Reflection"]
    tree.links.new(mirrored, passed.inputs["Factor"])
    tree.links.new(passed.outputs["Result"], clear.inputs["Color"])
    tree.links.new(surrounding_color(tree, direction, rig), glow.inputs["Color"])
    tree.links.new(mirrored, glow.inputs["Strength"])
    tree.links.new(clear.outputs["BSDF"], both.inputs[0])
    tree.links.new(glow.outputs["Emission"], both.inputs[1])
    tree.links.new(both.outputs["Shader"], output.inputs["Surface"])


def _fresnel(tree: bpy.types.NodeTree, ior: float) -> bpy.types.NodeSocket:
    """The mirrored share on either face.

    Cycles inverts the index on back faces, where straight rays would then reflect totally; the
    inverse of the inverse keeps both faces alike.
    """
    side = tree.nodes.new("ShaderNodeNewGeometry")
    index = tree.nodes.new("ShaderNodeMix")
    index.data_type = "FLOAT"
    index.inputs["A"].default_value, index.inputs["B"].default_value = ior, 1.0 / ior
    fresnel = tree.nodes.new("ShaderNodeFresnel")
    tree.links.new(side.outputs["Backfacing"], index.inputs["Factor"])
    tree.links.new(index.outputs["Result"], fresnel.inputs["IOR"])
    return fresnel.outputs["Fac"]


def make_subsurface(body: Subsurface) -> None:
    """Light enters the body, scatters and leaves elsewhere; the base color stays what it was."""
    for shader in _principled(body.surface):
        shader.subsurface_method = "RANDOM_WALK"
        shader.inputs["Subsurface Weight"].default_value = 1.0
        shader.inputs["Subsurface Scale"].default_value = body.depth
        shader.inputs["Subsurface Radius"].default_value = (1.0, 1.0, 1.0)


def make_absorbing(body: Absorption) -> None:
    """A clear refracting body whose inside takes light away: exp(-density * way) is left.

    Blender absorbs (1 - color) * density a meter, so the densest channel sets the number and the
    others follow by color.
    """
    material = _material(body.surface)
    if material is None:
        return
    tree = material.node_tree
    for shader in _principled(body.surface):
        color = shader.inputs["Base Color"]
        for link in list(color.links):
            tree.links.remove(link)
        color.default_value = (1.0, 1.0, 1.0, 1.0)
    densest = max(body.density)
    inside = tree.nodes.new("ShaderNodeVolumeAbsorption")
    inside.inputs["Color"].default_value = (*(1.0 - d / densest for d in body.density), 1.0)
    inside.inputs["Density"].default_value = densest
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(inside.outputs["Volume"], output.inputs["Volume"])


def make_relief(body: Relief) -> None:
    """Bumps carved into the surface: its meshes are welded, split fine, and displaced inward, so
    that the body stays within its bounds."""
    material = _material(body.surface)
    if material is None:
        return
    tree = material.node_tree
    material.displacement_method = "DISPLACEMENT"
    place = tree.nodes.new("ShaderNodeTexCoord")
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 1.0 / body.size
    noise.inputs["Detail"].default_value = 2.0
    carve = tree.nodes.new("ShaderNodeDisplacement")
    carve.inputs["Midlevel"].default_value = 1.0
    carve.inputs["Scale"].default_value = body.height
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(place.outputs["Object"], noise.inputs["Vector"])
    tree.links.new(noise.outputs["Fac"], carve.inputs["Height"])
    tree.links.new(carve.outputs["Displacement"], output.inputs["Displacement"])
    for node in bpy.data.objects:
        if node.type == "MESH" and material.name in node.data.materials:
            _split_fine(node, body.size / 3.0)


def _split_fine(node: bpy.types.Object, edge: float) -> None:
    """Weld corners that the file holds apart, then split triangles in four until none is longer
    than `edge` m, or as often as MOST_TRIANGLES allow."""
    weld = node.modifiers.new("weld", "WELD")
    weld.merge_threshold = 1e-6
    corners = [vertex.co for vertex in node.data.vertices]
    ends = [side.vertices for side in node.data.edges]
    longest = max((corners[a] - corners[b]).length for a, b in ends)
    needed = math.ceil(math.log2(longest / edge))
    allowed = math.floor(math.log(MOST_TRIANGLES / len(node.data.polygons), 4.0))
    levels = max(0, min(needed, allowed))
    split = node.modifiers.new("split", "SUBSURF")
    split.subdivision_type = "SIMPLE"
    split.levels = split.render_levels = levels


def _material(surface: str) -> bpy.types.Material | None:
    """The imported material; None where no triangle of the file uses the surface."""
    return bpy.data.materials.get(surface)


def _principled(surface: str) -> Iterator[bpy.types.ShaderNode]:
    material = _material(surface)
    nodes = () if material is None else material.node_tree.nodes
    return (node for node in nodes if node.type == "BSDF_PRINCIPLED")
