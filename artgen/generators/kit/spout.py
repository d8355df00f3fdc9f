"""Spouts of taps: swept tubes in the plane x = 0 that end over -y, and their aerators."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from artgen.core.mesh import Floats
from artgen.generators.kit.aiming import aimed
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, hull, loft, tube, wire

SIDES = 18
TURN = math.radians(9.0)
"""By which a bend turns at most from chord to chord."""
PIECE = math.radians(46.0)
"""By which a convex contact piece of a bend turns at most."""


@dataclass(frozen=True, kw_only=True)
class SpoutPath:
    """Centre line of a tube as legs joined by bends.

    Attributes:
        corners: (y, z) of the ends and of the sharp corners between legs, m.
        bends: radius at each inner corner.
        radius: of the tube.
        square: a square tube as wide as a round one.
    """

    corners: tuple[tuple[float, float], ...]
    bends: tuple[float, ...]
    radius: float
    square: bool = False

    @property
    def end(self) -> tuple[float, float, float]:
        """Middle of the outlet."""
        y, z = self.corners[-1]
        return 0.0, y, z

    @property
    def aim(self) -> tuple[float, float, float]:
        """Unit vector along the last leg, out of the tube."""
        (a, b), (c, d) = self.corners[-2:]
        size = math.hypot(c - a, d - b)
        return 0.0, (c - a) / size, (d - b) / size

    def solid(self) -> Solid:
        """The tube, solid inside."""
        line = np.concatenate([run for run, _ in self._runs()])
        keep = np.r_[True, np.linalg.norm(np.diff(line, axis=0), axis=1) > 1e-7]
        return self._swept(line[keep])

    def contact(self) -> tuple[Solid, ...]:
        """Convex pieces along the tube."""
        pieces = []
        for run, turned in self._runs():
            count = max(1, math.ceil(turned / PIECE))
            ends = np.linspace(0, len(run) - 1, count + 1).round().astype(int)
            pieces += [self._swept(run[a : b + 1]).hull() for a, b in pairwise(ends.tolist())]
        return tuple(pieces)

    def _swept(self, line: Floats) -> Solid:
        if self.square:
            return wire(line, 0.886 * self.radius, sides=4)
        return wire(line, self.radius, sides=SIDES)

    def _runs(self) -> list[tuple[Floats, float]]:
        """Legs and bends in turn, each with the angle it turns by."""
        points = np.array([(0.0, y, z) for y, z in self.corners])
        runs: list[tuple[Floats, float]] = []
        start = points[0]
        for before, corner, after, radius in zip(
            points, points[1:], points[2:], self.bends, strict=False
        ):
            arc, turn = _bend(before, corner, after, radius)
            if np.linalg.norm(arc[0] - start) > 1e-6:
                runs.append((np.stack([start, arc[0]]), 0.0))
            runs.append((arc, turn))
            start = arc[-1]
        if np.linalg.norm(points[-1] - start) > 1e-6:
            runs.append((np.stack([start, points[-1]]), 0.0))
        return runs


def _bend(before: Floats, corner: Floats, after: Floats, radius: float) -> tuple[Floats, float]:
    into = (corner - before) / np.linalg.norm(corner - before)
    out = (after - corner) / np.linalg.norm(after - corner)
    turn = math.acos(float(np.clip(into @ out, -1.0, 1.0)))
    side: Floats = out - into * (into @ out)
    side = side / np.linalg.norm(side)
    start = corner - into * radius * math.tan(turn / 2.0)
    angles = np.linspace(0.0, turn, max(2, math.ceil(turn / TURN)) + 1)[:, None]
    return start + radius * (np.sin(angles) * into + (1.0 - np.cos(angles)) * side), turn


def gooseneck(
    *, foot: float, top: float, reach: float, outlet: float, radius: float, lean: float
) -> SpoutPath:
    """Up from z = `foot`, over a half circle `reach` wide, and down to z = `outlet`.

    `lean` (rad) turns the last leg outwards; the half circle is that much shorter.
    """
    bend = 0.999 * reach / (1.0 + math.tan(math.pi / 4.0 - lean / 2.0))
    slant = (top - outlet) * math.tan(lean)
    corners = ((0.0, foot), (0.0, top), (-reach, top), (-reach - slant, outlet))
    return SpoutPath(corners=corners, bends=(bend, bend), radius=radius)


def aerator(
    at: Sequence[float], aim: Sequence[float], radius: float, length: float
) -> tuple[Solid, Solid]:
    """(collar, mesh) at an outlet: the mesh lies 2.5 mm inside the collar's mouth."""
    collar = tube(radius, radius - 0.0018, length, segments=20)
    mesh = cylinder(radius - 0.0018, length - 0.0025, segments=20)
    return aimed(collar, at, aim), aimed(mesh, at, aim)


def slab_spout(
    *,
    reach: float,
    root: tuple[float, float],
    tip: tuple[float, float],
    z: tuple[float, float],
    start: float,
) -> tuple[Solid, Solid]:
    """(solid, contact) of a cast spout that narrows from `root` to `tip` (width, height).

    Args:
        reach: from the axis to the nose along -y, m.
        root: width and height at y = `start`.
        tip: at the nose.
        z: of the middles of root and tip.
        start: y of the root.
    """
    rings = []
    for share in (0.0, 0.5, 0.8, 0.92, 0.98, 1.0):
        near = min(1.0, (1.0 - share) / 0.12)
        round_off = 1.0 - 0.22 * (1.0 - math.sqrt(1.0 - (1.0 - near) ** 2))
        width, height = ((a + (b - a) * share) * round_off for a, b in zip(root, tip, strict=True))
        section = rounded_rectangle(width, height, 0.32 * min(width, height), segments=4)
        y = start - (reach + start) * share
        middle = z[0] + (z[1] - z[0]) * share
        rings.append(np.c_[section[:, 0], np.full(len(section), y), middle + section[:, 1]])
    solid = loft(np.array(rings))
    ends = [
        (x * w / 2.0, y, middle + h * tall / 2.0)
        for y, (w, tall), middle in ((start, root, z[0]), (-reach, tip, z[1]))
        for x in (-0.9, 0.9)
        for h in (-0.9, 0.9)
    ]
    return solid, hull(np.array(ends))
