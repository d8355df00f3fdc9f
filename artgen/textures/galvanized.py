"""Hot-dip galvanized steel: zinc crystals (spangle) that differ in gloss and gray."""

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.textures.images import Image, TextureSet

SIZE = 192
CRYSTALS = 110
"""On one tile; some 12 mm across at the usual tile of 0.12 m."""
GRAY = 0.10
GLOSS = 0.11
"""Largest deviations of a crystal's brightness and roughness from the mean."""


def galvanized(spec: SurfaceSpec) -> TextureSet:
    """Every crystal has its own gray and roughness; equal specs give equal images."""
    rng = Stream(1, "galvanized").generator()
    seeds, offsets = rng.random((CRYSTALS, 2)), rng.random((CRYSTALS, 2)) - 0.5
    cell = _nearest(seeds)
    mean = np.array([int(srgb_hex(spec.color)[k : k + 2], 16) for k in (1, 3, 5)], float)
    color = mean * (1.0 + 2.0 * GRAY * offsets[cell, :1])
    rough = 255.0 * (spec.roughness + 2.0 * GLOSS * offsets[cell, 1])
    return TextureSet(color=_bytes(color), roughness=_bytes(rough))


def _nearest(seeds: Floats) -> NDArray[np.intp]:
    """(SIZE, SIZE) index of the nearest seed on a square that wraps around."""
    steps = (np.arange(SIZE) + 0.5) / SIZE
    best = np.full((SIZE, SIZE), np.inf)
    cell = np.zeros((SIZE, SIZE), np.intp)
    for k, (u, v) in enumerate(seeds):
        du, dv = np.abs(steps - u), np.abs(steps - v)
        du, dv = np.minimum(du, 1.0 - du), np.minimum(dv, 1.0 - dv)
        far = du[None, :] ** 2 + dv[:, None] ** 2
        closer = far < best
        best[closer], cell[closer] = far[closer], k
    return cell


def _bytes(values: Floats) -> Image:
    return np.clip(np.rint(values), 0, 255).astype(np.uint8)
