"""A small picture of sky, hills and water, for wallpapers, photos and films."""

import numpy as np

from artgen.core.mesh import Floats
from artgen.textures.images import Image
from artgen.textures.noise import fractal, smooth, smoothstep
from artgen.textures.relief import quantized

MOODS = (
    ("#1f5fa8", "#bfe0f2", "#8fb3c9", "#2f5d4e"),
    ("#2c2350", "#f2a06b", "#8a5a78", "#241b33"),
    ("#4b7fb8", "#f4e2c4", "#c29b7a", "#5f4436"),
    ("#0f2a4a", "#58b7b4", "#2d6f7f", "#0c2d33"),
    ("#6a8fc4", "#fdf1e3", "#9fb48c", "#3e6b35"),
)
"""sRGB of the sky above, the sky at the horizon, the farthest and the nearest hills."""


def backdrop(rng: np.random.Generator, pixels: tuple[int, int]) -> Image:
    """(height, width, 3) sRGB of one landscape; `pixels` is (width, height)."""
    width, height = pixels
    zenith, horizon, far, near = (_rgb(text) for text in MOODS[int(rng.integers(len(MOODS)))])
    level = ((np.arange(height) + 0.5) / height)[:, None]
    picture = _mixed(zenith, horizon, smoothstep(0.0, 0.62, level) * np.ones((1, width)))
    sun = (0.2 + 0.6 * rng.random()) * width, (0.25 + 0.2 * rng.random()) * height
    picture = _glow(picture, sun, radius=0.06 * height)
    clouds = smoothstep(0.4, 2.2, fractal(rng, (6, 4), (height, width), octaves=4))
    picture = picture + (1.0 - picture) * (0.7 * clouds * (1.0 - level))[..., None]
    layers = int(rng.integers(3, 6))
    for k in range(layers):
        share = k / (layers - 1)
        ridge = 0.5 + 0.36 * share + _ridge(rng, width, 0.12 - 0.05 * share)
        cover = smoothstep(-0.6 / height, 0.6 / height, level - ridge[None, :])
        light = 1.0 + 0.05 * smooth(rng, (min(24, height), min(24, width)), (height, width)) * share
        color = _mixed(far, near, np.full((height, width), share)) * light[..., None]
        picture = picture + (color - picture) * cover[..., None]
    return quantized(np.clip(picture, 0.0, 1.0))


def _ridge(rng: np.random.Generator, width: int, height: float) -> Floats:
    """(width,) height of a range of hills."""
    cells = (1, int(rng.integers(3, 6)))
    return height * 0.5 * fractal(rng, cells, (1, width), octaves=5, gain=0.45)[0]


def _glow(picture: Floats, center: tuple[float, float], *, radius: float) -> Floats:
    x = np.arange(picture.shape[1]) + 0.5 - center[0]
    y = np.arange(picture.shape[0]) + 0.5 - center[1]
    away = (x[None, :] * x[None, :] + y[:, None] * y[:, None]) / (radius * radius)
    strength = np.minimum(1.0, 1.3 / (0.3 + away))[..., None]
    return picture + (np.array([1.0, 0.97, 0.88]) - picture) * strength * 0.85


def _mixed(first: Floats, second: Floats, share: Floats) -> Floats:
    return np.asarray(first + (second - first) * share[..., None])


def _rgb(text: str) -> Floats:
    return np.array([int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])
