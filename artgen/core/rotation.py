"""Rotations: axis-angle, quaternion (w, x, y, z), matrices."""

import math
from collections.abc import Sequence

import numpy as np

from artgen.core.mesh import Floats


def axis_angle_matrix(axis: Sequence[float], angle: float) -> Floats:
    """(3, 3) right-handed rotation (Rodrigues); 1 - cos is taken as 2 sin^2(angle / 2), so that it
    keeps all digits for small angles."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    half = math.sin(angle / 2.0)
    return np.eye(3) + math.sin(angle) * cross + 2.0 * half * half * (cross @ cross)


def quaternion(axis: Sequence[float], angle: float) -> Floats:
    """(4,) unit quaternion w, x, y, z."""
    half = math.sin(angle / 2.0)
    return np.array([math.cos(angle / 2.0), axis[0] * half, axis[1] * half, axis[2] * half])
