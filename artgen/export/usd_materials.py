"""UsdPreviewSurface networks: tiling images or plain numbers, and the contact material."""

from dataclasses import dataclass

from pxr import Gf, Sdf, Usd, UsdPhysics, UsdShade

from artgen.core.surface import SurfaceSpec

FRICTION = 0.6
"""Static and dynamic coefficient, as in the MJCF's contact defaults: wood on wood, dry."""
CLEAR_OPACITY = 0.15
"""Opacity of a pane that transmits all light: just enough to show that it is there."""


@dataclass(frozen=True, kw_only=True)
class SurfaceImages:
    """Image paths of one surface, relative to the bundle's folder; None where there is no image."""

    color: str | None = None
    roughness: str | None = None
    normal: str | None = None
    emission: str | None = None


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
        _replace(shader, "diffuseColor", textures.add("color", images.color, "sRGB", "rgb"))
    if images.roughness is not None:
        _replace(shader, "roughness", textures.add("roughness", images.roughness, "raw", "r"))
    if images.normal is not None:
        _replace(shader, "normal", textures.add_normal(images.normal))
    if images.emission is not None:
        texture = textures.add("emission", images.emission, "sRGB", "rgb", surface.emission)
        _replace(shader, "emissiveColor", texture)
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
    kind = Sdf.ValueTypeNames.Float if name == "roughness" else Sdf.ValueTypeNames.Color3f
    kind = Sdf.ValueTypeNames.Normal3f if name == "normal" else kind
    found = shader.CreateInput(name, kind)
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

    def _node(self, name: str, image: str, space: str) -> UsdShade.Shader:
        types = Sdf.ValueTypeNames
        node = UsdShade.Shader.Define(self._stage, self._material.AppendChild(name))
        node.CreateIdAttr("UsdUVTexture")
        node.CreateInput("file", types.Asset).Set(Sdf.AssetPath(f"./{image}"))
        node.CreateInput("sourceColorSpace", types.Token).Set(space)
        for side in ("wrapS", "wrapT"):
            node.CreateInput(side, types.Token).Set("repeat")
        node.CreateInput("st", types.Float2).ConnectToSource(self._coordinates())
        return node

    def add(
        self, name: str, image: str, space: str, channel: str, strength: float = 1.0
    ) -> UsdShade.Output:
        """The image's `channel`, times `strength`."""
        node = self._node(name, image, space)
        if strength != 1.0:
            scale = Gf.Vec4f(strength, strength, strength, 1.0)
            node.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(scale)
        kind = Sdf.ValueTypeNames.Float3 if channel == "rgb" else Sdf.ValueTypeNames.Float
        return node.CreateOutput(channel, kind)

    def add_normal(self, image: str) -> UsdShade.Output:
        """A tangent-space normal image, mapped from [0, 1] to [-1, 1]."""
        node = self._node("normal", image, "raw")
        types = Sdf.ValueTypeNames
        node.CreateInput("scale", types.Float4).Set(Gf.Vec4f(2.0, 2.0, 2.0, 1.0))
        node.CreateInput("bias", types.Float4).Set(Gf.Vec4f(-1.0, -1.0, -1.0, 0.0))
        return node.CreateOutput("rgb", types.Float3)


def add_contact_material(stage: Usd.Stage, scope: Sdf.Path) -> UsdShade.Material:
    """Friction for every collision shape of the asset."""
    material = UsdShade.Material.Define(stage, scope.AppendChild("contact"))
    api = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    api.CreateStaticFrictionAttr(FRICTION)
    api.CreateDynamicFrictionAttr(FRICTION)
    api.CreateRestitutionAttr(0.0)
    return material
