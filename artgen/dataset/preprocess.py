"""ART's square crop: one function for training and inference, cameras kept exact.

A crop is an affine map of the image plane, so a point that projected to a place in the window
before projects to the same place in the resized image after, to rounding. Pixel centers are at
+0.5.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import ShardError
from artgen.core.mesh import Floats
from artgen.dataset.sample import Bytes, Singles


@dataclass(frozen=True, kw_only=True)
class Window:
    """A square of the image plane, px; it may reach past the image, where all is transparent."""

    left: float
    top: float
    side: float


@dataclass(frozen=True, kw_only=True, eq=False)
class SquareView:
    """What the network sees.

    Attributes:
        rgba: (S, S, 4) float32 in [0, 1], sRGB premultiplied by alpha; over a background color c it
            is `rgba[..., :3] + (1 - rgba[..., 3:]) * c`.
        intrinsics: (3, 3) px of the S x S image.
    """

    rgba: Singles
    intrinsics: Floats


def square_view(
    rgba: Bytes, intrinsics: Floats, *, size: int, mask: NDArray[np.bool_] | None = None
) -> SquareView:
    """The foreground of an (H, W, 4) image, cropped to its square window, at `size` x `size` px.

    Args:
        intrinsics: (3, 3) px; the principal point may lie anywhere.
        mask: (H, W) of the object, where alpha does not tell it: in a photograph, or over a caught
            shadow. What lies outside becomes transparent.

    Raises:
        ShardError: there is no foreground.
    """
    shown = rgba if mask is None else np.where(mask[..., None], rgba, np.uint8(0))
    window = foreground_window(shown[..., 3] > 0)
    return SquareView(
        rgba=resampled(shown, window, size=size),
        intrinsics=window_intrinsics(intrinsics, window, size=size),
    )


def foreground_window(mask: NDArray[np.bool_]) -> Window:
    """The square about the middle of the (H, W) mask's box, as wide as the box's longer side.

    Raises:
        ShardError: the mask is empty.
    """
    if not mask.any():
        raise ShardError("the image shows no foreground to crop to; check its alpha or its mask")
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    top, bottom = float(rows[0]), float(rows[-1] + 1)
    left, right = float(columns[0]), float(columns[-1] + 1)
    side = max(bottom - top, right - left)
    return Window(left=(left + right - side) / 2, top=(top + bottom - side) / 2, side=side)


def window_intrinsics(intrinsics: Floats, window: Window, *, size: int) -> Floats:
    """(3, 3) intrinsics of the image that shows the window at `size` x `size` px."""
    scale = size / window.side
    size_from_image = np.array(
        [[scale, 0.0, -scale * window.left], [0.0, scale, -scale * window.top], [0.0, 0.0, 1.0]]
    )
    return size_from_image @ intrinsics


def resampled(rgba: Bytes, window: Window, *, size: int) -> Singles:
    """(S, S, 4) float32 premultiplied window of an (H, W, 4) straight-alpha image.

    A triangle filter, as wide as the coarser of the two pixel grids, so that shrinking does not
    alias; colors are premultiplied first, so that nothing bleeds in from transparent pixels.
    """
    straight = rgba.astype(np.float64) / 255.0
    premultiplied = straight * np.where(np.arange(4) < 3, straight[..., 3:], 1.0)
    rows = _weights(rgba.shape[0], window.top, window.side, size)
    columns = _weights(rgba.shape[1], window.left, window.side, size)
    image: Singles = np.einsum("rh,hwc,sw->rsc", rows, premultiplied, columns, optimize=True)
    return image.astype(np.float32)


def _weights(length: int, start: float, side: float, size: int) -> Floats:
    """(size, length) share of each source pixel in each target pixel; rows sum to at most 1, less
    where the window reaches past the image."""
    step = side / size
    support = max(step, 1.0)
    centers = start + (np.arange(size) + 0.5) * step
    # Every source pixel that a filter can touch, inside the image or not, takes part in the sum.
    first = int(np.floor(min(start - support, 0.0)))
    last = int(np.ceil(max(start + side + support, length)))
    sources = np.arange(first, last) + 0.5
    weights = np.maximum(0.0, 1.0 - np.abs(sources[None, :] - centers[:, None]) / support)
    weights /= weights.sum(axis=1, keepdims=True)
    inside: Floats = weights[:, -first : length - first]
    return inside
