"""Piano hinges: knuckles of two leaves in turn along one pin, as long as what they join."""

from artgen.geometry.solid import Solid, cylinder, slab, union

LEAF = 0.0015
PLAY = 0.0006
"""m; thickness of a leaf, and air between knuckles."""


def piano_hinge(
    *, length: float, y: float, z: float, radius: float, knuckles: int, leaf: float
) -> tuple[Solid, Solid]:
    """(lower leaf with its knuckles, upper leaf with its) on a pin along x through (y, z).

    Args:
        y: of the pin; the leaves lie on faces at `y - radius`.
        knuckles: odd; the lower leaf has the outer ones.
        leaf: height of a leaf above and below the pin, m.
    """
    step, face = length / knuckles, y - radius
    barrels: tuple[list[Solid], list[Solid]] = ([], [])
    for k in range(knuckles):
        start = -length / 2.0 + k * step + PLAY / 2.0
        barrels[k % 2].append(cylinder(radius, step - PLAY, axis="x", segments=14).at(start, y, z))
    half, air = length / 2.0, radius + PLAY
    made = []
    for own, side in zip(barrels, (-1.0, 1.0), strict=True):
        ends = sorted((z + side * air, z + side * leaf))
        plate = slab((-half, face, ends[0]), (half, face + LEAF, ends[1]))
        reach = sorted((z, z + side * (air + 1e-4)))
        arms = [
            slab((b.bounds[0, 0], face, reach[0]), (b.bounds[1, 0], face + LEAF, reach[1]))
            for b in own
        ]
        made.append(union([plate, *arms, *own]))
    return made[0], made[1]
