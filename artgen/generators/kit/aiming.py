"""Solids drawn along +z aimed along any direction."""

from collections.abc import Sequence

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid


def aimed(solid: Solid, at: Sequence[float], direction: Sequence[float]) -> Solid:
    """What was drawn along +z from zero, put at `at` along `direction`; +x of the drawing stays
    level."""
    return solid.transformed(aim_matrix(at, direction))


def aim_matrix(at: Sequence[float], direction: Sequence[float]) -> Floats:
    """(4, 4) frame at `at` whose z axis is `direction` and whose x axis is level."""
    z = np.asarray(direction, float)
    z = z / np.linalg.norm(z)
    level = np.array([1.0, 0.0, 0.0]) if abs(z[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    y = np.cross(z, level)
    y /= np.linalg.norm(y)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = np.cross(y, z), y, z, at
    return matrix
