"""Small PNG files: a palette where an image has few colors, which costs no quality."""

import io
from pathlib import Path

import numpy as np
from PIL import Image as Pillow

from artgen.textures.images import Image

PALETTE = 256
WIDE = 17
"""Colors from which Pillow writes 8 bits a pixel; shorter palettes are filled up to it."""


def png_bytes(image: Image) -> bytes:
    """(H, W, 3) or (H, W) as PNG without clock or text; equal images give equal bytes.

    Up to 256 colors become a palette of 8 bits a pixel: fewer bits save next to nothing after
    compression, and the decoder of pybullet 3.2 refuses them.
    """
    picture = Pillow.fromarray(image)
    if image.ndim == 3 and (indexed := _indexed(image)) is not None:
        picture = indexed
    stream = io.BytesIO()
    picture.save(stream, "PNG", optimize=True)
    return stream.getvalue()


def read_png(path: Path) -> Image:
    """(H, W, 3) of a file that `png_bytes` made from such an image."""
    with Pillow.open(path) as picture:
        return np.asarray(picture.convert("RGB"))


def _indexed(image: Image) -> Pillow.Image | None:
    """The image as palette indices, or None if it has too many colors."""
    wide = image.astype(np.uint32)
    packed = (wide[..., 0] << 16) | (wide[..., 1] << 8) | wide[..., 2]
    colors, index = np.unique(packed, return_inverse=True)
    if len(colors) > PALETTE:
        return None
    picture = Pillow.fromarray(index.reshape(packed.shape).astype(np.uint8), "P")
    table = np.stack([colors >> 16, (colors >> 8) & 255, colors & 255], axis=1)
    table = np.pad(table, ((0, max(0, WIDE - len(table))), (0, 0)), mode="edge")
    picture.putpalette(table.astype(np.uint8).tobytes())
    return picture
