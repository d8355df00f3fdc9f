"""The cut edge of corrugated board: a wave of medium between two liners, dark where air is."""

import numpy as np

from artgen.core.surface import SurfaceSpec
from artgen.textures.images import TextureSet
from artgen.textures.kraft import shaded

SHAPE = (32, 128)
WAVES = 2
LINER, MEDIUM = 0.13, 0.13
"""Thickness of a liner and of the wave as shares of the board's."""


def flutes(spec: SurfaceSpec) -> TextureSet:
    """Two waves a tile along +u across the board's thickness along +v; two boards of waves where
    `spec.detail["walls"]` is 2."""
    walls = int(spec.detail.get("walls", 1))
    rows, columns = SHAPE
    v = (np.arange(rows) + 0.5) / rows
    u = ((np.arange(columns) + 0.5) * WAVES / columns) % 1.0
    share = (v * walls) % 1.0
    ramp = np.where(u < 0.5, 4.0 * u - 1.0, 3.0 - 4.0 * u)
    wave = 0.5 + 0.5 * (1.0 - 2.0 * LINER) * ramp * (1.5 - 0.5 * ramp * ramp)
    near = np.abs(share[:, None] - wave[None, :])
    slope = 1.0 + 1.2 * np.abs(1.0 - np.abs(ramp))[None, :]
    paper = (near < MEDIUM * slope / 1.6) | ((share < LINER) | (share > 1.0 - LINER))[:, None]
    return TextureSet(color=shaded(spec.color, np.where(paper, 1.0, 0.16)))
