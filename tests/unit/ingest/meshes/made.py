"""Bodies of plain solids, for tests of what collision is made of."""

import numpy as np

from artgen.core.mesh import Floats
from artgen.ingest.meshes.clean import Body, bodies_of, welded_soup
from artgen.ingest.meshes.soup import Look, Soup


def bodies_from(corners: Floats) -> list[Body]:
    """Of (F, 3, 3) triangles: closed bodies, and one shell of what is open."""
    count = len(corners)
    soup = Soup(
        vertices=corners.reshape(-1, 3),
        faces=np.arange(3 * count).reshape(-1, 3),
        uv=np.full((count, 3, 2), np.nan),
        look=np.zeros(count, np.int64),
        looks=(Look(),),
    )
    return bodies_of(welded_soup(soup)[0], "leaf")[0]
