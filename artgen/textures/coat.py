"""Coats: baked enamel with orange peel, rolled or sprayed paint, melamine."""

from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet
from artgen.textures.noise import fractal
from artgen.textures.relief import normal_map, slopes

SHAPE = (128, 128)


def enamel(spec: SurfaceSpec) -> TextureSet:
    """Orange peel: swells of some 5 mm that only a reflection shows; one image for all enamels."""
    return _peel("enamel", cells=24, octaves=2, steepness=0.012)


def paint(spec: SurfaceSpec) -> TextureSet:
    """The stipple of sprayed furniture paint; one image for all paints."""
    return _peel("paint", cells=32, octaves=2, steepness=0.022)


def _peel(name: str, *, cells: int, octaves: int, steepness: float) -> TextureSet:
    rng = Stream(1, name).generator()
    swell = fractal(rng, (cells, cells), SHAPE, octaves=octaves, gain=0.4)
    return TextureSet(normal=normal_map(*slopes(swell, steepness=steepness)))
