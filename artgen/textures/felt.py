"""Short-piled cloth: carpet and felt linings."""

from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet
from artgen.textures.noise import fractal
from artgen.textures.relief import normal_map, slopes

SHAPE = (128, 128)


def felt(spec: SurfaceSpec) -> TextureSet:
    """Tangled fibers: fine, steep and without direction; one image for all felts."""
    rng = Stream(1, "felt").generator()
    pile = fractal(rng, (48, 48), SHAPE, octaves=2, gain=0.7)
    return TextureSet(normal=normal_map(*slopes(pile, steepness=0.35)))
