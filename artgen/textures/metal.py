"""Metals: brushed along +u, and blasted and anodized."""

import numpy as np

from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet
from artgen.textures.noise import fractal, smooth, white
from artgen.textures.relief import normal_map, quantized, slopes

BRUSHED = (256, 256)
SCRATCH = 0.03
"""Root mean square slope across the scratches that images show. A No. 4 finish (Ra 0.3 um, pitch 20
um) has 4 Ra / pitch = 0.06; half of it is finer than a texel and is part of the roughness."""
STEPS = 16
"""Levels of the roughness image; few levels make a small file."""
BLASTED = (128, 128)


def brushed(spec: SurfaceSpec) -> TextureSet:
    """Scratches along +u: normals lean across them, and some are duller than others."""
    rng = Stream(int(spec.detail.get("seed", 1)), "brushed").generator()
    rows = BRUSHED[0]
    lines = 0.7 * smooth(rng, (rows, 6), BRUSHED) + 0.6 * smooth(rng, (rows, 16), BRUSHED)
    lines += 0.4 * smooth(rng, (rows, 64), BRUSHED)  # squares sum to 1
    across = SCRATCH * lines
    along = 0.1 * SCRATCH * white(rng, BRUSHED)
    bands = 0.9 * smooth(rng, (rows, 5), BRUSHED) + 0.4 * smooth(rng, (rows // 4, 3), BRUSHED)
    share = np.clip(0.5 + 0.25 * bands, 0.0, 1.0)
    level = np.floor(share * (STEPS - 1) + 0.5) / (STEPS - 1)
    dull = np.clip(spec.roughness + 0.08 * (level - 0.5), 0.0, 1.0)
    return TextureSet(roughness=quantized(dull), normal=normal_map(along, across))


def anodized(spec: SurfaceSpec) -> TextureSet:
    """The fine even grain of bead-blasted aluminium."""
    rng = Stream(int(spec.detail.get("seed", 1)), "anodized").generator()
    height = fractal(rng, (48, 48), BLASTED, octaves=2, gain=0.7)
    return TextureSet(normal=normal_map(*slopes(height, steepness=0.025)))
