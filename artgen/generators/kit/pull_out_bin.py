"""Open bins that slide out of refrigerators: crispers and the drawers of freezers."""

from dataclasses import dataclass
from typing import Literal

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.geometry.solid import Solid, slab, union

WALL = 0.0030
"""m; as drawn, its density is scaled to real walls of 2 mm."""
PanelStyle = Literal["lip", "pocket"]


@dataclass(frozen=True, kw_only=True)
class PullOutBin:
    """A bin open at the top.

    Attributes:
        name: of the part.
        low: its lower corner, m; y is that of its front.
        high: its upper corner.
        front: thickness of its front panel.
        style: a lip along the panel's upper edge, or a hand's pocket through it.
        label: its role.
    """

    name: str
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    front: float
    style: PanelStyle
    label: Literal["bin", "drawer"] = "bin"

    def part(self, shell: str, panel: str) -> DraftPart:
        """Bin of `shell` behind a panel."""
        outward = (0.0, -1.0, 0.0)
        grip = Grip(name=f"{self.name}_front", kind="edge", position=self._hold(), outward=outward,
                    pull=outward)  # fmt: skip
        return DraftPart(
            name=self.name, label=self.label, bodies=(self._tub(shell), self._panel(panel)),
            grips=(grip,),
        )  # fmt: skip

    def joint(self, *, travel: float, friction: float) -> Joint:
        """Out to the front."""
        return Joint(
            name=f"{self.name}_slide",
            type="prismatic",
            parent="base",
            child=self.name,
            axis=(0.0, -1.0, 0.0),
            limit=Limit(lower=0.0, upper=travel),
            friction=friction,
            damping=4.0,
            effort=100.0,
            velocity=1.0,
        )

    @property
    def depth(self) -> float:
        """Along y."""
        return self.high[1] - self.low[1]

    def face(self, size: tuple[float, float]) -> PanelPlane:
        """A label in the middle of the panel."""
        x = (self.low[0] + self.high[0] - size[0]) / 2.0
        z = self.low[2] + 0.30 * (self.high[2] - self.low[2]) - size[1] / 2.0
        return PanelPlane(origin=(x, self.low[1], z), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0),
                          size=size)  # fmt: skip

    def _tub(self, surface: str) -> Body:
        (x0, y0, z0), (x1, y1, z1) = self.low, self.high
        y0, e, top = y0 + self.front - 0.0005, WALL, z1 - 0.010
        floor = slab((x0 + 0.004, y0, z0), (x1 - 0.004, y1, z0 + e))
        sides = [slab((x0 + 0.004, y0, z0), (x0 + 0.004 + e, y1, top)),
                 slab((x1 - 0.004 - e, y0, z0), (x1 - 0.004, y1, top)),
                 slab((x0 + 0.004, y1 - e, z0), (x1 - 0.004, y1, top))]  # fmt: skip
        rims = [slab((x0, y0, top - e), (x0 + 0.004 + e, y1, top)),
                slab((x1 - 0.004 - e, y0, top - e), (x1, y1, top))]  # fmt: skip
        return Body(solid=union([floor, *sides, *rims]), surface=surface, density=0.7 * ABS,
                    collision=(floor, *sides))  # fmt: skip

    def _panel(self, surface: str) -> Body:
        (x0, y0, z0), (x1, _, z1) = self.low, self.high
        solid = slab((x0, y0, z0), (x1, y0 + self.front, z1))
        contact: tuple[Solid, ...] = (solid,)
        middle, half = (x0 + x1) / 2.0, min(0.10, 0.30 * (x1 - x0))
        if self.style == "pocket":
            hole = slab(
                (middle - half, y0 - 0.1, z1 - 0.048), (middle + half, y0 + 0.1, z1 - 0.018)
            )
            solid = solid - hole
        else:
            scoop = slab(
                (x0 + 0.012, y0 - 0.01, z1 - 0.030), (x1 - 0.012, y0 + 0.5 * self.front, z1 - 0.007)
            )
            solid = solid - scoop
        return Body(solid=solid, surface=surface, density=0.7 * ABS, edge=0.0012, collision=contact)

    def _hold(self) -> tuple[float, float, float]:
        (x0, y0, _), (x1, _, z1) = self.low, self.high
        return (x0 + x1) / 2.0, y0 + 0.3 * self.front, z1 - 0.012
