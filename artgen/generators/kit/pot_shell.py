"""Bodies of cooking pots: wall with a rounded foot and a pouring rim, lining, sandwich bottom."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.density import ALUMINIUM
from artgen.generators.kit.round_contact import round_boxes
from artgen.generators.kit.round_wall import (
    offset_inwards,
    revolved_room,
    revolved_shell,
    wall_ring,
)
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, revolve, slab

LINING = 0.0005
"""m; thickness of what is seen inside: enamel, a coat, or brushed steel."""
SEGMENTS = 48


@dataclass(frozen=True, kw_only=True)
class PotShell:
    """A round pot on z = 0, its rim at `height`.

    Attributes:
        radius: of the wall, outside, m.
        height: of the rim, m.
        wall: as drawn, m.
        corner: radius of the foot, m.
        flare: how far the rim turns outwards, m.
        disc: thickness of the sandwich bottom, m; 0 for none.
        taper: of the foot, as a share of the radius.
        density: kg/m3 of the wall as drawn.
    """

    radius: float
    height: float
    wall: float
    corner: float
    flare: float
    disc: float
    taper: float
    density: float

    @cached_property
    def profile(self) -> Floats:
        """(N, 2) points (radius, z) of the outside from the floor's edge to the rim."""
        low, foot = self.disc, self.radius * (1.0 - self.taper)
        curve = arc((foot - self.corner, low + self.corner), self.corner, -math.pi / 2.0, 0.0, 6)
        top = self.height
        rise = [(self.radius, top - 0.010)]
        turn = [
            (self.radius + self.flare * (1.0 - math.cos(a)), top - 0.010 + 0.010 * math.sin(a))
            for a in np.linspace(0.0, math.pi / 2.0, 5)[1:]
        ]
        if self.flare <= 0.0:
            turn = [(self.radius, top)]
        return np.concatenate([curve, rise, turn])

    @property
    def mouth(self) -> float:
        """Inner radius of the straight wall under the rim."""
        return self.radius - self.wall

    @property
    def edge(self) -> float:
        """Outer radius of the rim."""
        return self.radius + self.flare

    @property
    def ground(self) -> float:
        """z of the inner floor."""
        return self.disc + self.wall

    def radius_at(self, z: float) -> float:
        """Of the outside, m."""
        return float(np.interp(z, self.profile[:, 1], self.profile[:, 0]))

    def room(self, *, more: float = 0.0) -> Solid:
        """The inside; `more` shrinks it by so many m."""
        return revolved_room(self.profile, self.wall + more, segments=SEGMENTS)

    def outside(self, *, more: float = 0.0) -> Solid:
        """The full body, grown by `more` m."""
        points = offset_inwards(self.profile, -more) if more else self.profile
        closed = np.concatenate([[(0.0, points[0, 1])], points, [(0.0, points[-1, 1])]])
        return revolve(closed, segments=SEGMENTS)

    def bodies(self, outer: str, inner: str, bottom: str) -> list[Body]:
        """Wall with its contact pieces, lining, and bottom where there is one."""
        contact = (*self._ring(), *self._floor())
        shell = revolved_shell(self.profile, self.wall, segments=SEGMENTS)
        bodies = [Body(solid=shell, surface=outer, density=self.density, collision=contact)]
        if inner != outer:
            skin = revolved_room(self.profile, self.wall - LINING, segments=SEGMENTS)
            below = slab((-1.0, -1.0, -1.0), (1.0, 1.0, self.height - 0.0008))
            lining = (skin - self.room()) & below
            bodies.append(Body(solid=lining, surface=inner, density=self.density))
        if self.disc > 0.0:
            r = self.radius * (1.0 - self.taper) - 0.35 * self.corner
            outline = [(0.0, 0.0), (r - 0.0015, 0.0), (r, 0.0015), (r, self.disc - 0.0008),
                       (r - 0.0008, self.disc), (0.0, self.disc)]  # fmt: skip
            disc = revolve(outline, segments=SEGMENTS)
            bodies.append(Body(solid=disc, surface=bottom, density=1.15 * ALUMINIUM))
        return bodies

    def _ring(self) -> tuple[Solid, ...]:
        low, foot = self.ground, self.radius * (1.0 - self.taper)
        top = self.height - 0.0004
        levels = [(low, foot - self.wall, foot), (top, self.mouth, self.radius)]
        return wall_ring(levels)

    def _floor(self) -> tuple[Solid, ...]:
        return round_boxes(self.radius * (1.0 - self.taper) - 0.4 * self.corner, 0.0, self.ground)
