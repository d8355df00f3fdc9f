"""Veneer: growth rings cut by a plane, pores, fibres and rays; the grain runs along +u.

The rings are cones about a pith that lies a little below the sheet, so a flat cut shows nested
arches (cathedrals) in its middle and straight grain at its sides, and a cut far from the pith shows
straight grain alone. A whole number of rings leaves the tile along u and the sheet is matched to
itself at its sides, like neighbouring leaves of veneer, so it repeats without a seam.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import UsageError
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.images import Image, TextureSet
from artgen.textures.noise import fractal, smooth, smoothstep, white
from artgen.textures.relief import quantized

SHAPE = (512, 512)
TONES = 80
HUES = 3
"""80 tones in 3 hues are 240 colors: the color image is a palette, a third of the bytes."""
LIGHTEST, DARKEST = -0.9, 2.1
"""Range of the tone: how much more of its tint the wood absorbs than its mean, in nepers."""
GLOSS_STEPS = 16


@dataclass(frozen=True, kw_only=True)
class Species:
    """How a species looks when sliced; strengths are in units of tone.

    Attributes:
        ring: mean width of a growth ring, m.
        arches: rings that end along one tile, at least 1.
        depth: distance of the pith from the cut, m; larger makes wider arches.
        offset: how far the leaf lies beside the pith, m; beyond the depth there are no arches.
        wander: how far rings stray from their cone, in rings.
        band: strength of the dark part of a ring.
        early: share of a ring that is porous early wood.
        line: strength of the thin dark line that ends a ring.
        pores: pores per square meter.
        pore_length: m.
        pore: strength of a pore; negative is a filled, light pore.
        porous: 0 spreads pores evenly (cherry), 1 keeps them in the early wood (oak, ash).
        rays: strength of short dark ray ends.
        fibre: strength of fine streaks.
        streak: strength of broad streaks.
        hue: strength of the drift between redder and yellower wood.
        tint: absorption of red, green and blue per unit of tone.
    """

    ring: float
    arches: int
    depth: float
    offset: float = 0.0
    wander: float
    band: float
    early: float
    line: float
    pores: float
    pore_length: float
    pore: float
    porous: float
    rays: float
    fibre: float
    streak: float
    hue: float
    tint: tuple[float, float, float]


OAK = Species(
    ring=0.0044, arches=7, depth=0.085, wander=1.0, band=0.20, early=0.36, line=0.05,
    pores=90e3, pore_length=0.007, pore=0.42, porous=0.85, rays=0.22, fibre=0.075, streak=0.07,
    hue=0.05, tint=(0.78, 1.0, 1.32),
)  # fmt: skip
SPECIES = {
    "oak": OAK,
    "ash": Species(
        ring=0.0050, arches=8, depth=0.050, wander=1.0, band=0.26, early=0.30, line=0.03,
        pores=90e3, pore_length=0.008, pore=0.34, porous=0.95, rays=0.0, fibre=0.06, streak=0.06,
        hue=0.04, tint=(0.75, 1.0, 1.35),
    ),
    "walnut": Species(
        ring=0.0062, arches=5, depth=0.075, wander=1.2, band=0.16, early=0.45, line=0.55,
        pores=60e3, pore_length=0.006, pore=0.50, porous=0.35, rays=0.0, fibre=0.09, streak=0.22,
        hue=0.07, tint=(0.85, 1.0, 1.12),
    ),
    "cherry": Species(
        ring=0.0056, arches=6, depth=0.075, wander=1.2, band=0.09, early=0.50, line=0.34,
        pores=40e3, pore_length=0.002, pore=0.12, porous=0.1, rays=0.06, fibre=0.06, streak=0.09,
        hue=0.05, tint=(0.62, 1.0, 1.30),
    ),
    "wenge": Species(
        ring=0.0036, arches=6, depth=0.05, offset=0.3, wander=0.9, band=0.8, early=0.45, line=0.0,
        pores=50e3, pore_length=0.009, pore=-0.45, porous=0.3, rays=0.0, fibre=0.14, streak=0.12,
        hue=0.03, tint=(0.85, 1.0, 1.10),
    ),
    "birch": Species(
        ring=0.0075, arches=5, depth=0.080, wander=1.8, band=0.05, early=0.6, line=0.15,
        pores=30e3, pore_length=0.0015, pore=0.10, porous=0.0, rays=0.03, fibre=0.035, streak=0.05,
        hue=0.03, tint=(0.65, 1.0, 1.45),
    ),
    "oak_whitewashed": Species(
        ring=0.0044, arches=7, depth=0.085, wander=1.0, band=0.13, early=0.36, line=0.04,
        pores=90e3, pore_length=0.007, pore=-0.15, porous=0.85, rays=0.07, fibre=0.04, streak=0.05,
        hue=0.02, tint=(0.85, 1.0, 1.2),
    ),
}  # fmt: skip


def wood(spec: SurfaceSpec) -> TextureSet:
    """Color and roughness of the species `detail["species"]`, leaf number `detail["seed"]`.

    Raises:
        UsageError: the species is unknown.
    """
    name = str(spec.detail.get("species", "oak"))
    if name not in SPECIES:
        known = ", ".join(sorted(SPECIES))
        raise UsageError(f"surface {spec.name}: no wood {name!r}; known: {known}")
    stream = Stream(int(spec.detail.get("seed", 1)), "wood", name)
    tone, hue, open_pores = _figure(SPECIES[name], stream, spec.tile)
    return TextureSet(
        color=_colored(tone, hue, spec.color, SPECIES[name]),
        roughness=_gloss(open_pores, tone, spec.roughness),
    )


def _figure(kind: Species, stream: Stream, tile: tuple[float, float]) -> tuple[Floats, ...]:
    """(H, W) tone, hue (mean 0) and how much of each texel is open pore."""
    phase, reach = _rings(kind, stream, tile)
    number = np.floor(phase)
    age = phase - number
    edge = np.minimum(0.5, 0.05 + 0.7 * reach)
    early = 1.0 - smoothstep(kind.early - edge / 2.0, kind.early + edge, age)
    early *= smoothstep(0.0, edge, age)
    line = smoothstep(1.0 - 2.5 * edge, 1.0 - edge / 2.0, age) * (
        1.0 - smoothstep(1.0 - edge / 2.0, 1.0, age)
    )
    strength = _ring_strength(number.astype(np.int64), kind, stream)
    pores = _dashes(
        stream.child("pores").generator(),
        count=kind.pores * tile[0] * tile[1],
        length=kind.pore_length / tile[0] * SHAPE[1],
        chance=1.0 - kind.porous + kind.porous * early,
    )
    rays = _dashes(
        stream.child("rays").generator(),
        count=14e3 * tile[0] * tile[1],
        length=0.016 / tile[0] * SHAPE[1],
        chance=np.full(SHAPE, 0.6),
    )
    fine = stream.child("fine").generator()
    fibre = fractal(fine, (256, 24), SHAPE, octaves=2, gain=0.8) + 0.5 * white(fine, SHAPE)
    broad = stream.child("broad").generator()
    streak = fractal(broad, (12, 2), SHAPE, octaves=4, gain=0.75)
    tone = (
        strength * (kind.band * early + kind.line * line)
        + kind.pore * pores
        + kind.rays * rays
        + kind.fibre * fibre * (0.75 + 0.5 * early)
        + kind.streak * streak
    )
    return tone, fractal(broad, (8, 2), SHAPE, octaves=3), pores


def _rings(kind: Species, stream: Stream, tile: tuple[float, float]) -> tuple[Floats, Floats]:
    """(H, W) ring coordinate, and rings per texel across the grain.

    The coordinate is (distance from the pith) / (ring width) + arches * u, warped.
    """
    u = (np.arange(SHAPE[1]) + 0.5) / SHAPE[1]
    v = (np.arange(SHAPE[0]) + 0.5) / SHAPE[0]
    warp = stream.child("warp").generator()
    sway = 0.035 * smooth(warp, (2, 2), SHAPE) + 0.006 * smooth(warp, (6, 5), SHAPE)
    across = v[:, None] - 0.46 + sway
    folded = np.abs(across - np.floor(across + 0.5))  # leaves are matched at their sides
    across = folded * tile[1] + kind.offset
    distance = np.sqrt(across * across + kind.depth * kind.depth)
    wander = fractal(warp, (5, 3), SHAPE, octaves=3, gain=0.45) + 0.10 * smooth(
        warp, (96, 12), SHAPE
    )
    phase = (distance - kind.depth) / kind.ring + kind.arches * u + kind.wander * wander
    reach = across / distance / kind.ring * (tile[1] / SHAPE[0])
    return phase, reach


def _ring_strength(number: NDArray[np.int64], kind: Species, stream: Stream) -> Floats:
    """(H, W) how marked each ring is, 0.4 ... 1.6; rings repeat every `arches`, as they must."""
    years = stream.child("years").generator().random(kind.arches)
    return np.asarray(0.4 + 1.2 * years[number % kind.arches])


def _dashes(rng: np.random.Generator, *, count: float, length: float, chance: Floats) -> Floats:
    """(H, W) coverage by short strokes along u, kept with probability `chance` where they lie."""
    total = int(count)
    row = rng.integers(0, SHAPE[0], total)
    column = rng.integers(0, SHAPE[1], total)
    kept = rng.random(total) < chance[row, column]
    row, column = row[kept], column[kept]
    texels = 1 + (rng.random(len(row)) * (2.0 * length)).astype(np.int64)
    starts = np.cumsum(texels) - texels
    step = np.arange(texels.sum()) - np.repeat(starts, texels)
    place = np.repeat(row * SHAPE[1], texels) + (np.repeat(column, texels) + step) % SHAPE[1]
    strength = np.repeat(0.45 + 0.55 * rng.random(len(row)), texels)
    cover = np.bincount(place, weights=strength, minlength=SHAPE[0] * SHAPE[1])
    return np.asarray(np.minimum(cover, 1.2).reshape(SHAPE))


def _colored(tone: Floats, hue: Floats, mean: tuple[float, float, float], kind: Species) -> Image:
    """(H, W, 3) sRGB whose mean in linear light is `mean`."""
    share = (tone - float(tone.mean()) - LIGHTEST) / (DARKEST - LIGHTEST)
    level = np.clip(share * TONES, 0, TONES - 1).astype(np.int64)
    shade = np.clip(hue * 0.75 + HUES / 2.0, 0, HUES - 1).astype(np.int64)
    index = level * HUES + shade
    used = np.bincount(index.ravel(), minlength=TONES * HUES)
    tones = LIGHTEST + (np.arange(TONES) + 0.5) / TONES * (DARKEST - LIGHTEST)
    drift = kind.hue * (np.arange(HUES) - (HUES - 1) / 2.0)
    exponent = tones[:, None, None] * np.array(kind.tint)
    exponent = exponent + drift[None, :, None] * np.array([-0.4, 0.1, 0.9])
    light = np.exp(-exponent).reshape(-1, 3)
    average = (light * used[:, None]).sum(axis=0) / index.size
    table = srgb_levels(np.minimum(light / average * np.array(mean), 1.0))
    return np.asarray(table[index])


def srgb_levels(light: Floats) -> Image:
    """Linear light to the nearest 8-bit sRGB."""
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)
    return quantized(curve)


def _gloss(pores: Floats, tone: Floats, roughness: float) -> Image:
    """(H, W) roughness in few steps: open pores are matt."""
    share = np.clip(0.25 + 0.6 * pores + 0.25 * tone, 0.0, 1.0)
    steps = np.floor(share * (GLOSS_STEPS - 1) + 0.5) / (GLOSS_STEPS - 1)
    return quantized(np.clip(roughness - 0.04 + 0.2 * steps, 0.0, 1.0))
