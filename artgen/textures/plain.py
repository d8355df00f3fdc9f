"""No images: the numbers of the surface say it all (glass, gloss plastic, chrome, coated wire)."""

from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet


def plain(spec: SurfaceSpec) -> TextureSet:
    """Empty; `spec` stays in force."""
    return TextureSet()
