"""A surface whose images come from outside: photographed, baked or reconstructed, not synthesized.

Such a surface names its images by their hash, and a `TextureLibrary` keeps them:
`library.keep(spec, images)` beforehand, and then it is a surface like any other.
"""

import hashlib
from dataclasses import fields

import numpy as np

from artgen.core.errors import UsageError
from artgen.core.surface import SurfaceSpec
from artgen.textures.atlas import LINEAR
from artgen.textures.images import TextureSet

RECIPE = "picture"


def picture(spec: SurfaceSpec) -> TextureSet:
    """Nothing can be made here: the images are not in the numbers.

    Raises:
        UsageError: always; whoever has the images puts them into the library first.
    """
    raise UsageError(
        f"surface {spec.name}: its images {spec.detail.get('images', '?')} came from outside and "
        "this library does not hold them; put them there by TextureLibrary.keep"
    )


def picture_surface(
    name: str,
    images: TextureSet,
    *,
    tile: tuple[float, float],
    roughness: float = 0.6,
    metallic: float = 0.0,
) -> SurfaceSpec:
    """The surface that shows `images` over `tile` m; its color is the mean of the color image."""
    color = (0.8, 0.8, 0.8)
    if images.color is not None:
        red, green, blue = LINEAR[images.color].mean(axis=(0, 1)).tolist()
        color = red, green, blue
    return SurfaceSpec(
        name=name,
        recipe=RECIPE,
        color=color,
        roughness=roughness,
        metallic=metallic,
        tile=tile,
        detail={"images": images_hash(images)},
    )


def images_hash(images: TextureSet) -> str:
    """sha256 over kinds, sizes and pixels."""
    digest = hashlib.sha256()
    for field in fields(images):
        image = getattr(images, field.name)
        if image is not None:
            digest.update(f"{field.name} {image.shape} ".encode())
            digest.update(np.ascontiguousarray(image).tobytes())
    return digest.hexdigest()
