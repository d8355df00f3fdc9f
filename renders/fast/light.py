"""A light rig in the fast backend's terms: softboxes as rectangles, the rest as two images."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray

from artgen.core.errors import RenderError
from artgen.core.mesh import Floats
from artgen.render_job import AreaLight, LightRig, Sky
from renders.fast.filtered import HEIGHT, Blur, directions, white_wall
from renders.fast.shaders import MOST_LIGHTS

FAR = 1e4
"""m to a surrounding that has no lights."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shine:
    """What the shaders are told about light.

    Attributes:
        around: (H, 2 H, 3) radiance of the surrounding alone.
        sky: (9, 3) radiance of a white wall under the surrounding alone, by its normal.
        corners: (L, 4, 3) m; counter-clockwise as seen by what is lit.
        radiance: (L, 3).
        mirrored: (LAYERS, H, 2 H, 3) float32 surroundings with the lights in them, by roughness.
        middle: (3,) m, from where the lights stand in `mirrored` as they do.
        reach: m from there to the lights.
    """

    around: Floats
    sky: Floats
    corners: Floats
    radiance: Floats
    mirrored: NDArray[np.float32]
    middle: Floats
    reach: float


def shine(rig: LightRig, blur: Blur) -> Shine:
    """The rig as the shaders need it.

    Raises:
        RenderError: more lights than the shaders hold.
    """
    if len(rig.lights) > MOST_LIGHTS:
        raise RenderError(
            f"rig {rig.name} has {len(rig.lights)} lights, the fast backend holds {MOST_LIGHTS}; "
            "use fewer, or the cycles backend"
        )
    corners = np.array([_corners(light) for light in rig.lights]).reshape(-1, 4, 3)
    radiance = np.array([light.radiance for light in rig.lights]).reshape(-1, 3)
    targets = np.array([light.target for light in rig.lights]).reshape(-1, 3)
    middle = targets.mean(axis=0) if len(targets) else np.zeros(3)
    away = np.linalg.norm(corners.mean(axis=1) - middle, axis=1)
    around = surrounding(rig)
    seen = _with_lights(around, corners, radiance, middle)
    return Shine(
        around=around,
        sky=white_wall(around),
        corners=corners,
        radiance=radiance,
        mirrored=blur(seen),
        middle=middle,
        reach=float(away.mean()) if len(away) else FAR,
    )


def surrounding(rig: LightRig) -> Floats:
    """(H, 2 H, 3) radiance around the object without the lights, H = HEIGHT.

    Raises:
        RenderError: the environment cannot be read.
    """
    if rig.environment is None:
        return sky_radiance(rig.sky, directions(HEIGHT))
    image = oiio.ImageBuf(rig.environment.file)
    small = oiio.ImageBufAlgo.resize(
        image, filtername="box", roi=oiio.ROI(0, 2 * HEIGHT, 0, HEIGHT, 0, 1, 0, 3)
    )
    pixels = small.get_pixels(oiio.FLOAT)
    if image.has_error or pixels is None or pixels.shape != (HEIGHT, 2 * HEIGHT, 3):
        raise RenderError(
            f"{rig.environment.file} is no equirectangular RGB image ({image.geterror()}); "
            "make it anew"
        )
    return np.maximum(np.asarray(pixels, np.float64), 0.0) * rig.environment.strength


def sky_radiance(sky: Sky, towards: Floats) -> Floats:
    """(..., 3) by direction: three steps by height, eased as Blender's color ramp eases."""
    height = towards[..., 2:]
    ease = np.abs(height) ** 2 * (3.0 - 2.0 * np.abs(height))
    ends = np.where(height < 0.0, np.array(sky.nadir), np.array(sky.zenith))
    return np.asarray((1.0 - ease) * np.array(sky.horizon) + ease * ends)


def _corners(light: AreaLight) -> Floats:
    """(4, 3) m; width is level, height leans up."""
    position, target = np.array(light.position), np.array(light.target)
    toward = (target - position) / np.linalg.norm(target - position)
    level = np.cross(toward, [0.0, 0.0, 1.0])
    if np.linalg.norm(level) < 1e-6:
        level = np.array([1.0, 0.0, 0.0])
    right = level / np.linalg.norm(level) * light.size[0] / 2.0
    up = np.cross(level / np.linalg.norm(level), toward) * light.size[1] / 2.0
    return np.stack([position + a * right + b * up for a, b in SIGNS])


SIGNS: Sequence[tuple[int, int]] = ((-1, -1), (-1, 1), (1, 1), (1, -1))


def _with_lights(around: Floats, corners: Floats, radiance: Floats, middle: Floats) -> Floats:
    """The surrounding with every light painted in, as seen from `middle`; edges are softened by
    four rays a pixel."""
    fine = directions(2 * HEIGHT)
    seen = np.repeat(np.repeat(around, 2, axis=0), 2, axis=1)
    for (a, b, _, d), color in zip(corners, radiance, strict=True):
        wide, high = b - a, d - a
        face = np.cross(wide, high)
        slope = fine @ face
        hits = slope < 0.0
        along = np.where(hits, ((a - middle) @ face) / np.where(hits, slope, -1.0), 0.0)
        at = middle + along[..., None] * fine - a
        u, v = at @ wide / (wide @ wide), at @ high / (high @ high)
        inside = hits & (along > 0.0) & (u >= 0) & (u <= 1) & (v >= 0) & (v <= 1)
        seen = np.where(inside[..., None], color, seen)
    return seen.reshape(HEIGHT, 2, 2 * HEIGHT, 2, 3).mean(axis=(1, 3))
