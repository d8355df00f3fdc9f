"""Woven upholstery: warp over weft in turn, with the heather of melange yarns."""

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import Image, TextureSet
from artgen.textures.noise import smooth, white
from artgen.textures.relief import normal_map, slopes
from artgen.textures.wood import srgb_levels

THREADS = 16
"""Threads a tile in each direction."""
TEXELS = 8
"""Texels across a thread."""
TONES = 48
"""Few tones make a small file."""


def woven(spec: SurfaceSpec) -> TextureSet:
    """Plain weave; `heather` in the detail is how much the yarns differ in tone (0.15)."""
    rng = Stream(1, "woven").generator()
    warp, weft = _threads()
    over = _checker()
    height = np.where(over, warp, weft)
    yarns = np.where(over, _yarn_tones(rng), _yarn_tones(rng).T)
    heather = float(spec.detail.get("heather", 0.15))
    tone = (0.62 + 0.38 * height) * (1.0 + heather * yarns)
    return TextureSet(
        color=_tinted(spec.color, tone), normal=normal_map(*slopes(height, steepness=0.55))
    )


def _threads() -> tuple[Floats, Floats]:
    """Round backs of threads along v and along u, 0 to 1."""
    across = (np.arange(THREADS * TEXELS) % TEXELS + 0.5) / TEXELS * 2.0 - 1.0
    back = 1.0 - across * across
    warp = np.tile(back, (len(back), 1))
    crest = np.repeat(np.tile([1.0, 0.9], THREADS // 2), TEXELS)
    return warp * crest[:, None], warp.T * crest[None, :]


def _checker() -> NDArray[np.bool_]:
    """Where the warp lies over the weft."""
    cell = np.arange(THREADS * TEXELS) // TEXELS
    return np.asarray((cell[:, None] + cell[None, :]) % 2 == 0)


def _yarn_tones(rng: np.random.Generator) -> Floats:
    """Each thread has its tone, which drifts along it."""
    shape = (THREADS * TEXELS, THREADS * TEXELS)
    own = np.repeat(white(rng, (1, THREADS)), TEXELS, axis=1)
    return np.asarray(0.6 * own + 0.8 * smooth(rng, (8, THREADS), shape))


def _tinted(color: tuple[float, float, float], tone: Floats) -> Image:
    """The tone in that color; the mean of the image in linear light is the color."""
    tone = np.clip(tone, 0.0, 3.0)
    levels = np.floor(tone / tone.max() * TONES + 0.5) / TONES
    light = levels / levels.mean()
    return srgb_levels(np.minimum(light[..., None] * np.array(color), 1.0))
