"""Lids of cooking pots: domed sheet, glass in a rim, cast ones; lifted off or hinged."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import GLASS, STAINLESS
from artgen.generators.kit.pot_shell import PotShell
from artgen.generators.kit.round_contact import round_boxes, square_box
from artgen.generators.kit.swept import bent_line, swept, swept_boxes
from artgen.generators.kit.turned_knob import turned_knob
from artgen.geometry.solid import Solid, cylinder, revolve, slab, tube, union

AFLOAT, FLANGE, PLAY = 0.0008, 0.0030, 0.0012
"""m; between lid and rim, thickness of the lid's edge, between its collar and the wall."""
EAR = 0.0045
"""m; radius of the hinge's ears."""
SEGMENTS = 48


@dataclass(frozen=True, kw_only=True)
class PotLid:
    """What lies on a pot.

    Attributes:
        shell: the pot.
        kind: `sheet`, `glass` or `cast`.
        hinged: turns up about an axis behind the rim; else it is lifted off.
        crown: rise of its middle, m.
        collar: how deep it reaches into the pot, m.
        knob: radius and height, m.
        arched: a strap instead of a knob.
        thick: of the dome, m.
        density: of sheet and cast lids as drawn, kg/m3.
        vent: a hole with a grommet.
        opening: of a hinged lid, rad.
    """

    shell: PotShell
    kind: str
    hinged: bool
    crown: float
    collar: float
    knob: tuple[float, float]
    arched: bool
    thick: float
    density: float
    vent: bool
    opening: float

    @property
    def low(self) -> float:
        """z of the edge's underside."""
        return self.shell.height + AFLOAT

    @property
    def reach(self) -> float:
        """Radius of the edge."""
        return self.shell.edge - 0.0004

    @property
    def axis(self) -> tuple[float, float]:
        """(y, z) of the hinge."""
        return self.shell.edge + 0.0055, self.low + FLANGE

    def _dome(self, radius: float, base: float, rise: float) -> list[tuple[float, float]]:
        """Points (radius, z) from the edge to the middle."""
        angles = np.linspace(0.0, math.pi / 2.0, 10)
        power = 1.0 if self.kind == "cast" else 0.8
        points = [(radius * math.cos(a), base + rise * math.sin(a) ** power) for a in angles]
        return [*points[:-1], (0.0, points[-1][1])]

    @property
    def peak(self) -> float:
        """z of the middle of the dome's upper side."""
        return self.low + FLANGE + self.crown

    def bodies(self, skin: str, rim: str) -> list[Body]:
        """Dome, edge with its collar, and what else it is made of."""
        r, low, top = self.reach, self.low, self.low + FLANGE
        inner = self.shell.mouth - PLAY
        contact = (
            *round_boxes(r, low, top), *round_boxes(0.72 * r, top, top + 0.55 * self.crown)[2:],
            square_box(0.86 * inner, low - self.collar, low),
        )  # fmt: skip
        above = [(r - 0.002, top), *self._dome(0.97 * r, top, self.crown)]
        below = self._dome(0.97 * r - 1.2 * self.thick, top - self.thick, self.crown)[::-1]
        dome = revolve([*below, (r - 0.004, top - 0.0006), *above], segments=SEGMENTS)
        edge = revolve(
            [(inner - 0.0022, low - self.collar), (inner, low - self.collar), (inner, low),
             (r - 0.0008, low), (r, low + 0.0008), (r, top - 0.0008), (r - 0.0010, top),
             (min(r - 0.0120, inner - 0.0040), top), (inner - 0.0022, top - 0.0006)],
            segments=SEGMENTS,
        )  # fmt: skip
        hole = cylinder(0.0032, 0.2, segments=16).at(-0.55 * r, 0.0, low)
        if self.vent:
            dome = dome - hole
        dense = GLASS if self.kind == "glass" else self.density
        bodies = [
            Body(solid=dome, surface=skin, density=dense, collision=contact),
            Body(solid=edge, surface=rim, density=0.5 * STAINLESS if rim != skin else dense),
        ]
        if self.vent:
            z = top + self.crown * (1.0 - 0.55**2) ** 0.4
            grommet = tube(0.0060, 0.0024, 0.006, segments=20).at(-0.55 * r, 0.0, z - 0.0045)
            bodies.append(Body(solid=grommet, surface="metal", density=STAINLESS))
        return bodies

    def grasp(self, stock: Stock) -> tuple[Body, Grip]:
        """Knob or strap on top."""
        radius, height = self.knob
        z = self.peak - 0.0012
        if self.arched:
            half = 2.1 * radius
            foot, top = z - 0.002, z + height
            corners = [(-half, foot), (-0.85 * half, top), (0.85 * half, top), (half, foot)]
            path = bent_line(corners, 0.6 * height)
            wide, thick = 1.0 * radius, 0.42 * radius
            solid = swept(path, wide, thick).turned("z", math.pi / 2.0)
            contact = tuple(
                slab(*b.turned("z", math.pi / 2.0).bounds) for b in swept_boxes(path, wide, thick)
            )
        else:
            solid, contact = turned_knob(radius, height)
            solid, contact = solid.at(z=z), tuple(piece.at(z=z) for piece in contact)
        pull = (0.0, 0.0, 1.0)
        grip = Grip(name="lid_grip", kind="handle" if self.arched else "knob",
                    position=(0.0, 0.0, z + 0.8 * height), outward=pull, pull=pull)  # fmt: skip
        return stock.piece(solid, contact=contact), grip

    def part(self, skin: str, rim: str, stock: Stock) -> DraftPart:
        """The whole lid."""
        handle, grip = self.grasp(stock)
        bodies = [*self.bodies(skin, rim), handle]
        if self.hinged:
            bodies.append(self._knuckle())
        return DraftPart(name="lid", label="lid", bodies=tuple(bodies), grips=(grip,))

    def _knuckle(self) -> Body:
        y, z = self.axis
        barrel = cylinder(EAR - 0.0012, 0.024, axis="x", segments=18).at(-0.012, y, z)
        tongue = slab((-0.012, self.reach - 0.006, z - FLANGE), (0.012, y, z))
        core = slab((-0.012, self.reach - 0.004, z - FLANGE), (0.012, y + 0.002, z))
        return Body(solid=barrel | tongue, surface="metal", density=STAINLESS, collision=(core,))

    def ears(self) -> Body:
        """What holds a hinged lid, on the pot's wall."""
        y, z = self.axis
        cheeks: list[Solid] = []
        for s in (-1.0, 1.0):
            a, b = sorted((s * 0.0130, s * 0.0165))
            cheeks.append(cylinder(EAR, b - a, axis="x", segments=20).at(a, y, z))
            cheeks.append(slab((a, y - EAR, z - 0.030), (b, y + EAR, z)))
        root = slab((-0.0165, self.shell.radius - 0.004, z - 0.034), (0.0165, y + EAR, z - 0.013))
        solid = union([*cheeks, root]) - self.shell.outside()
        touch = slab((-0.0165, self.shell.radius + 0.001, z - 0.034), (0.0165, y + EAR, z - 0.013))
        return Body(
            solid=solid, surface="metal", density=STAINLESS, edge=0.0006, collision=(touch,)
        )

    def joint(self) -> Joint:
        """Up about the axis behind the rim, or straight up."""
        if not self.hinged:
            tall = self.peak + self.knob[1] - self.low + self.collar
            return Joint(
                name="lid_lift", type="prismatic", parent="base", child="lid",
                axis=(0.0, 0.0, 1.0), limit=Limit(lower=0.0, upper=0.92 * tall), friction=0.8,
                damping=3.0, effort=60.0, velocity=0.6,
            )  # fmt: skip
        return Joint(
            name="lid_hinge", type="revolute", parent="base", child="lid", axis=(-1.0, 0.0, 0.0),
            origin=(0.0, *self.axis), limit=Limit(lower=0.0, upper=self.opening), friction=0.15,
            damping=0.05, effort=8.0,
        )  # fmt: skip
