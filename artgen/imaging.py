"""From linear renders to displayed bytes: EXR in, 8-bit sRGB with straight alpha out."""

import io
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from numpy.typing import NDArray
from PIL import Image

from artgen.core.errors import RenderError
from artgen.core.mesh import Floats

Bytes = NDArray[np.uint8]
Singles = NDArray[np.float32]

SHOULDER = 0.6
"""Linear radiance above which `display` bends towards white."""


def read_exr(path: Path) -> Singles:
    """(H, W, 4) linear RGB premultiplied by alpha.

    Raises:
        RenderError: the file is missing, has no alpha, or holds a number that is not finite.
    """
    source = oiio.ImageInput.open(str(path))
    if source is None:
        raise RenderError(f"{path} cannot be read ({oiio.geterror()}); render it again")
    try:
        pixels = source.read_image(format="float")
    finally:
        source.close()
    if pixels is None or pixels.ndim != 3 or pixels.shape[2] != 4:
        raise RenderError(f"{path} is not a whole RGBA image; render it again")
    if not np.isfinite(pixels).all():
        raise RenderError(f"{path} holds pixels that are not finite; a material divides by zero")
    return np.asarray(pixels, np.float32)


def display(linear: Singles) -> Bytes:
    """(..., 4) uint8 of premultiplied linear RGBA: sRGB, straight alpha, 0 where alpha is 0.

    Radiance up to SHOULDER is kept; what is brighter approaches 1 smoothly (same value and slope at
    SHOULDER), so that highlights keep their shape. Then the sRGB curve of IEC 61966-2-1.
    """
    rgba = np.asarray(linear, np.float64)
    alpha = np.clip(rgba[..., 3:], 0.0, 1.0)
    color = np.maximum(rgba[..., :3], 0.0) / np.where(alpha > 0.0, alpha, 1.0)
    head = 1.0 - SHOULDER
    bent = SHOULDER - head * np.expm1(-np.maximum(color - SHOULDER, 0.0) / head)
    encoded = srgb_from_linear(np.where(color > SHOULDER, bent, color))
    bytes_ = np.rint(255.0 * np.concatenate([encoded, alpha], axis=-1)).astype(np.uint8)
    return np.where(bytes_[..., 3:] == 0, np.uint8(0), bytes_)


def srgb_from_linear(values: Floats) -> Floats:
    """The transfer curve of IEC 61966-2-1 for values in [0, 1]."""
    power = 1.055 * np.maximum(values, 0.0031308) ** (1.0 / 2.4) - 0.055
    return np.where(values <= 0.0031308, 12.92 * values, power)


def png_file(image: Bytes) -> bytes:
    """An 8-bit PNG without any metadata; equal images give equal bytes."""
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
