"""One color image for a whole object: tile images and plain colors laid out on the atlas set."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec, linear_from_srgb
from artgen.textures.images import Image, TextureSet
from artgen.textures.raster import Texels, touched_texels

GUTTER = 4
"""Texels around each chart that repeat its border, for filtering and for slight misplacement."""
FINE = 1 << 14
"""Steps of linear light in the table back to sRGB; the narrowest sRGB step, 1 / (255 * 12.92), is
five of them wide."""

LINEAR = np.array([linear_from_srgb(k / 255.0) for k in range(256)])


def bake_color(
    meshes: Sequence[TriMesh],
    surfaces: Sequence[SurfaceSpec],
    images: Sequence[TextureSet],
    *,
    size: int,
    occlusion: Floats | None = None,
) -> Image:
    """(size, size, 3) sRGB: what each surface shows under even white light, its own glow added.

    Args:
        meshes: every part, with `uv` in m, `atlas` and `slot`.
        surfaces: what the slots refer to.
        images: their texture sets, in the same order.
        occlusion: (size, size) in [0, 1] on the atlas; darkens the color, not the glow.
    """
    atlas = np.concatenate([np.asarray(mesh.atlas) for mesh in meshes])
    meters = np.concatenate([np.asarray(mesh.uv) for mesh in meshes])
    slot = np.concatenate([np.asarray(mesh.slot) for mesh in meshes])
    texels = touched_texels(atlas, size)
    place = (texels.weights[:, :, None] * meters[texels.triangle]).sum(axis=1)
    owner = slot[texels.triangle]
    spacing = _texel_spacing(meters, atlas, slot, size)
    shade = None if occlusion is None else occlusion.ravel()[texels.index, None]
    light = np.zeros((len(owner), 3))
    for k, (surface, look) in enumerate(zip(surfaces, images, strict=True)):
        own = owner == k
        if own.any():
            dim = None if shade is None else shade[own]
            light[own] = _shown(surface, look, place[own], spacing[k], dim)
    return framed(texels, light, size)


def _shown(
    surface: SurfaceSpec, look: TextureSet, place: Floats, spacing: float, shade: Floats | None
) -> Floats:
    """(N, 3) linear light of a surface at `place` (N, 2) m."""
    light = np.broadcast_to(np.array(surface.color), (len(place), 3))
    if look.color is not None:
        light = sample_tile(look.color, place, tile=surface.tile, spacing=spacing)
    if shade is not None:
        light = light * shade
    if surface.emission > 0.0:
        glow = np.broadcast_to(np.array(surface.color), (len(place), 3))
        if look.emission is not None:
            glow = sample_tile(look.emission, place, tile=surface.tile, spacing=spacing)
        light = light + surface.emission * glow
    return light


def sample_tile(
    image: Image, place: Floats, *, tile: tuple[float, float], spacing: float
) -> Floats:
    """(N, 3) linear light of a repeating sRGB image at `place` (N, 2) m, v up.

    Where samples are `spacing` m apart and the image is finer, it is averaged first by a power of
    two in each direction; then it is read bilinearly.
    """
    linear = LINEAR[image]
    for axis, extent in ((1, tile[0]), (0, tile[1])):
        while extent / linear.shape[axis] * 2.0 <= spacing and linear.shape[axis] % 2 == 0:
            pairs = np.moveaxis(linear, axis, 0)
            linear = np.moveaxis((pairs[0::2] + pairs[1::2]) / 2.0, 0, axis)
    rows, columns = linear.shape[:2]
    across = place[:, 0] / tile[0] * columns - 0.5
    down = (1.0 - place[:, 1] / tile[1]) * rows - 0.5
    left, top = np.floor(across).astype(np.int64), np.floor(down).astype(np.int64)
    s, t = (across - left)[:, None], (down - top)[:, None]
    x, y = (left % columns, (left + 1) % columns), (top % rows, (top + 1) % rows)
    upper = linear[y[0], x[0]] * (1.0 - s) + linear[y[0], x[1]] * s
    lower = linear[y[1], x[0]] * (1.0 - s) + linear[y[1], x[1]] * s
    return np.asarray(upper * (1.0 - t) + lower * t)


def _texel_spacing(
    meters: Floats, atlas: Floats, slot: NDArray[np.int16], size: int
) -> dict[int, float]:
    """Distance between texels on each surface, m: root of area in uv over area in texels."""
    areas = np.stack([_doubled_area(meters), _doubled_area(atlas) * size * size])
    found = {}
    for k in np.unique(slot):
        surface, texels = areas[:, slot == k].sum(axis=1)
        found[int(k)] = float(np.sqrt(surface / max(texels, 1e-12)))
    return found


def _doubled_area(corners: Floats) -> Floats:
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.asarray(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))


def framed(texels: Texels, light: Floats, size: int) -> Image:
    """The image whose texels show (N, 3) linear `light`; gutters are filled from the nearest texel,
    the rest with the mean."""
    picture = np.zeros((size * size, 3))
    picture[:] = light.mean(axis=0)
    picture[texels.index] = light
    empty = np.ones(size * size, bool)
    empty[texels.index] = False
    distance, (row, column) = distance_transform_edt(empty.reshape(size, size), return_indices=True)
    square = picture.reshape(size, size, 3)
    near = (distance > 0.0) & (distance <= GUTTER)
    square[near] = square[row[near], column[near]]
    return srgb_from_linear(square)


def srgb_from_linear(light: Floats) -> Image:
    """Linear light to 8-bit sRGB, to the nearest within a tenth of a step."""
    steps = np.arange(FINE + 1) / FINE
    curve = np.where(steps <= 0.0031308, 12.92 * steps, 1.055 * steps ** (1.0 / 2.4) - 0.055)
    table = (curve * 255.0 + 0.5).astype(np.uint8)
    place = np.clip(light, 0.0, 1.0) * FINE + 0.5
    return np.asarray(table[place.astype(np.int32)])
