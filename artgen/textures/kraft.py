"""Kraft paper over flutes: a mottled, fibrous liner whose flutes show faintly through it."""

import numpy as np

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import Image, TextureSet
from artgen.textures.noise import smooth, smoothstep
from artgen.textures.relief import normal_map

SHAPE = (256, 256)
LEVELS = 10
"""Shades of the mottle; few shades make a small file."""
WASHBOARD = 0.035
"""Slope of the liner where it sags between flutes."""


def kraft(spec: SurfaceSpec) -> TextureSet:
    """Fibers along +u and flutes that run along +u, `spec.detail["flutes"]` of them a tile."""
    rng = Stream(int(spec.detail.get("seed", 1)), "kraft").generator()
    image = mottled(rng, SHAPE, spec.color, strength=float(spec.detail.get("mottle", 1.0)))
    count = int(spec.detail.get("flutes", 10))
    rows = np.arange(SHAPE[0])
    phase = (rows * count / SHAPE[0]) % 1.0
    slope = np.where(phase < 0.5, 4.0 * phase - 1.0, 3.0 - 4.0 * phase) * WASHBOARD
    sag = np.broadcast_to(slope[:, None], SHAPE)
    return TextureSet(color=image, normal=normal_map(np.zeros(SHAPE), sag))


def mottled(
    rng: np.random.Generator,
    shape: tuple[int, int],
    color: tuple[float, float, float],
    *,
    strength: float,
) -> Image:
    """(H, W, 3) sRGB: clouds and short fibers around a linear color, in few shades."""
    rows, columns = shape
    clouds = smooth(rng, (max(2, rows // 24), max(2, columns // 24)), shape)
    fibers = smooth(rng, (rows // 2, max(2, columns // 12)), shape)
    specks = smoothstep(2.2, 2.9, smooth(rng, (rows // 2, columns // 3), shape))
    field = 0.4 * clouds + 0.5 * fibers - 2.6 * specks
    shade = np.round(np.clip(field / 3.0, -1.0, 1.0) * LEVELS / 2.0) / (LEVELS / 2.0)
    return shaded(color, 1.0 + 0.16 * strength * shade)


def shaded(color: tuple[float, float, float], light: Floats) -> Image:
    """(H, W, 3) sRGB of a linear color times (H, W)."""
    linear = np.clip(np.asarray(color) * light[..., None], 0.0, 1.0)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.asarray(np.clip(encoded * 255.0 + 0.5, 0.0, 255.0)).astype(np.uint8)
