"""TextureSet: the images of one surface."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import UsageError

Image = NDArray[np.uint8]
CHANNELS = {"color": 3, "roughness": None, "normal": 3, "emission": 3}


@dataclass(frozen=True, kw_only=True, eq=False)
class TextureSet:
    """Images of one surface; each covers `SurfaceSpec.tile`, row 0 is its upper edge (largest v).

    An image that exists replaces the surface's number; None leaves the number in force.

    Attributes:
        color: (H, W, 3) sRGB; its mean, taken in linear light, is the surface's `color`.
        roughness: (H, W), 255 is roughness 1.
        normal: (H, W, 3), tangent space, y along +v (OpenGL), 128 is zero.
        emission: (H, W, 3) sRGB; multiplied by the surface's `emission`.
    """

    color: Image | None = None
    roughness: Image | None = None
    normal: Image | None = None
    emission: Image | None = None

    def __post_init__(self) -> None:
        for field in fields(self):
            if (image := getattr(self, field.name)) is not None:
                object.__setattr__(self, field.name, _checked(field.name, image))


def _checked(name: str, image: Image) -> Image:
    depth = CHANNELS[name]
    shape = image.shape[:2] if depth is None else (*image.shape[:2], depth)
    if image.dtype != np.uint8 or image.shape != shape or image.size == 0:
        raise UsageError(
            f"a {name} image is {image.dtype} {image.shape}, expected uint8 "
            f"{'(H, W)' if depth is None else '(H, W, 3)'}; convert it in its recipe"
        )
    image = np.ascontiguousarray(image)
    image.setflags(write=False)
    return image
