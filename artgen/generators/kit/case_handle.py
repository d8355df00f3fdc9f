"""Handles on top of boxes and cases: a bent rod, fixed or folding between two saddles."""

import math
from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.density import POLYPROPYLENE, STEEL
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Solid, box, cylinder, slab, wire

RISE = 0.042
"""m; from the axis to the middle of the grip: room for a hand."""
LEG = 0.012
"""m; from the grip's end to the middle of a leg."""
PLAY = 0.0007
AIR = 0.0012


@dataclass(frozen=True, kw_only=True)
class CaseHandle:
    """Above a flat top at z = `top`, its grip along x.

    Attributes:
        top: z of what it stands on.
        length: of the grip.
        rod: radius of the rod; the sleeve around it is 1.9 times as thick.
    """

    top: float
    length: float
    rod: float

    @property
    def axis_z(self) -> float:
        """z of the axis: the sleeve lies `AIR` above the top."""
        return self.top + 1.9 * self.rod + AIR

    @property
    def _saddle(self) -> float:
        """x of the saddles' inner faces, beyond the bends of the rod."""
        return 0.5 * self.length + LEG + self.rod + 0.006

    def _path(self) -> Floats:
        """Upright, from saddle to saddle, around zero."""
        half, end = 0.5 * self.length + LEG, self._saddle + 0.010
        corners = [(-end, 0, 0), (-half, 0, 0), (-half, 0, RISE), (half, 0, RISE), (half, 0, 0),
                   (end, 0, 0)]  # fmt: skip
        return bent(corners, 0.0045)

    def _solids(self, *, upright: bool) -> tuple[Solid, Solid, Solid]:
        """(rod, sleeve, contact box), lying towards -y unless upright."""
        rod = wire(self._path(), self.rod, sides=8)
        half, thick = 0.5 * self.length, 1.9 * self.rod
        sleeve = cylinder(thick, self.length, axis="x", segments=18).at(-half, 0.0, RISE)
        touch = slab(
            (-half, -0.7 * thick, RISE - 0.7 * thick), (half, 0.7 * thick, RISE + 0.7 * thick)
        )
        made = [rod, sleeve, touch]
        if not upright:
            made = [solid.turned("x", math.pi / 2.0) for solid in made]
        rod, sleeve, touch = (solid.at(z=self.axis_z) for solid in made)
        return rod, sleeve, touch

    def bodies(self, metal: str, sleeve: str, *, upright: bool) -> tuple[Body, ...]:
        """Rod and sleeve."""
        rod, soft, touch = self._solids(upright=upright)
        return (
            Body(solid=rod, surface=metal, density=STEEL),
            Body(solid=soft, surface=sleeve, density=POLYPROPYLENE, edge=0.001, collision=(touch,)),
        )

    def saddles(self, metal: str, *, fixed: bool) -> tuple[Body, ...]:
        """Two blocks on the top; bored with some play unless the handle is fixed in them."""
        x, made = self._saddle + 0.0055, []
        bore = cylinder(self.rod + PLAY, 1.0, axis="x", segments=12).at(-0.5, 0.0, self.axis_z)
        for place in (-x, x):
            size = (0.011, 0.022, self.axis_z - self.top + self.rod + 0.003)
            block = box(size, at=(place, 0.0, self.top))
            solid = block if fixed else block - bore
            made.append(Body(solid=solid, surface=metal, density=STEEL, edge=0.0015))
        return tuple(made)

    def grip(self, *, upright: bool) -> Grip:
        """The sleeve."""
        place = (0.0, 0.0, self.axis_z + RISE) if upright else (0.0, -RISE, self.axis_z)
        return Grip(
            name="carrying_grip", kind="handle", position=place, outward=(0.0, 0.0, 1.0),
            pull=(0.0, 0.0, 1.0),
        )  # fmt: skip

    def part(self, metal: str, sleeve: str) -> DraftPart:
        """The folding handle, lying down."""
        bodies = self.bodies(metal, sleeve, upright=False)
        return DraftPart(
            name="handle", label="handle", bodies=bodies, grips=(self.grip(upright=False),)
        )

    def joint(self, *, parent: str) -> Joint:
        """+q raises it."""
        return Joint(
            name="handle_fold", type="revolute", parent=parent, child="handle",
            axis=(-1.0, 0.0, 0.0), origin=(0.0, 0.0, self.axis_z),
            limit=Limit(lower=0.0, upper=math.pi / 2.0), friction=0.03, damping=0.003, effort=4.0,
            velocity=6.0,
        )  # fmt: skip
