"""Foamed cases of refrigerators around lined rooms: compressor niche, kick grille, feet, coil."""

from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.density import ABS, POLYPROPYLENE, STEEL
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Solid, box, cylinder, revolve, slab, union, wire

Cell = tuple[tuple[float, float], tuple[float, float]]
"""(x, z) of the lower left and the upper right corner of a room with its share of the walls."""
LINER = 0.0025
"""m; thickness of a liner as drawn."""
BEND = 0.012
"""m; radius of the coil's bends."""


@dataclass(frozen=True, kw_only=True)
class ColdCase:
    """A case from y = 0 backwards.

    Attributes:
        half: half of the width, m.
        depth: y of the back.
        foot: z where it begins.
        top: z where it ends.
        toe_height: z below which the front recedes.
        toe_depth: y of the receding front.
        wall: thickness of foamed walls.
        niche: depth and height of the compressor's niche at the lower back.
        density: effective one of foam between sheets, kg/m3.
    """

    half: float
    depth: float
    foot: float
    top: float
    toe_height: float
    toe_depth: float
    wall: float
    niche: tuple[float, float]
    density: float

    def room(self, cell: Cell, *, corner: float) -> LinedCavity:
        """The lined room of a cell; walls inside the case are thinner than those around it."""
        (x0, z0), (x1, z1) = cell
        inner = 0.72 * self.wall
        left = self.wall if x0 <= -self.half + 1e-9 else inner
        right = self.wall if x1 >= self.half - 1e-9 else inner
        top = self.wall if z1 >= self.top - 1e-9 else inner
        return LinedCavity(
            low=(x0 + left, 0.0, z0 + inner + 0.004),
            high=(x1 - right, self.depth - self.wall, z1 - top),
            corner=corner,
            lining=LINER,
        )

    @property
    def step(self) -> tuple[float, float]:
        """(y, z) of the edge of the step over the niche, seen from inside."""
        deep, high = self.niche
        return self.depth - deep - 0.5 * self.wall, self.foot + high + 0.5 * self.wall

    def bodies(
        self, cells: list[tuple[Cell, LinedCavity]], *, shell: str, liner: str
    ) -> list[Body]:
        """Case, liners, and the step where the niche reaches into a room."""
        low, high = (-self.half, 0.0, self.foot), (self.half, self.depth, self.top)
        toe = slab((-1.0, -0.01, 0.0), (1.0, self.toe_depth, self.toe_height))
        block = slab(low, high) - toe
        niche = self._niche_room()
        for _, room in cells:
            block = block - room.outside()
        made = [
            Body(solid=block - niche, surface=shell, density=self.density, edge=0.003,
                 collision=self._contact(cells)),
            *(Body(solid=room.lined() - niche, surface=liner, density=ABS)
              for _, room in cells),
        ]  # fmt: skip
        steps = [self._step_in(room) for _, room in cells if room.low[2] < self.step[1] - 0.01]
        made += [
            Body(solid=step - niche, surface=liner, density=3.0 * self.density, edge=0.002,
                 collision=self._around_niche([step]))
            for step in steps
        ]  # fmt: skip
        return made

    def _contact(self, cells: list[tuple[Cell, LinedCavity]]) -> tuple[Solid, ...]:
        lowest = min(cell[0][1] for cell, _ in cells)
        pieces = [slab((-self.half, self.toe_depth, self.foot), (self.half, self.depth, lowest))]
        for ((x0, z0), (x1, z1)), room in cells:
            pieces += room.walls((x0, 0.0, z0), (x1, self.depth, z1))
        return self._around_niche(pieces)

    def _around_niche(self, pieces: list[Solid]) -> tuple[Solid, ...]:
        """The cuboids' remains before, beside and above the niche, which stays open."""
        niche = self._niche_room()
        return tuple(rest for piece in pieces for rest in boxes_outside(piece, niche))

    def _step_in(self, room: LinedCavity) -> Solid:
        y, z = self.step
        (x0, _, z0), (x1, y1, _) = room.low, room.high
        return slab((x0 - 0.001, y, z0 - 0.001), (x1 + 0.001, y1 + 0.001, z))

    def _niche_room(self) -> Solid:
        deep, high = self.niche
        side = self.half - 0.020
        return slab((-side, self.depth - deep, self.foot - 0.01),
                    (side, self.depth + 0.01, self.foot + high))  # fmt: skip

    def compressor(self, *, metal: str, mass: float) -> list[Body]:
        """The pot on its rail across the niche, with a suction pipe."""
        deep, high = self.niche
        y, side = self.depth - 0.5 * deep, self.half - 0.018
        rail = slab((-side, y - 0.035, self.foot + 0.002), (side, y + 0.035, self.foot + 0.006))
        radius, tall = min(0.44 * deep, 0.075), min(0.80 * high, 0.16)
        outline = [(0.0, 0.0), (0.8 * radius, 0.0), (radius, 0.16 * tall), (radius, 0.62 * tall),
                   (0.72 * radius, 0.90 * tall), (0.0, tall)]  # fmt: skip
        pot = revolve(outline, segments=20).at(0.25 * self.half, y, self.foot + 0.005)
        pipe = wire(
            bent([(0.25 * self.half - 0.8 * radius, y, self.foot + 0.03),
                  (-0.3 * self.half, y, self.foot + 0.03),
                  (-0.3 * self.half, y, self.foot + high + 0.002)], 0.02),
            0.004,
        )  # fmt: skip
        works = union([pot, pipe])
        return [
            Body(solid=rail, surface=metal, density=STEEL),
            Body(
                solid=works,
                surface=metal,
                density=mass / works.volume,
                collision=(
                    box(
                        (1.4 * radius, 1.4 * radius, 0.9 * tall),
                        at=(0.25 * self.half, y, self.foot + 0.005),
                    ),
                ),
            ),
        ]

    def feet(self, surface: str, *, radius: float) -> list[Body]:
        """Four screw feet with hexagons."""
        x, front, back = self.half - 0.045, self.toe_depth + 0.045, self.depth - 0.045
        pad = min(0.012, 0.4 * self.foot)
        bodies = []
        for u in (-x, x):
            for v in (front, back):
                solid = union([
                    cylinder(radius, pad, segments=14).at(u, v),
                    cylinder(0.45 * radius, self.foot + 0.004 - pad, segments=6).at(u, v, pad),
                ])  # fmt: skip
                piece = box((1.4 * radius, 1.4 * radius, self.foot), at=(u, v, 0.0))
                bodies.append(Body(solid=solid, surface=surface, density=POLYPROPYLENE,
                                   collision=(piece,)))  # fmt: skip
        return bodies

    def grille(self, surface: str, *, bars: int, upright_bars: bool) -> list[Body]:
        """A louvered plate before the toe recess."""
        low, high = self.foot + 0.004, self.toe_height - 0.002
        front, half = self.toe_depth - 0.012, self.half - 0.006
        plate = slab((-half, front, low), (half, self.toe_depth, high))
        wide, tall = 0.78 * half, 0.5 * (high - low) - 0.007
        middle = 0.5 * (low + high)
        if upright_bars:
            pitch = 2.0 * wide / (3 * bars)
            cuts = [slab((x - 0.28 * pitch, front - 0.01, middle - tall),
                         (x + 0.28 * pitch, front + 0.008, middle + tall))
                    for x in -wide + pitch * (np.arange(3 * bars) + 0.5)]  # fmt: skip
        else:
            pitch = 2.0 * tall / bars
            cuts = [slab((-wide, front - 0.01, z - 0.28 * pitch),
                         (wide, front + 0.008, z + 0.28 * pitch))
                    for z in middle - tall + pitch * (np.arange(bars) + 0.5)]  # fmt: skip
        return [Body(solid=plate - union(cuts), surface=surface, density=ABS)]

    def coil(self, surface: str, *, legs: int) -> list[Body]:
        """The condenser's serpentine on the back with its wire rungs; fewer legs where a case is
        too low for the bends between so many."""
        y, wide = self.depth + 0.014, self.half - 0.07
        low, high = self.foot + self.niche[1] + 0.06, self.top - 0.08
        points = []
        for k, z in enumerate(np.linspace(low, high, legs_that_fit(high - low, legs))):
            side = wide if k % 2 else -wide
            points += [(side, y, float(z)), (-side, y, float(z))]
        tube = wire(bent(points, BEND), 0.0028, sides=5)
        start, end = self.depth - 0.001, y - 0.002
        rungs = [slab((x - 0.001, start, low - 0.01), (x + 0.001, end, high + 0.01))
                 for x in np.linspace(-0.8 * wide, 0.8 * wide, 4)]  # fmt: skip
        return [Body(solid=union([tube, *rungs]), surface=surface, density=STEEL)]


def legs_that_fit(room: float, wanted: int) -> int:
    """How many legs of a serpentine lie over `room` m: as many as wanted if two bends fit between
    neighbors; else as many as leave a tenth of the bends straight, two at least."""
    if room > 2.0 * BEND * (wanted - 1):
        return wanted
    return max(2, 1 + int(room / (2.2 * BEND)))


def boxes_outside(piece: Solid, hole: Solid) -> list[Solid]:
    """The cuboids that remain of a cuboid around another, at most six."""
    (low, high), (start, end) = piece.bounds, hole.bounds
    if (start >= high).any() or (end <= low).any():
        return [piece]
    rest = []
    for axis in range(3):
        for first, last in ((low[axis], start[axis]), (end[axis], high[axis])):
            if last - first > 1e-4 and first >= low[axis] and last <= high[axis]:
                a, b = low.copy(), high.copy()
                a[axis], b[axis] = first, last
                rest.append(slab(a, b))
        low, high = low.copy(), high.copy()
        low[axis], high[axis] = max(low[axis], start[axis]), min(high[axis], end[axis])
    return rest
