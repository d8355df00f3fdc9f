"""The washing space of a dishwasher: walls, sloped floor, sump, filter."""

from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, hull, prism, slab, tube, union, upright

FLOOR_CORNER = 0.008
"""m; bending radius of the floor, small so that wheels find level ground at the walls."""
SUMP_RADIUS = 0.062
SUMP_DROP = 0.024
"""How far the floor slopes down to the sump's rim, m."""
EMBOSSING = 0.0018
"""How far beads stand into the tub, m."""


@dataclass(frozen=True, kw_only=True)
class Tub:
    """A cavity open towards -y, its mouth in the plane y = 0.

    Attributes:
        half_width: of the cavity, m.
        floor: z of the level ground at the walls.
        ceiling: z.
        depth: y of the rear wall's inside.
        wall: thickness of the sheet as drawn.
        corner: radius of the upper corners.
        beads: embossed beads on each side wall.
        beads_upright: whether they stand; else they lie.
    """

    half_width: float
    floor: float
    ceiling: float
    depth: float
    wall: float
    corner: float
    beads: int
    beads_upright: bool

    @property
    def sump(self) -> tuple[float, float]:
        """(x, y) of the sump's middle."""
        return 0.0, 0.52 * self.depth


def tub_section(tub: Tub, grown: float = 0.0) -> Floats:
    """Outline of the cavity in (z, x), pushed outwards by `grown` m."""
    height, width = tub.ceiling - tub.floor, 2.0 * tub.half_width
    low, high = FLOOR_CORNER + grown, tub.corner + grown
    shape = rounded_rectangle(
        height + 2 * grown, width + 2 * grown, (low, high, high, low), segments=4
    )
    return np.asarray(shape + np.array([(tub.floor + tub.ceiling) / 2.0, 0.0]))


def tub_solid(tub: Tub, *, flange: Solid) -> Solid:
    """Walls, rear wall, floor with its slope to the sump, beads, and the frame around the mouth."""
    mouth = upright(prism(tub_section(tub), tub.depth + 0.02), "y").at(y=-0.02)
    shell = upright(prism(tub_section(tub, tub.wall), tub.depth + tub.wall), "y")
    cavity = upright(prism(tub_section(tub), tub.depth), "y")
    x, y = tub.sump
    pan = slab(
        (-tub.half_width + 0.02, 0.066, tub.floor - SUMP_DROP - 0.032),
        (tub.half_width - 0.02, tub.depth - 0.03, tub.floor - 0.5 * tub.wall),
    )
    solid = ((shell | pan) - cavity - _slope(tub)) - cylinder(
        SUMP_RADIUS, SUMP_DROP + 0.02, segments=20
    ).at(x, y, tub.floor - SUMP_DROP - 0.02)
    return union([solid, flange - mouth, *_beads(tub)])


def _slope(tub: Tub) -> Solid:
    x, y = tub.sump
    reach = tub.half_width - 0.058
    rim = [(u, v, tub.floor + 0.001) for u in (-reach, reach) for v in (0.085, tub.depth - 0.05)]
    low = circle(SUMP_RADIUS + 0.004, segments=20) + np.array([x, y])
    return hull([*rim, *((u, v, tub.floor - SUMP_DROP) for u, v in low)])


def _beads(tub: Tub) -> list[Solid]:
    """Flat beads on side walls and a disc on the rear wall, sunk into the sheet by half of it."""
    sunk, x = 0.5 * tub.wall, tub.half_width
    near, far = x - EMBOSSING, x + sunk
    low, high = tub.floor + 0.06, tub.ceiling - tub.corner - 0.03
    made = []
    for k in range(tub.beads):
        share = (k + 0.5) / tub.beads
        if tub.beads_upright:
            y = 0.06 + share * (tub.depth - 0.12)
            right = slab((near, y - 0.016, low), (far, y + 0.016, high))
        else:
            z = low + share * (high - low)
            right = slab((near, 0.05, z - 0.012), (far, tub.depth - 0.05, z + 0.012))
        made += [right, right.mirrored("x")]
    middle = (tub.floor + tub.ceiling) / 2.0
    disc = tube(0.30 * x, 0.22 * x, EMBOSSING + sunk, axis="y", segments=20)
    return [*made, disc.at(0.0, tub.depth - EMBOSSING, middle)]


def filter_cup(tub: Tub) -> Solid:
    """The round filter in the sump with its grip, standing clear of the spray arm above."""
    x, y = tub.sump
    bottom = tub.floor - SUMP_DROP - 0.018
    plate = cylinder(SUMP_RADIUS - 0.003, 0.012, segments=24).at(x, y, bottom)
    ring = tube(0.034, 0.029, 0.026, segments=20).at(x, y, bottom)
    return union([plate, ring, box((0.056, 0.004, 0.022), at=(x, y, bottom))])


def salt_cap(tub: Tub) -> Solid:
    """The screw cap of the softener's salt, sunk into the slope left of the sump."""
    x, y = -0.62 * tub.half_width, tub.sump[1] - 0.09
    base = tub.floor - 0.022
    knob = cylinder(0.031, 0.017, segments=20).at(x, y, base)
    return union([knob, box((0.050, 0.009, 0.022), at=(x, y, base))])
