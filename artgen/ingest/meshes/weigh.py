"""Mass properties of closed bodies and of shells, which weigh as sheets of one thickness."""

from collections.abc import Sequence

import numpy as np

from artgen.articulation.types import Mass
from artgen.core.mesh import Floats
from artgen.geometry.measure import Moments, combined, moments
from artgen.ingest.meshes.clean import Body


def weighed(bodies: Sequence[Body], *, density: float, thickness: float) -> Mass:
    """Mass, center and inertia of a part.

    Closed bodies count by their volume, twice where two of them overlap; shells by their area.

    Args:
        density: kg/m3 of all.
        thickness: of shells, m.
    """
    pieces = []
    for body in bodies:
        corners = body.soup.vertices[body.soup.faces]
        own = moments(corners) if body.closed else sheet_moments(corners, thickness)
        pieces.append((density, own))
    mass, center, tensor = combined(pieces)
    return Mass(mass=mass, center=center, inertia=tensor)


def sheet_moments(corners: Floats, thickness: float) -> Moments:
    """Volume integrals of a sheet along (F, 3, 3) triangles.

    Over a triangle, the integral of x x^T is area / 12 (sum of c c^T over corners, plus s s^T with
    s their sum); across the sheet, thickness^2 / 12 n n^T is added, so that no sheet is without
    extent.
    """
    middle = (corners.reshape(-1, 3).min(axis=0) + corners.reshape(-1, 3).max(axis=0)) / 2.0
    a, b, c = (corners - middle).transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    weight = length / 2.0 * thickness
    total = a + b + c
    volume = float(weight.sum())
    center = weight @ total / (3.0 * volume)
    second = sum(np.einsum("i,ij,ik->jk", weight, x, x) for x in (a, b, c, total)) / 12.0
    unit = normal / length[:, None]
    across = np.einsum("i,ij,ik->jk", weight, unit, unit) * thickness**2 / 12.0
    return Moments(volume, center + middle, second + across - volume * np.outer(center, center))
