"""Small PNG files: a palette where an image has few colors, which costs no quality."""

import io
from pathlib import Path

import numpy as np
from PIL import Image as Pillow

from artgen.textures.images import Image

PALETTE = 256


def png_bytes(image: Image) -> bytes:
    """(H, W, 3) or (H, W) as PNG without clock or text; equal images give equal bytes.

    Up to 256 colors become a palette of 1, 2, 4 or 8 bits a pixel.
    """
    picture, options = Pillow.fromarray(image), {}
    if image.ndim == 3 and (indexed := _indexed(image)) is not None:
        picture, bits = indexed
        options = {"bits": bits}
    stream = io.BytesIO()
    picture.save(stream, "PNG", optimize=True, **options)
    return stream.getvalue()


def read_png(path: Path) -> Image:
    """(H, W, 3) of a file that `png_bytes` made from such an image."""
    with Pillow.open(path) as picture:
        return np.asarray(picture.convert("RGB"))


def _indexed(image: Image) -> tuple[Pillow.Image, int] | None:
    """The image as palette indices and their bits, or None if it has too many colors."""
    wide = image.astype(np.uint32)
    packed = (wide[..., 0] << 16) | (wide[..., 1] << 8) | wide[..., 2]
    colors, index = np.unique(packed, return_inverse=True)
    if len(colors) > PALETTE:
        return None
    picture = Pillow.fromarray(index.reshape(packed.shape).astype(np.uint8), "P")
    table = np.stack([colors >> 16, (colors >> 8) & 255, colors & 255], axis=1)
    picture.putpalette(table.astype(np.uint8).tobytes())
    bits = next(b for b in (1, 2, 4, 8) if len(colors) <= 1 << b)
    return picture, bits
