"""The stub of a power cord with its strain relief."""

import numpy as np

from artgen.articulation.types import Body, Vector
from artgen.generators.kit.density import RUBBER
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Solid, cone, slab, wire

RADIUS = 0.0034
"""m; of a flexible cord H05VV-F 3G0.75 (6.8 mm across)."""
RELIEF = 0.020
"""m; length of the strain relief."""


def cord_stub(at: Vector, *, out: Vector, surface: str, run: float = 0.05) -> Body:
    """A cord that leaves the face at `at` along `out` (a side of the object, level), sinks to the
    floor and runs on for `run` m."""
    x, y = out[0], out[1]
    corner = at[2] - RADIUS * 1.3
    path = bent(
        [
            (-0.004, 0.0, 0.0),
            (RELIEF + 0.010, 0.0, 0.0),
            (RELIEF + 0.010 + 0.4 * corner, 0.0, -corner),
            (RELIEF + 0.012 + 0.4 * corner + run, 0.0, -corner),
        ],
        min(0.012, 0.4 * corner),
    )
    relief = cone(1.9 * RADIUS, 1.2 * RADIUS, RELIEF, axis="x", segments=12)
    solid = _turned(wire(path, RADIUS, sides=8) | relief, x, y).at(*at)
    reach = RELIEF + 0.010
    straight = slab((0.0, -RADIUS, -RADIUS), (reach, RADIUS, RADIUS))
    lying = slab(
        (reach + 0.4 * corner, -RADIUS, -corner - RADIUS),
        (reach + 0.4 * corner + run, RADIUS, -corner + RADIUS),
    )
    touch = tuple(_turned(piece, x, y).at(*at) for piece in (straight, lying))
    return Body(solid=solid, surface=surface, density=RUBBER, collision=touch)


def _turned(solid: Solid, x: float, y: float) -> Solid:
    """What was drawn along +x laid along the level direction (x, y)."""
    matrix = np.eye(4)
    matrix[:2, 0], matrix[:2, 1] = (x, y), (-y, x)
    return solid.transformed(matrix)
