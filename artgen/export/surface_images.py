"""The images of a surface as files of a bundle."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class SurfaceImages:
    """Image paths of one surface, relative to the bundle's folder; None where there is no image.

    Attributes:
        color: sRGB; replaces the surface's color.
        orm: linear; G = roughness, B = metallic; replaces both numbers.
        normal: tangent space, y up.
        emission: sRGB; multiplied by the surface's `emission`.
    """

    color: str | None = None
    orm: str | None = None
    normal: str | None = None
    emission: str | None = None
