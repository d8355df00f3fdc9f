"""How evenly dense texture lies on an object."""

import numpy as np

from artgen.assembly.assemble import Assembled
from artgen.assembly.looks import stuff_of
from artgen.assembly.texels import density, weighted_quantile
from artgen.assembly.uv_fix import areas
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec


def density_by_surface(new: Assembled) -> dict[str, float]:
    """Surface name to the coefficient of variation of texel density over its area; surfaces
    without images, prints, which fill the face they are made for, and pictures from elsewhere are
    left out."""
    found: dict[str, list[tuple[Floats, Floats]]] = {}
    for _, _, piece in new.parts:
        dense, weight = density(piece.mesh), areas(piece.mesh.triangles)
        for slot in piece.slots:
            own = np.asarray(piece.mesh.slot) == slot
            if _tiles(new.surfaces[slot]):
                found.setdefault(new.surfaces[slot].name, []).append((dense[own], weight[own]))
    return {name: _variation(pairs) for name, pairs in found.items()}


def _tiles(surface: SurfaceSpec) -> bool:
    """Whether a surface has images that are to be as dense everywhere."""
    return stuff_of(surface) != "print" and surface.recipe not in ("plain", "picture")


def _variation(pairs: list[tuple[Floats, Floats]]) -> float:
    values, weights = (np.concatenate(column) for column in zip(*pairs, strict=True))
    mean = float(np.average(values, weights=weights))
    return float(np.sqrt(np.average((values - mean) ** 2, weights=weights)) / mean)


def density_by_part(new: Assembled) -> dict[str, float]:
    """Name of a part to the median by area of density on it, over the same surfaces."""
    tiling = [slot for slot, surface in enumerate(new.surfaces) if _tiles(surface)]
    medians = {}
    for name, _, piece in new.parts:
        own = np.isin(np.asarray(piece.mesh.slot), tiling)
        if own.any():
            weights = areas(piece.mesh.triangles)[own]
            medians[name] = weighted_quantile(density(piece.mesh)[own], weights, 0.5)
    return medians
