"""The frame of a grip: where a gripper goes, which way it faces, and which way it then pulls."""

import numpy as np

from artgen.articulation.types import Grip
from artgen.core.mesh import Floats
from artgen.core.transform import rigid

ASKEW = 1e-6
"""Sine of the angle between outward and pull below which the two count as one direction."""


def grip_frame(grip: Grip) -> Floats:
    """(4, 4) object_from_grip at rest.

    z runs outward, against the approaching hand; x runs along the pull as far as that is square to
    z, and where the pull is along z, along the coordinate axis that z is most square to (the first
    of equals), as far as that is square to z; y makes the frame right-handed.
    """
    z = np.array(grip.outward)
    x = np.array(grip.pull) - z * float(np.dot(grip.pull, z))
    if np.linalg.norm(x) < ASKEW:
        along = np.eye(3)[int(np.argmin(np.round(np.abs(z), 9)))]
        x = along - z * float(along @ z)
    x /= np.linalg.norm(x)
    return rigid(np.stack([x, np.cross(z, x), z], axis=1), grip.position)
