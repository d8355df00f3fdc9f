"""Mass properties of closed bodies and of shells, which weigh as sheets of one thickness."""

from collections.abc import Sequence

from artgen.articulation.types import Mass
from artgen.geometry.measure import combined, moments, sheet_moments
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
