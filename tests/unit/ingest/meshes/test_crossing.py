"""Which parts pass through each other at a pose, told from those that only touch."""

import numpy as np
import pytest

from artgen.core.mesh import Floats
from artgen.core.transform import rigid
from artgen.geometry.solid import box
from artgen.ingest.meshes.crossing import DEEP, Surfaces

DOOR = box((0.4, 0.02, 0.3)).trimesh().triangles
DRAWER = box((0.3, 0.4, 0.2), at=(0.0, 0.3, 0.05)).trimesh().triangles
"""Its front at y = 0.1, the door's back at y = 0.01."""


def pulled(way: float) -> Floats:
    return rigid(np.eye(3), (0.0, -way, 0.0))


@pytest.mark.parametrize(
    ("way", "through"),
    [(0.0, False), (0.09, False), (0.09 + DEEP / 2.0, False), (0.12, True), (0.3, True)],
)
def test_a_drawer_pulled_through_its_shut_door_crosses_it(way: float, through: bool) -> None:
    """Touching, and passing by less than the stated depth, is not crossing."""
    surfaces = Surfaces({"door": DOOR, "drawer": DRAWER})
    assert surfaces.cross("door", "drawer", pulled(way)) is through
    assert surfaces.cross("drawer", "door", pulled(-way)) is through


def test_an_open_surface_crosses_as_a_solid_does() -> None:
    """The door's back alone, as a sheet without thickness."""
    back = DOOR[(DOOR[..., 1] > 0.0).all(axis=1)]
    surfaces = Surfaces({"sheet": back, "drawer": DRAWER})
    assert not surfaces.cross("sheet", "drawer", pulled(0.05))
    assert surfaces.cross("sheet", "drawer", pulled(0.2))
