"""The glass turntable of a microwave oven on its roller ring, and the coupling that drives it."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Mimic
from artgen.generators.kit.density import ABS, GLASS
from artgen.generators.kit.round_contact import round_boxes
from artgen.geometry.solid import Solid, cylinder, revolve, slab, tube, union

WHEEL = 0.0065
"""m; radius of the ring's rollers."""
CLEAR = 0.0006
"""m; between plate, rollers and floor as drawn."""
PLATE = 0.0045
RIM = 0.011
"""m; how far the rim rises over the plate's underside."""


@dataclass(frozen=True, kw_only=True)
class GlassTurntable:
    """A turntable on the floor of a cavity.

    Attributes:
        center: (x, y) of its axis, m.
        floor: z of the cavity's floor.
        radius: of the plate.
        rollers: on the ring.
    """

    center: tuple[float, float]
    floor: float
    radius: float
    rollers: int = 3

    @property
    def underside(self) -> float:
        """z of the plate's underside above its rollers."""
        return self.floor + 2.0 * (CLEAR + WHEEL)

    def coupling(self) -> Solid:
        """The driven hub in the floor: a boss with three lobes that the plate's pocket fits over.

        It belongs to the base; the plate turns above it.
        """
        boss = cylinder(0.016, self.underside - self.floor - CLEAR + 0.002, segments=20)
        return boss.at(*self.center, self.floor - 0.002)

    def plate_part(self, glass: str) -> DraftPart:
        """The glass plate with raised rim, a ring below it that centers it, and a molded star."""
        r, top = self.radius, RIM
        outline = [
            (0.0, 0.0), (0.86 * r, 0.0), (r - 0.004, top - PLATE), (r, top - 0.003),
            (r - 0.001, top), (r - 0.005, top), (0.86 * r - 0.002, PLATE), (0.0, PLATE),
        ]  # fmt: skip
        plate = revolve(outline, segments=48)
        spokes = [
            slab((0.30 * r, -0.0016, PLATE - 0.0005), (0.78 * r, 0.0016, PLATE + 0.0012)).turned(
                "z", k * math.pi / 3.0
            )
            for k in range(6)
        ]
        x, y = self.center
        solid = union([plate, *spokes]).at(x, y, self.underside)
        touch = round_boxes(r, self.underside, self.underside + PLATE, at=self.center)
        grip = Grip(
            name="turntable_rim",
            kind="rim",
            position=(x, y - r, self.underside + RIM),
            outward=(0.0, 0.0, 1.0),
            pull=(1.0, 0.0, 0.0),
        )
        body = Body(solid=solid, surface=glass, density=GLASS, collision=touch)
        return DraftPart(name="turntable", label="turntable", bodies=(body,), grips=(grip,))

    def ring_part(self, plastic: str) -> DraftPart:
        """Hub, arms and rollers: the ring runs on the floor below the plate."""
        reach, z = 0.66 * self.radius, CLEAR + WHEEL
        hub = tube(0.022, 0.0185, 0.005, segments=24).at(0.0, 0.0, z - 0.0025)
        hoop = tube(reach + 0.003, reach - 0.003, 0.004, segments=40).at(0.0, 0.0, z - 0.002)
        spokes = [self._spoke(reach, z, k) for k in range(self.rollers)]
        solid = union([hub, hoop, *spokes]).at(*self.center, self.floor)
        level = self.floor + z
        flat = round_boxes(reach, level - 0.0025, level + 0.0025, at=self.center)
        body = Body(solid=solid, surface=plastic, density=ABS, collision=flat)
        return DraftPart(name="roller_ring", label="wheel", bodies=(body,))

    def joints(self) -> tuple[Joint, Joint]:
        """The plate turns on its coupling; the ring, rolling below it, turns half as fast."""
        axle = Joint(
            name="turntable_axle", type="continuous", parent="base", child="turntable",
            axis=(0.0, 0.0, 1.0), origin=(*self.center, 0.0), limit=None,
            friction=0.03, damping=0.004, effort=2.0, velocity=2.0,
        )  # fmt: skip
        ring = Joint(
            name="roller_ring_turn", type="continuous", parent="base", child="roller_ring",
            axis=(0.0, 0.0, 1.0), origin=(*self.center, 0.0), limit=None,
            friction=0.0, damping=0.0, effort=2.0, velocity=2.0,
            mimic=Mimic(joint="turntable_axle", multiplier=0.5),
        )  # fmt: skip
        return axle, ring

    def _spoke(self, reach: float, z: float, k: int) -> Solid:
        """An arm from the hub to a roller outside the hoop."""
        arm = slab((0.020, -0.003, z - 0.002), (reach + 0.002, 0.003, z + 0.002))
        wheel = cylinder(WHEEL, 0.006, axis="x", segments=16).at(reach + 0.002, 0.0, z)
        turn = 2.0 * np.pi * k / self.rollers + 0.35
        return union([arm, wheel]).turned("z", turn)
