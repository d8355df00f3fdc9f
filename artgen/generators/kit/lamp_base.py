"""Feet of desk lamps: weighted plates, round, square or long, with a turret that swivels."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.lamp_arm import fork
from artgen.generators.kit.lofted_shell import crown_steps
from artgen.generators.kit.round_contact import round_boxes
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, loft, prism, slab, union

PlateStyle = Literal["round", "square", "long"]
BOSS = 0.006
"""m; height of the ring that the turret stands over."""
GAP = 0.0012
PIVOT = 0.040
"""m; from the turret's foot to the lower arm's pivot."""


@dataclass(frozen=True, kw_only=True)
class LampBase:
    """A plate on a rubber pad, with the turret's axis at (0, post).

    Attributes:
        style: its outline.
        size: half its width, m.
        height: m.
        crown: rounding of its upper edge, m.
        post: y of the turret's axis, m.
    """

    style: PlateStyle
    size: float
    height: float
    crown: float
    post: float

    @property
    def half_depth(self) -> float:
        """Half its extent along y, m."""
        return {"round": 1.0, "square": 1.0, "long": 0.68}[self.style] * self.size

    @property
    def turret_low(self) -> float:
        """z of the turret's foot, m."""
        return self.height + GAP

    @property
    def pivot(self) -> tuple[float, float]:
        """(y, z) of the lower arm's pivot, m."""
        return self.post, self.turret_low + PIVOT

    def face(self) -> PanelPlane:
        """The front part of the plate's top, for a switch; its corner is the middle of it."""
        return PanelPlane(
            origin=(0.0, -0.62 * self.half_depth, self.height),
            right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=(0.02, 0.02),
        )  # fmt: skip

    def bodies(self, plate: Stock, rubber: Stock, cuts: list[Solid]) -> list[Body]:
        """Plate and pad; `cuts` are what a switch needs free."""
        outline = self._outline(0.0)
        rings = [
            np.c_[self._outline(inset), np.full(len(outline), z)]
            for inset, z in crown_steps(0.002, self.height, self.crown, steps=4)
        ]
        solid = loft(rings) - cylinder(0.0068, self.height, segments=20).at(0.0, self.post, 0.004)
        solid = solid - union(cuts) if cuts else solid
        foot = prism(self._outline(0.006), 0.0022)
        return [plate.piece(solid, contact=self._contact()), rubber.piece(foot)]

    def _outline(self, inset: float) -> Floats:
        if self.style == "round":
            return circle(self.size - inset, segments=48)
        corner = (0.25 if self.style == "square" else 0.60) * self.half_depth
        return rounded_rectangle(2 * (self.size - inset), 2 * (self.half_depth - inset),
                                 max(corner - inset, 0.002), segments=6)  # fmt: skip

    def _contact(self) -> tuple[Solid, ...]:
        """Around the turret's pin and under a switch's travel: a little lower than the top."""
        high = self.height - 0.006
        if self.style == "round":
            return round_boxes(self.size, 0.0, high)
        inset = 0.18 * self.half_depth
        x, y = self.size, self.half_depth
        return (
            slab((-x + inset, -y, 0.0), (x - inset, y, high)),
            slab((-x, -y + inset, 0.0), (x, y - inset, high)),
        )

    def turret(self, stock: Stock, metal: Stock) -> list[Body]:
        """A disc with its pin, and the fork for the lower arm."""
        y, low = self.post, self.turret_low
        pin = cylinder(0.0060, self.height - 0.004, segments=16).at(0.0, y, 0.006)
        disc = cylinder(0.0190, 0.009, segments=28).at(0.0, y, low)
        neck = cylinder(0.0120, PIVOT - 0.009 - 0.016, segments=20).at(0.0, y, low + 0.008)
        cheeks = fork(-1.0).at(0.0, y, low + PIVOT)
        key = slab((-0.0025, y - 0.0205, low + 0.002), (0.0025, y - 0.018, low + 0.007))
        touch = (
            *round_boxes(0.0190, low, low + 0.009, at=(0.0, y)),
            slab((-0.0078, y - 0.0090, low + 0.009), (0.0078, y + 0.0090, low + PIVOT - 0.017)),
        )
        return [
            stock.piece(union([disc, neck, cheeks, key]), contact=touch),
            metal.piece(pin),
        ]
