"""What color a part has at a point: texture lookups at cast hits."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from artgen.core.errors import RenderError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.export.glb_content import Skin
from artgen.imaging import srgb_from_linear
from renders.glb import Appearance, surfaces_by_name
from renders.raycast import Hits, barycentric

Bytes = NDArray[np.uint8]
APART = 1e-5
"""Greatest distance, in sizes of the part, between a triangle's middle in the OBJ (float64) and in
the GLB (float32, 6e-8 of the coordinates): far above rounding, far below any triangle's size."""


class Paint:
    """Base color and roughness of one part."""

    def __init__(
        self,
        name: str,
        mesh: TriMesh,
        appearance: Appearance,
        surfaces: Mapping[str, SurfaceSpec],
    ) -> None:
        """Find, for each triangle of the mesh, the one of the GLB that knows its surface.

        Raises:
            RenderError: the GLB shows other triangles than the mesh.
        """
        own = [skin for skin in appearance.skins if skin.part == name]
        if not own:
            raise RenderError(f"the GLB has no part {name}; generate the asset anew")
        self._corners = np.concatenate([skin.vertices[skin.faces] for skin in own])
        self._uv = np.concatenate([skin.uv[skin.faces] for skin in own])
        self._skin = np.repeat(np.arange(len(own)), [len(skin.faces) for skin in own])
        self._images = [_images(skin, appearance, surfaces[skin.surface]) for skin in own]
        size = float(np.ptp(mesh.vertices, axis=0).max())
        apart, self._match = cKDTree(_keys(self._corners, size)).query(_keys(mesh.triangles, size))
        if len(self._corners) != len(mesh.faces) or apart.max() > APART * size:
            raise RenderError(
                f"part {name} has {len(self._corners)} triangles in the GLB and "
                f"{len(mesh.faces)} in its OBJ, up to {apart.max():.1e} m apart; "
                "generate the asset anew"
            )

    def at(self, hits: Hits) -> tuple[Bytes, Bytes]:
        """(N, 3) sRGB and (N,) roughness, 255 is 1."""
        triangle = self._match[hits.triangle]
        weights = barycentric(hits.point, self._corners[triangle])
        uv = np.einsum("ni,nij->nj", weights, self._uv[triangle])
        color = np.zeros((len(uv), 3), np.uint8)
        roughness = np.zeros(len(uv), np.uint8)
        for k, (tint, rough) in enumerate(self._images):
            own = self._skin[triangle] == k
            if own.any():
                color[own] = sampled(tint, uv[own])
                roughness[own] = sampled(rough, uv[own])[:, 0]
        return color, roughness


def _images(skin: Skin, appearance: Appearance, surface: SurfaceSpec) -> tuple[Bytes, Bytes]:
    """(H, W, 3) sRGB and (H, W, 1) roughness; one pixel where a number holds everywhere."""
    look = appearance.looks[skin.surface]
    plain = np.rint(255.0 * srgb_from_linear(np.array(surface.color)))
    rough = np.array([[[round(255.0 * surface.roughness)]]], np.uint8)
    return (
        plain.astype(np.uint8).reshape(1, 1, 3) if look.color is None else look.color,
        rough if look.orm is None else look.orm[..., 1:2],
    )


def sampled(image: Bytes, uv: Floats) -> Bytes:
    """(N, C) of a repeating (H, W, C) image at (N, 2), v downward; bilinear between the stored
    values, as Cycles reads 8-bit images."""
    height, width = image.shape[:2]
    x, y = uv[:, 0] * width - 0.5, uv[:, 1] * height - 0.5
    left, top = np.floor(x), np.floor(y)
    s, t = (x - left)[:, None], (y - top)[:, None]
    column, row = left.astype(np.intp), top.astype(np.intp)
    columns, rows = (column % width, (column + 1) % width), (row % height, (row + 1) % height)
    upper = image[rows[0], columns[0]] * (1.0 - s) + image[rows[0], columns[1]] * s
    lower = image[rows[1], columns[0]] * (1.0 - s) + image[rows[1], columns[1]] * s
    return np.rint(upper * (1.0 - t) + lower * t).astype(np.uint8)


def _keys(corners: Floats, size: float) -> Floats:
    """(F, 6) middle and, so that two faces of a sheet differ, a little of the normal."""
    a, b, c = corners.transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    area = np.linalg.norm(across, axis=1, keepdims=True)
    facing = across / np.where(area > 0.0, area, 1.0)
    return np.concatenate([corners.mean(axis=1), 1e-6 * size * facing], axis=1)


def paints(
    names: Sequence[str],
    meshes: Sequence[TriMesh],
    appearance: Appearance,
    surfaces: Sequence[SurfaceSpec],
) -> list[Paint]:
    """The paint of every part."""
    by_name = surfaces_by_name(surfaces, appearance)
    return [
        Paint(name, mesh, appearance, by_name) for name, mesh in zip(names, meshes, strict=True)
    ]
