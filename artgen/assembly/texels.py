"""How dense texture lies on surfaces and how stretched it is.

UV are meters on the surface, so density is 1 where lengths are kept whatever the material: texels a
meter are those of a tile over its width.
"""

import numpy as np

from artgen.assembly.uv_fix import areas, singular_values
from artgen.core.mesh import Floats, TriMesh

STRETCH = 1.2
"""Greatest factor between the stretch of a fitted front and of its donor, 95th percentile."""


def density(mesh: TriMesh) -> Floats:
    """(F,) texels a meter over those of the material: 1 where lengths are kept."""
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
