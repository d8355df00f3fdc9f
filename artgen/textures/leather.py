"""Leather: pebbles between fine creases."""

from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet
from artgen.textures.noise import smooth, smoothstep
from artgen.textures.relief import normal_map, quantized, slopes

SHAPE = (128, 128)
STEPS = 12


def leather(spec: SurfaceSpec) -> TextureSet:
    """Creases where two swells balance; the crests are worn smoother than the creases."""
    rng = Stream(1, "leather").generator()
    creases = [smooth(rng, (cells, cells), SHAPE) for cells in (10, 14)]
    broad, fine = (smoothstep(0.0, 0.45, abs(field)) for field in creases)
    height = broad * fine + 0.15 * smooth(rng, (64, 64), SHAPE)
    level = (smoothstep(0.0, 1.0, height) * STEPS + 0.5) // 1 / STEPS
    rough = spec.roughness + 0.10 * (0.6 - level)
    return TextureSet(
        roughness=quantized(rough.clip(0.0, 1.0)),
        normal=normal_map(*slopes(height, steepness=0.16)),
    )
