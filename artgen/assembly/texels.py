"""How dense texture lies on surfaces and how stretched it is, over objects, parts and materials.

UV are metres on the surface, so density is 1 where lengths are kept whatever the material: texels a
metre are those of a tile over its width. Prints are left out; they fill the face they are made for.
"""

import numpy as np

from artgen.assembly.assemble import Assembled
from artgen.assembly.looks import stuff_of
from artgen.assembly.uv_fix import areas, singular_values
from artgen.core.mesh import Floats, TriMesh


def density(mesh: TriMesh) -> Floats:
    """(F,) texels a metre over those of the material: 1 where lengths are kept."""
    values = singular_values(mesh.triangles, np.asarray(mesh.uv))
    return np.asarray(np.sqrt(values.prod(axis=1)))


def ratios(mesh: TriMesh) -> Floats:
    """(F,) larger over smaller singular value of the texture's map: 1 where it is not stretched."""
    values = singular_values(mesh.triangles, np.asarray(mesh.uv))
    return np.asarray(values[:, 0] / values[:, 1].clip(min=1e-9))


def stretch(mesh: TriMesh, weights: Floats | None = None) -> float:
    """95th percentile of `ratios` by (F,) weights, areas unless given."""
    return weighted_quantile(
        ratios(mesh), areas(mesh.triangles) if weights is None else weights, 0.95
    )


def weighted_quantile(values: Floats, weights: Floats, share: float) -> float:
    """The value below which lies a share of the weight."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order])
    return float(values[order[np.searchsorted(reached, share * reached[-1])]])


def by_surface(new: Assembled) -> dict[str, float]:
    """Surface name to the coefficient of variation of density over its area."""
    found: dict[str, list[tuple[Floats, Floats]]] = {}
    for _, _, piece in new.parts:
        dense, weight = density(piece.mesh), areas(piece.mesh.triangles)
        for slot in piece.slots:
            own = np.asarray(piece.mesh.slot) == slot
            if stuff_of(new.surfaces[slot]) != "print":
                found.setdefault(new.surfaces[slot].name, []).append((dense[own], weight[own]))
    return {name: _variation(pairs) for name, pairs in found.items()}


def _variation(pairs: list[tuple[Floats, Floats]]) -> float:
    values, weights = (np.concatenate(column) for column in zip(*pairs, strict=True))
    mean = float(np.average(values, weights=weights))
    return float(np.sqrt(np.average((values - mean) ** 2, weights=weights)) / mean)


def part_medians(new: Assembled) -> dict[str, float]:
    """Name of a part to the median by area of density on it."""
    return {
        name: weighted_quantile(density(piece.mesh), areas(piece.mesh.triangles), 0.5)
        for name, _, piece in new.parts
    }
