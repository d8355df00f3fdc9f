"""Bails: hoops that swing on two ears, fall by their weight and stop on the rim."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, cylinder, slab, union, wire

AIR = 0.0007
"""m; between the resting hoop and what it rests on."""
CORNER = 0.003
"""m; by which corners of contact boxes leave the hoop's line."""
STEPS = 14
"""Legs of the polyline between an ear and the middle."""
FALL = math.radians(2.0)
"""By which a hoop is lowered at a time until it meets the rim."""
ROUND = 2.7
"""Power of the hoop's superellipse: legs run straight before they bend."""


@dataclass(frozen=True, kw_only=True)
class Bail:
    """A hoop that lies towards -y at rest, its ears on the axis y = 0, z = `height`.

    Attributes:
        span: half the distance between the ears' inner ends, m.
        reach: from the axis to the middle of the hoop, m.
        height: z of the axis, m.
        wire: radius, m.
        grip: radius of the sleeve, m; None leaves the wire bare.
        grip_length: of the sleeve, m.
    """

    span: float
    reach: float
    height: float
    wire: float
    grip: float | None
    grip_length: float

    def path(self) -> Floats:
        """(N, 3) the hoop's middle line upright in the plane y = 0, from one ear to the other,
        relative to the axis; its middle part is straight."""
        angles = np.linspace(0.0, math.pi / 2.0, STEPS + 1)[:-1]
        cos, sin = np.cos(angles), np.sin(angles)
        flat = 0.55 * self.grip_length
        scale = (cos**ROUND + sin**ROUND) ** (-1.0 / ROUND)
        x = flat + (self.span - flat) * scale * cos
        z = self.reach * scale * sin
        right = np.stack([x, 0.0 * x, z], axis=1)
        top = np.array([[flat, 0.0, self.reach]])
        left = right[::-1] * (-1.0, 1.0, 1.0)
        return np.concatenate([right, top, top * (-1.0, 1.0, 1.0), left])

    def rest(self, rim: Floats, bead: float, *, side: float) -> float:
        """Angle above level at which the hoop comes to rest on a rim, rad.

        Args:
            rim: (M, 3) middle line of the rim's bead, closed, m.
            bead: its radius, m.
            side: -1 towards -y, +1 towards +y.
        """
        points, radii = self._measured()
        ends = np.roll(rim, -1, axis=0)
        steps = np.linspace(0.0, 1.0, 4, endpoint=False)[:, None, None]
        line = cKDTree((rim[None] + steps * (ends - rim)[None]).reshape(-1, 3))

        def room(angle: float) -> float:
            """Least distance between hoop and rim, m."""
            y, z = side * math.cos(angle), self.height + math.sin(angle) * points[:, 2]
            apart, _ = line.query(np.stack([points[:, 0], points[:, 2] * y, z], axis=1))
            return float((apart - radii).min() - bead - AIR)

        high = math.radians(80.0)
        while room(high - FALL) >= 0.0 and high > math.radians(-30.0):
            high -= FALL  # Coming from above: below the rim the hoop would be free again.
        low = high - FALL
        for _ in range(24):
            middle = (low + high) / 2.0
            low, high = (middle, high) if room(middle) < 0.0 else (low, middle)
        return high

    def _measured(self) -> tuple[Floats, Floats]:
        """(K, 3) points along the hoop and (K,) its radius there."""
        path = self.path()
        steps = np.linspace(0.0, 1.0, 12, endpoint=False)[:, None]
        points = np.concatenate([a + steps * (b - a) for a, b in pairwise(path)])
        thick = 1.08 * (self.grip or self.wire)
        sleeved = (np.abs(points[:, 0]) <= 0.5 * self.grip_length) & (points[:, 2] > 0.0)
        return points, np.where(sleeved, thick, self.wire)

    def hoop(self, *, hook: float) -> Solid:
        """The wire, upright, with ends that reach `hook` m inwards through the ears."""
        path = self.path()
        ends = path[[0, -1]] + np.array([[-hook, 0.0, 0.0], [hook, 0.0, 0.0]])
        return wire(np.concatenate([ends[:1], path, ends[1:]]), self.wire, sides=8).at(
            z=self.height
        )

    def sleeve(self, *, play: float) -> Solid:
        """The grip around the middle, upright; with `play` it turns on the wire."""
        radius, half = self.grip or self.wire, 0.5 * self.grip_length
        outer = cylinder(radius, 2.0 * half, axis="x", segments=18)
        ridges = [
            cylinder(1.08 * radius, 0.005, axis="x", segments=18).at(x)
            for x in (0.0, 2.0 * half - 0.005)
        ]
        bore = cylinder(self.wire + play, 2.0 * half + 0.02, axis="x", segments=12).at(-0.01)
        return (union([outer, *ridges]) - bore).at(-half, 0.0, self.height + self.reach)

    def collision(self, angle: float, *, middle: bool) -> tuple[Solid, ...]:
        """Boxes along the axes that follow the hoop at rest, `angle` above level towards -y; the
        middle is left out where a sleeve turns on it."""
        path = self.path()
        placed = np.stack(
            [
                path[:, 0],
                -path[:, 2] * math.cos(angle),
                self.height + path[:, 2] * math.sin(angle),
            ],
            axis=1,
        )
        boxes = []
        for a, b in pairwise(placed):
            level = abs(a[0] - b[0]) > 0.9 * self.grip_length
            if level and not middle:
                continue
            length = float(np.linalg.norm(b - a))
            _, y, z = np.sort(np.abs(b - a) / length)
            count = max(1, math.ceil(length * y * z / CORNER))
            for k in range(count):
                ends = np.stack([a + (b - a) * k / count, a + (b - a) * (k + 1) / count])
                boxes.append(
                    slab(ends.min(axis=0) - 0.6 * self.wire, ends.max(axis=0) + 0.6 * self.wire)
                )
        return tuple(boxes)

    def sleeve_collision(self, angle: float) -> Solid:
        """A box along the axes inside the resting sleeve."""
        half, r = 0.5 * self.grip_length, 0.7 * (self.grip or self.wire)
        y, z = -self.reach * math.cos(angle), self.height + self.reach * math.sin(angle)
        return slab((-half, y - r, z - r), (half, y + r, z + r))


def lying(solid: Solid, bail: Bail, angle: float) -> Solid:
    """What was drawn upright, laid down to `angle` above level towards -y."""
    return solid.turned("x", math.pi / 2.0 - angle, about=(0.0, 0.0, bail.height))
