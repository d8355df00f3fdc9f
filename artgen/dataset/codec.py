"""Images as bytes that a person can open: WebP and PNG, all lossless after the stated rounding.

Colors are exact. Depths become 16-bit codes and normals 8-bit codes; encoding what was decoded
gives the same codes again, so a sample may pass any number of shards unchanged.
"""

import io
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from artgen.core.errors import ShardError
from artgen.dataset.exr import exr, read_exr
from artgen.dataset.sample import Bytes, Halves, Singles

WEBP_LIMIT = 16383
"""Largest width or height of a WebP image, px (libwebp)."""
_RGBA = ("R", "G", "B", "A")
_XY = ("X", "Y")
_DEPTH_STEPS = 65534
"""Codes 1 to 65535 span near to far; code 0 is background."""


@dataclass(frozen=True, kw_only=True)
class DepthRange:
    """Nearest and farthest depth of a sample, m; the two ends of the 16-bit codes.

    A decoded depth is within (far - near) / 131068 of the encoded one, plus one float32 rounding:
    7.6e-6 m for a range of 1 m.
    """

    near: float
    far: float

    def encode(self, depth: Singles) -> NDArray[np.uint16]:
        """(...) uint16 codes of depths in m; 0 m becomes 0."""
        step = self._step
        steps = np.rint((depth.astype(np.float64) - self.near) / step) if step > 0 else 0.0
        codes: NDArray[np.uint16] = np.where(depth > 0, 1 + steps, 0).astype(np.uint16)
        return codes

    def decode(self, codes: NDArray[np.uint16]) -> Singles:
        """(...) float32 depths in m."""
        depth = self.near + (codes.astype(np.float64) - 1) * self._step
        return np.where(codes > 0, depth, 0.0).astype(np.float32)

    @property
    def _step(self) -> float:
        return (self.far - self.near) / _DEPTH_STEPS


def depth_range(*depths: Singles) -> DepthRange:
    """The range of all depths > 0; (1, 1) where every pixel is background."""
    found = [array[array > 0] for array in depths if (array > 0).any()]
    if not found:
        return DepthRange(near=1.0, far=1.0)
    return DepthRange(
        near=float(min(values.min() for values in found)),
        far=float(max(values.max() for values in found)),
    )


def normal_codes(normal: Singles) -> Bytes:
    """(..., 3) uint8: 128 + 127 n per component, exact for -1, 0 and 1; 0 0 0 is background."""
    hit = normal.any(axis=-1, keepdims=True)
    return np.where(hit, np.rint(128 + 127 * normal), 0).astype(np.uint8)


def decoded_normals(codes: Bytes) -> Singles:
    """(..., 3) float32; each component within 1/254 of the encoded one, so the length within 0.7 %.

    The length is not restored, because dividing by it would shift some components by a whole code.
    """
    hit = codes.any(axis=-1, keepdims=True)
    normal = (codes.astype(np.float32) - 128) / np.float32(127)
    return np.where(hit, normal, np.float32(0))


def strip(images: NDArray[Any]) -> NDArray[Any]:
    """(P, H, W, ...) to one vertical strip (P H, W, ...): part k is rows k H to (k + 1) H."""
    return images.reshape(-1, *images.shape[2:])


def webp(image: Bytes) -> bytes:
    """(H, W, 3 or 4) as lossless WebP; color under alpha 0 is kept (libwebp's `exact`)."""
    if max(image.shape[:2]) > WEBP_LIMIT:
        raise ShardError(
            f"an image of {image.shape[1]} x {image.shape[0]} px (w x h) exceeds WebP's "
            f"{WEBP_LIMIT} px; render smaller, or cut parts with to_slots()"
        )
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "WEBP", lossless=True, exact=True, method=2, quality=80)
    return buffer.getvalue()


def png(image: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """(H, W) as 8- or 16-bit gray PNG."""
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", compress_level=6)
    return buffer.getvalue()


def linear_exr(image: Halves) -> bytes:
    """(H, W, 4) float16 premultiplied RGBA as half float EXR."""
    return exr(image, _RGBA)


def read_linear(data: bytes) -> Halves:
    """(H, W, 4) float16."""
    return np.asarray(read_exr(data, _RGBA), np.float16)


def flow_exr(image: Singles) -> bytes:
    """(H, W, 2) float32 px as float EXR with channels X and Y."""
    return exr(image, _XY)


def read_flow(data: bytes) -> Singles:
    """(H, W, 2) float32."""
    return np.asarray(read_exr(data, _XY), np.float32)


def read_rgba(data: bytes) -> Bytes:
    """(H, W, 4) uint8; libwebp drops an alpha that is 255 everywhere, so it is put back."""
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))


def read_rgb(data: bytes) -> Bytes:
    """(H, W, 3) uint8."""
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


def read_gray8(data: bytes) -> Bytes:
    """(H, W) uint8."""
    return np.asarray(Image.open(io.BytesIO(data)), dtype=np.uint8)


def read_gray16(data: bytes) -> NDArray[np.uint16]:
    """(H, W) uint16."""
    return np.asarray(Image.open(io.BytesIO(data)), dtype=np.uint16)
