"""Balance: the spring of a hinge whose part stays where it is put but is too heavy for friction.

No source states springs; without one a dishwasher's door would fall open.
"""

import numpy as np

from artgen.articulation.types import Spring, Vector
from artgen.core.conventions import GRAVITY
from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix

ANGLES = 65
"""Angles at which the weight's torque is looked at."""


def weight_torque(axis: Vector, arm: Floats, mass: float, angles: Floats) -> Floats:
    """N m, positive opening, at each angle (N,), of `mass` kg whose center is at `arm` (3,) m from
    a point on the axis at rest."""
    down = np.array([0.0, 0.0, -mass * GRAVITY])
    turned = np.array([axis_angle_matrix(axis, float(q)) @ arm for q in angles])
    return np.asarray(np.cross(turned, down) @ axis)


def balancing(torque: Floats, angles: Floats) -> tuple[Spring, float] | None:
    """The spring that leaves the least of a torque between two angles, as far as its stiffness
    follows from both ends, and how much it leaves, N m; None where no spring helps.

    Among lines of that slope the one midway between the highest and the lowest that touch the
    torque is nearest to it (Chebyshev).
    """
    stiffness = float((torque[-1] - torque[0]) / (angles[-1] - angles[0]))
    if stiffness <= 0.0:
        return None
    rest = torque - stiffness * angles
    middle, left = float(rest.max() + rest.min()) / 2.0, float(np.ptp(rest)) / 2.0
    if left >= np.abs(torque).max():
        return None
    return Spring(stiffness=stiffness, reference=-middle / stiffness), left
