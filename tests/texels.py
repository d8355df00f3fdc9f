"""How even and how separate the texels of an atlas are."""

from pathlib import Path

import manifold3d as m3
import numpy as np
from pxr import Usd, UsdGeom

from artgen.core.mesh import Floats
from artgen.export.write import ATLAS_SIZE
from artgen.geometry.unwrap import texel_density

THICK = 3.0
"""Texels; charts are packed as whole ones, so thinner triangles stand for more or less surface."""


def texel_figures(folder: Path) -> tuple[float, float]:
    """Of a bundle's USD file: greatest over least texel density, and the share of the atlas's
    square that two places share."""
    corners, atlas = _triangles(folder / "asset.usdc")
    return density_ratio(corners, atlas), shared_area(atlas)


def density_ratio(corners: Floats, atlas: Floats) -> float:
    """Greatest over least texels a meter, roots of areas, over (F, 3, 3) m and (F, 3, 2) in [0, 1].

    A chart is flat along an axis, which shrinks the root of a face's area by 3^(1/4) at most."""
    sides = np.stack([corners[:, k] - corners[:, k - 1] for k in range(3)], axis=1)
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    thickness = area / np.linalg.norm(sides, axis=2).max(axis=1).clip(min=1e-12)
    density = texel_density(corners, atlas)
    kept = density[thickness * ATLAS_SIZE * np.median(density) > THICK]
    return float(kept.max() / kept.min())


def shared_area(atlas: Floats) -> float:
    """Sum less union of the areas of (F, 3, 2) triangles on the atlas; roundings of UV remain."""
    a, b = atlas[:, 1] - atlas[:, 0], atlas[:, 2] - atlas[:, 0]
    areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0
    upright = np.where((areas < 0.0)[:, None, None], atlas[:, ::-1], atlas)
    union = m3.CrossSection(list(upright[areas != 0.0]), m3.FillRule.Positive).area()
    return float(np.abs(areas).sum() - union)


def _triangles(path: Path) -> tuple[Floats, Floats]:
    corners, atlas = [], []
    stage = Usd.Stage.Open(str(path))  # Prims live as long as their stage.
    for prim in stage.Traverse():
        if not (prim.IsA(UsdGeom.Mesh) and prim.GetName() == "visual"):
            continue
        mesh = UsdGeom.Mesh(prim)
        faces = np.asarray(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
        corners.append(np.asarray(mesh.GetPointsAttr().Get(), float)[faces])
        coordinates = UsdGeom.PrimvarsAPI(prim).GetPrimvar("st1").ComputeFlattened()
        atlas.append(np.asarray(coordinates, float).reshape(-1, 3, 2))
    return np.concatenate(corners), np.concatenate(atlas)
