"""UsdPreviewSurface networks: tiling images or plain numbers, and the contact material."""

from pxr import Gf, Sdf, Usd, UsdPhysics, UsdShade

from artgen.core.surface import SurfaceSpec
from artgen.export.surface_images import SurfaceImages

FRICTION = 0.6
"""Static and dynamic coefficient, as in the MJCF's contact defaults: wood on wood, dry."""
INPUTS = {
    "diffuseColor": Sdf.ValueTypeNames.Color3f,
    "emissiveColor": Sdf.ValueTypeNames.Color3f,
    "roughness": Sdf.ValueTypeNames.Float,
    "metallic": Sdf.ValueTypeNames.Float,
    "normal": Sdf.ValueTypeNames.Normal3f,
}
CLEAR_OPACITY = 0.15
"""Opacity of a pane that transmits all light: just enough to show that it is there."""


def add_material(
    stage: Usd.Stage, scope: Sdf.Path, surface: SurfaceSpec, images: SurfaceImages
) -> UsdShade.Material:
    """One material; where an image exists it replaces the number."""
    path = scope.AppendChild(surface.name)
    material = UsdShade.Material.Define(stage, path)
    shader = UsdShade.Shader.Define(stage, path.AppendChild("surface"))
    shader.CreateIdAttr("UsdPreviewSurface")
    _set_numbers(shader, surface)
    textures = Textures(stage, path)
    if images.color is not None:
        _replace(shader, "diffuseColor", _rgb(textures.add("color", images.color, "sRGB")))
    if images.orm is not None:
        node = textures.add("orm", images.orm, "raw")
        _replace(shader, "roughness", node.CreateOutput("g", Sdf.ValueTypeNames.Float))
        _replace(shader, "metallic", node.CreateOutput("b", Sdf.ValueTypeNames.Float))
    if images.normal is not None:
        node = textures.add(
            "normal", images.normal, "raw", scale=(2, 2, 2, 1), bias=(-1, -1, -1, 0)
        )
        _replace(shader, "normal", _rgb(node))
    if images.emission is not None:
        strength = (*[surface.emission] * 3, 1.0)
        node = textures.add("emission", images.emission, "sRGB", scale=strength)
        _replace(shader, "emissiveColor", _rgb(node))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    return material


def _set_numbers(shader: UsdShade.Shader, surface: SurfaceSpec) -> None:
    types = Sdf.ValueTypeNames
    shader.CreateInput("diffuseColor", types.Color3f).Set(Gf.Vec3f(*surface.color))
    shader.CreateInput("roughness", types.Float).Set(surface.roughness)
    shader.CreateInput("metallic", types.Float).Set(surface.metallic)
    if surface.transmission > 0.0:
        opacity = 1.0 - (1.0 - CLEAR_OPACITY) * surface.transmission
        shader.CreateInput("opacity", types.Float).Set(opacity)
        shader.CreateInput("ior", types.Float).Set(surface.ior)
    if surface.emission > 0.0:
        glow = Gf.Vec3f(*surface.color) * surface.emission
        shader.CreateInput("emissiveColor", types.Color3f).Set(glow)


def _replace(shader: UsdShade.Shader, name: str, output: UsdShade.Output) -> None:
    """Connect an input; the number it had is dropped, so that no reader falls back to it."""
    found = shader.CreateInput(name, INPUTS[name])
    found.GetAttr().Clear()
    found.ConnectToSource(output)


class Textures:
    """Image nodes of one material, all reading the `st` coordinates."""

    def __init__(self, stage: Usd.Stage, material: Sdf.Path) -> None:
        self._stage, self._material = stage, material

    def _coordinates(self) -> UsdShade.Output:
        reader = UsdShade.Shader.Define(self._stage, self._material.AppendChild("st"))
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
        return reader.CreateOutput("result", Sdf.ValueTypeNames.Float2)

    def add(
        self,
        name: str,
        image: str,
        space: str,
        *,
        scale: tuple[float, ...] = (1, 1, 1, 1),
        bias: tuple[float, ...] = (0, 0, 0, 0),
    ) -> UsdShade.Shader:
        """A node that yields image * scale + bias, repeated in both directions."""
        types = Sdf.ValueTypeNames
        node = UsdShade.Shader.Define(self._stage, self._material.AppendChild(name))
        node.CreateIdAttr("UsdUVTexture")
        node.CreateInput("file", types.Asset).Set(Sdf.AssetPath(f"./{image}"))
        node.CreateInput("sourceColorSpace", types.Token).Set(space)
        for side in ("wrapS", "wrapT"):
            node.CreateInput(side, types.Token).Set("repeat")
        node.CreateInput("st", types.Float2).ConnectToSource(self._coordinates())
        if scale != (1, 1, 1, 1):
            node.CreateInput("scale", types.Float4).Set(Gf.Vec4f(*scale))
        if bias != (0, 0, 0, 0):
            node.CreateInput("bias", types.Float4).Set(Gf.Vec4f(*bias))
        return node


def _rgb(node: UsdShade.Shader) -> UsdShade.Output:
    return node.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)


def add_contact_material(stage: Usd.Stage, scope: Sdf.Path) -> UsdShade.Material:
    """Friction for every collision shape of the asset."""
    material = UsdShade.Material.Define(stage, scope.AppendChild("contact"))
    api = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    api.CreateStaticFrictionAttr(FRICTION)
    api.CreateDynamicFrictionAttr(FRICTION)
    api.CreateRestitutionAttr(0.0)
    return material
