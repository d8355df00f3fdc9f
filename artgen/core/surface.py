"""SurfaceSpec: how a material looks, as numbers and a texture recipe."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class SurfaceSpec:
    """One physically based material.

    Attributes:
        name: unique within an object, e.g. `front`.
        recipe: a key of `artgen.textures.RECIPES`; `plain` has no images.
        color: linear RGB in [0, 1]; where the recipe makes a color image, its mean: the image
            stands instead of it.
        roughness: [0, 1] as in glTF.
        metallic: 0 or 1 as in glTF.
        transmission: 1 for thin clear panes, 0 for the rest.
        ior: index of refraction, used where transmission > 0.
        emission: strength of the emission image or color, relative to a white diffuser in daylight.
        tile: (width, height) in m that one copy of the images covers.
        detail: the recipe's own numbers and words.
        subsurface: mean way of light inside the body before it leaves elsewhere, m; 0 is none.
        attenuation: way through a refracting body after which white light has turned to `color`,
            m; 0 is a clear inside. Such a body is no pane: light is bent at its faces.
        relief: depth to which bumps are carved into the surface, m; 0 is as the mesh says.
        relief_size: width of those bumps, m.

    The last four are applied where Cycles renders an imported GLB; GLB, OBJ and USD do not hold
    them, and labels show the mesh as it is.
    """

    name: str
    recipe: str
    color: tuple[float, float, float] = (0.8, 0.8, 0.8)
    roughness: float = 0.5
    metallic: float = 0.0
    transmission: float = 0.0
    ior: float = 1.5
    emission: float = 0.0
    tile: tuple[float, float] = (0.5, 0.5)
    detail: Mapping[str, float | str] = field(default_factory=dict)
    subsurface: float = 0.0
    attenuation: float = 0.0
    relief: float = 0.0
    relief_size: float = 0.01


def linear_from_srgb(value: float) -> float:
    """IEC 61966-2-1 transfer curve, inverse."""
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def srgb_from_linear(value: float) -> float:
    """IEC 61966-2-1 transfer curve; undoes `linear_from_srgb`."""
    return 12.92 * value if value <= 0.04045 / 12.92 else 1.055 * value ** (1.0 / 2.4) - 0.055


def linear_color(hex_text: str) -> tuple[float, float, float]:
    """`#rrggbb` in sRGB to linear RGB."""
    red, green, blue = (int(hex_text[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return linear_from_srgb(red), linear_from_srgb(green), linear_from_srgb(blue)


def srgb_hex(color: tuple[float, float, float]) -> str:
    """Linear RGB to `#rrggbb` in sRGB; undoes `linear_color`."""
    return "#" + "".join(f"{round(255.0 * srgb_from_linear(value)):02x}" for value in color)
