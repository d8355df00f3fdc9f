"""Sheet with a hexagonal field of round holes: screens of microwave doors, drums."""

import numpy as np

from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.textures.draw import Sheet
from artgen.textures.images import TextureSet

ROWS = 8
"""Rows of holes a tile; even, so that copies join."""
PIXELS = 128


def perforated(spec: SurfaceSpec) -> TextureSet:
    """Light holes in the sheet's color; `detail` may hold `hole` (`#rrggbb`) and `open`, the
    radius of a hole as a share of the pitch."""
    width, height = spec.tile
    sheet = Sheet((width, height), pixels=(PIXELS, PIXELS), background=srgb_hex(spec.color))
    hole = str(spec.detail.get("hole", "#ffffff"))
    radius = float(spec.detail.get("open", 0.40)) * height / ROWS
    for row in range(ROWS):
        y = (row + 0.5) * height / ROWS
        for column in np.arange(-1, ROWS + 1) + 0.5 * (row % 2):
            sheet.disc((float(column) * width / ROWS, y), radius, fill=hole)
    return TextureSet(color=sheet.image())
