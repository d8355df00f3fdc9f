"""The GLB of a bundle as arrays: what each part's triangles look like, texture by texture."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from artgen.core.errors import ExportError, RenderError
from artgen.core.surface import SurfaceSpec
from artgen.export.glb_content import Skin, read_glb

Bytes = NDArray[np.uint8]


@dataclass(frozen=True, kw_only=True, eq=False)
class Look:
    """Images of one surface, row 0 at v = 0; None where the surface's number holds.

    Attributes:
        color: (H, W, 3) sRGB.
        orm: (H, W, 3) linear; G = roughness, B = metallic.
        normal: (H, W, 3) tangent space, y up.
        emission: (H, W, 3) sRGB.
    """

    color: Bytes | None = None
    orm: Bytes | None = None
    normal: Bytes | None = None
    emission: Bytes | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Appearance:
    """All that can be seen of an asset.

    Attributes:
        skins: in the order of the file.
        looks: by surface name.
    """

    skins: tuple[Skin, ...]
    looks: Mapping[str, Look]


def read_appearance(path: Path) -> Appearance:
    """Triangles, texture coordinates and images of `path`.

    Raises:
        RenderError: the file is missing, damaged, or not one that artgen wrote.
    """
    try:
        content = read_glb(path)
        looks = {
            surface: Look(**{kind: _decoded(image) for kind, image in images.items()})
            for surface, images in content.images.items()
        }
    except ExportError as error:
        raise RenderError(str(error)) from error
    except (OSError, ValueError) as error:
        raise RenderError(f"{path} cannot be read ({error!r}); generate the asset anew") from error
    return Appearance(skins=content.skins, looks=looks)


def _decoded(content: bytes) -> Bytes:
    with Image.open(io.BytesIO(content)) as image:
        return np.asarray(image.convert("RGB"))


def surfaces_by_name(
    surfaces: Sequence[SurfaceSpec], appearance: Appearance
) -> dict[str, SurfaceSpec]:
    """The surfaces of a manifest for a GLB that uses no other.

    Raises:
        RenderError: the GLB uses one that the manifest does not state.
    """
    known = {surface.name: surface for surface in surfaces}
    if strange := {skin.surface for skin in appearance.skins} - set(known):
        raise RenderError(
            f"the GLB uses surfaces {', '.join(sorted(strange))}, the manifest states "
            f"{', '.join(known)}; generate the asset anew"
        )
    return known
