"""Soup: triangles as a file states them, with texture coordinates and what they look like."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats

Faces = NDArray[np.int64]
GRAY = (0.6, 0.6, 0.6)


@dataclass(frozen=True, kw_only=True)
class Look:
    """What a file says of a material.

    Attributes:
        color: sRGB in [0, 1]; an image stands instead of it.
        opacity: 1 lets no light through.
        roughness: as in glTF.
        image: content of a PNG or JPEG file, row 0 at the largest v.
    """

    color: tuple[float, float, float] = GRAY
    opacity: float = 1.0
    roughness: float = 0.6
    metallic: float = 0.0
    image: bytes | None = None

    @property
    def digest(self) -> str:
        """Of all it says: names of materials repeat with different content."""
        head = repr((self.color, self.opacity, self.roughness, self.metallic)).encode()
        return hashlib.sha256(head + b"|" + (self.image or b"")).hexdigest()


@dataclass(frozen=True, kw_only=True, eq=False)
class Soup:
    """Triangles that nobody has checked but for their indices and that numbers are finite.

    Attributes:
        vertices: (V, 3), units and frame of the file.
        faces: (F, 3).
        uv: (F, 3, 2) in copies of the image, v up; nan where a triangle has none.
        look: (F,) index into `looks`.
    """

    vertices: Floats
    faces: Faces
    uv: Floats
    look: NDArray[np.int64]
    looks: tuple[Look, ...]

    def of(self, kept: NDArray[np.bool_] | NDArray[np.intp]) -> "Soup":
        """Some of its triangles."""
        return Soup(
            vertices=self.vertices,
            faces=self.faces[kept],
            uv=self.uv[kept],
            look=self.look[kept],
            looks=self.looks,
        )


def joined_soups(soups: Sequence[Soup]) -> Soup:
    """Several as one; equal looks are one."""
    starts = np.cumsum([0, *(len(soup.vertices) for soup in soups)])
    looks: dict[str, Look] = {}
    numbers = []
    for soup in soups:
        for look in soup.looks:
            looks.setdefault(look.digest, look)
        places = {digest: k for k, digest in enumerate(looks)}
        numbers.append(np.array([places[look.digest] for look in soup.looks])[soup.look])
    return Soup(
        vertices=np.concatenate([soup.vertices for soup in soups]),
        faces=np.concatenate([s.faces + start for s, start in zip(soups, starts, strict=False)]),
        uv=np.concatenate([soup.uv for soup in soups]),
        look=np.concatenate(numbers),
        looks=tuple(looks.values()),
    )
