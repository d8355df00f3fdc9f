"""Draw latches of boxes and cases: a plate on a bracket hooks over a catch above the seam."""

import math
from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.density import STEEL
from artgen.geometry.solid import cylinder, slab, union

PIN, PLAY, AIR = 0.0018, 0.0006, 0.0010
"""m; radius of the pin, room around it, room between plate and catch."""
CATCH = 0.0055
"""m; how far the catch stands out."""


@dataclass(frozen=True, kw_only=True)
class DrawLatch:
    """On a face at `face` that looks along -y, in the middle of x.

    Attributes:
        name: of the part.
        x: its middle.
        face: y of the face.
        seam: z of the seam between the halves.
        width: of the plate.
        reach: from the seam down to the pin.
        opening: rad that it flips.
    """

    name: str
    x: float
    face: float
    seam: float
    width: float
    reach: float = 0.030
    opening: float = math.radians(120.0)

    @property
    def pivot(self) -> tuple[float, float]:
        """(y, z) of the pin."""
        return self.face - CATCH - AIR - 0.0012, self.seam - self.reach

    def bracket(self, surface: str) -> Body:
        """Two cheeks on the lower half that hold the pin."""
        y, z = self.pivot
        cheeks = [
            slab((self.x + s * 0.36 * self.width - 0.0015, y - 0.0032, z - 0.0036),
                 (self.x + s * 0.36 * self.width + 0.0015, self.face, z + 0.0036))
            for s in (-1, 1)
        ]  # fmt: skip
        foot = slab(
            (self.x - 0.42 * self.width, self.face - 0.0012, z - 0.010),
            (self.x + 0.42 * self.width, self.face, z + 0.010),
        )
        bore = cylinder(PIN + PLAY, 1.0, axis="x", segments=12).at(self.x - 0.5, y, z)
        return Body(solid=union([foot, *cheeks]) - bore, surface=surface, density=STEEL)

    def catch(self, surface: str) -> Body:
        """The nose on the upper half."""
        nose = slab(
            (self.x - 0.3 * self.width, self.face - CATCH, self.seam + 0.004),
            (self.x + 0.3 * self.width, self.face + 0.001, self.seam + 0.011),
        )
        return Body(solid=nose, surface=surface, density=STEEL, collision=(nose,))

    def part(self, surface: str) -> DraftPart:
        """Pin, plate, hook over the catch, and a tab to pull."""
        y, z = self.pivot
        half, top = 0.5 * self.width, self.seam + 0.011 + AIR + 0.0016
        front, back = y - 0.0010, y + 0.0012
        pin = cylinder(PIN, 0.86 * self.width, axis="x", segments=12)
        tongue = slab(
            (self.x - 0.28 * self.width, front, z), (self.x + 0.28 * self.width, back, z + 0.012)
        )
        plate = slab((self.x - half, front, z + 0.007), (self.x + half, back, top))
        hook = slab((self.x - 0.34 * self.width, front, top - 0.0016),
                    (self.x + 0.34 * self.width, self.face - 0.0015, top))  # fmt: skip
        tab = slab((self.x - 0.3 * self.width, front - 0.004, top - 0.0012),
                   (self.x + 0.3 * self.width, front + 0.0004, top + 0.0048))  # fmt: skip
        solid = union([pin.at(self.x - 0.43 * self.width, y, z), tongue, plate, hook, tab])
        grip = Grip(
            name=f"{self.name}_tab", kind="edge", position=(self.x, front - 0.003, top + 0.002),
            outward=(0.0, -1.0, 0.0), pull=(0.0, -1.0, 0.0),
        )  # fmt: skip
        body = Body(
            solid=solid, surface=surface, density=STEEL, edge=0.0, collision=(plate, hook, tab)
        )
        return DraftPart(name=self.name, label="latch", bodies=(body,), grips=(grip,))

    def joint(self, *, parent: str) -> Joint:
        """+q flips the plate outwards and down."""
        y, z = self.pivot
        return Joint(
            name=f"{self.name}_flip", type="revolute", parent=parent, child=self.name,
            axis=(1.0, 0.0, 0.0), origin=(0.0, y, z), limit=Limit(lower=0.0, upper=self.opening),
            friction=0.05, damping=0.003, effort=3.0, velocity=6.0,
        )  # fmt: skip
