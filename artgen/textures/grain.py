"""Molded plastic and rubber: the texture that the mold's eroded steel leaves."""

from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet
from artgen.textures.noise import smooth, smoothstep
from artgen.textures.relief import normal_map, slopes

SHAPE = (128, 128)


def plastic(spec: SurfaceSpec) -> TextureSet:
    """Spark-eroded grain: low plateaus with pits between; one image for all plastics."""
    return _grain("plastic", cells=40, steepness=0.07)


def rubber(spec: SurfaceSpec) -> TextureSet:
    """A coarser, softer grain; one image for all rubbers."""
    return _grain("rubber", cells=28, steepness=0.09)


def _grain(name: str, *, cells: int, steepness: float) -> TextureSet:
    rng = Stream(1, name).generator()
    pits = smooth(rng, (cells, cells), SHAPE) + 0.4 * smooth(rng, (2 * cells, 2 * cells), SHAPE)
    plateaus = smoothstep(-1.2, 0.9, pits)
    return TextureSet(normal=normal_map(*slopes(plateaus, steepness=steepness)))
