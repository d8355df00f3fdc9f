"""Rotating arms that spray water."""

import math

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, box, cylinder, prism, union

NOZZLES = 2
"""On each blade."""


def spray_arm(*, reach: float, blades: int, thickness: float, hub: float, rise: float) -> Solid:
    """Blades around a hub on the z axis, their undersides at z = 0; nozzles look up.

    Args:
        reach: radius of the circle that the blades sweep, m.
        blades: how many, evenly around.
        thickness: of the blades.
        hub: radius of the hub.
        rise: from the blades' upper side to the hub's top.
    """
    blade = prism(_blade(reach, hub), thickness)
    places = np.linspace(0.5, 0.88, NOZZLES) * reach
    nozzles = [
        cylinder(0.0035, 0.0012, segments=5).at(float(x), 0.0, thickness - 0.0001) for x in places
    ]
    one = union([blade, *nozzles])
    turned = [one.turned("z", 2.0 * math.pi * k / blades) for k in range(blades)]
    return union([*turned, cylinder(hub, thickness + rise, segments=16)])


def _blade(reach: float, hub: float) -> Floats:
    """Outline of one blade along +x: broad at the hub, round at the tip."""
    tip, root = 0.32 * hub, 0.62 * hub
    end = arc((reach - tip, 0.0), tip, -math.pi / 2.0, math.pi / 2.0, 6)
    return np.concatenate([[(0.0, -root)], end, [(0.0, root)]])


def swept_collision(
    *, reach: float, blades: int, thickness: float, hub: float
) -> tuple[Solid, ...]:
    """Boxes of the blades for two blades, a box of the hub otherwise."""
    if blades == 2:
        return (box((1.96 * reach, 0.9 * hub, thickness)),)
    return (box((1.3 * hub, 1.3 * hub, thickness)),)
