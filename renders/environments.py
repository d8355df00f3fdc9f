"""Surroundings as images: exposed like a photograph, written for Blender, told by height."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from artgen.core.errors import RenderError
from artgen.core.mesh import Floats
from artgen.render_job import Color, Environment, Sky
from renders.fast.filtered import directions, solid_angles

HEIGHT = 128
"""Rows of a map: 1.4 degrees a pixel, enough for the edges of softboxes and a spread-out sun."""

NO_DATE = "2000:01:01 00:00:00"
"""Else the file would state the time of writing, and equal maps would be different bytes."""


@dataclass(frozen=True, kw_only=True)
class Written:
    """A surrounding on disk, and its mean by height for whoever needs but that."""

    environment: Environment
    sky: Sky


def wall_radiance(radiance: Floats, normals: Floats) -> Floats:
    """(N, 3) radiance of white walls with (N, 3) unit normals under (H, 2 H, 3) surroundings: the
    integral of L cos over the half space in front of the wall, over pi."""
    height = len(radiance)
    towards = directions(height).reshape(-1, 3)
    area = np.repeat(solid_angles(height), 2 * height)
    falling = np.maximum(normals @ towards.T, 0.0) * area
    return np.asarray(falling @ radiance.reshape(-1, 3) / np.pi)


def exposed(radiance: Floats, white: float) -> Floats:
    """The surroundings scaled so that the brightest upright or level white wall shows `white` in
    green."""
    turns = np.arange(16) * np.pi / 8.0
    level = np.stack([np.sin(turns), -np.cos(turns), np.zeros(16)], axis=-1)
    normals = np.concatenate([level, [[0.0, 0.0, 1.0]]])
    return np.asarray(radiance * (white / wall_radiance(radiance, normals)[:, 1].max()))


def written(radiance: Floats, folder: Path) -> Written:
    """Write (H, 2 H, 3) surroundings to an EXR named by their content; equal ones, equal pixels.

    Raises:
        RenderError: the file cannot be written.
    """
    pixels = np.ascontiguousarray(radiance, np.float32)
    path = folder / f"environment-{hashlib.sha256(pixels.tobytes()).hexdigest()[:16]}.exr"
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        _write(path, pixels)
    return Written(environment=Environment(file=str(path.resolve())), sky=mean_sky(radiance))


def mean_sky(radiance: Floats) -> Sky:
    """Mean radiance straight below, at the horizon, and straight above: of the lowest, the middle
    and the highest sixth of the sphere."""
    height = len(radiance)
    up = directions(height)[..., 2]
    area = np.broadcast_to(solid_angles(height)[:, None], up.shape)
    bands = (up < -2 / 3, np.abs(up) < 1 / 6, up > 2 / 3)
    below, level, above = (np.average(radiance[band], axis=0, weights=area[band]) for band in bands)
    return Sky(nadir=_color(below), horizon=_color(level), zenith=_color(above))


def _color(values: Floats) -> Color:
    red, green, blue = (float(value) for value in values)
    return red, green, blue


def _write(path: Path, pixels: np.ndarray[tuple[int, ...], np.dtype[np.float32]]) -> None:
    height, width, _ = pixels.shape
    spec = oiio.ImageSpec(width, height, 3, "float")
    spec.attribute("DateTime", NO_DATE)
    output = oiio.ImageOutput.create(str(path))
    if output is None or not output.open(str(path), spec):
        raise RenderError(f"{path}: cannot be written ({oiio.geterror()})")
    try:
        if not output.write_image(pixels):
            raise RenderError(f"{path}: cannot be written ({output.geterror()})")
    finally:
        output.close()
