"""Normal maps from height fields."""

import numpy as np

from artgen.core.mesh import Floats
from artgen.textures.images import Image


def normal_map(slope_u: Floats, slope_v: Floats) -> Image:
    """(H, W, 3) tangent-space normals of a surface that rises by these slopes along u and v."""
    length = np.sqrt(slope_u * slope_u + slope_v * slope_v + 1.0)
    normal = np.stack([-slope_u / length, -slope_v / length, 1.0 / length], axis=-1)
    return quantized((128.0 + 127.0 * normal) / 255.0)


def slopes(height: Floats, *, steepness: float) -> tuple[Floats, Floats]:
    """Slopes along u and v (up the image) of a periodic height field, scaled so that their mean
    square together is `steepness` squared.
    """
    slope_u = np.roll(height, -1, axis=1) - np.roll(height, 1, axis=1)
    slope_v = np.roll(height, 1, axis=0) - np.roll(height, -1, axis=0)
    power = float((slope_u * slope_u + slope_v * slope_v).mean())
    factor = steepness / power**0.5
    return slope_u * factor, slope_v * factor


def quantized(values: Floats) -> Image:
    """[0, 1] to 0 ... 255, to the nearest."""
    return np.asarray(np.clip(values * 255.0 + 0.5, 0.0, 255.0), np.float64).astype(np.uint8)
