"""The linkage of a folding chair whose seat is hinged to the rear legs and slides on the frame.

In the plane (y, z) beside the chair: the frame's line leans back by `lean`; the rear legs cross it
at `cross`; the seat is hinged to their upper ends at `hinge`, and a pin near its rear, `pin`, runs
along the frame's line. Were hinge-cross and hinge-pin equally long, the seat would turn against the
frame exactly as the rear legs do; as they differ little, a fixed ratio keeps the pin within
millimeters of its line, and the slot is made that much wider.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.core.mesh import Floats

Point = tuple[float, float]
"""(y, z), m."""
STEPS = 61


@dataclass(frozen=True, kw_only=True)
class FoldLinkage:
    """Unfolded at rest, with the hinge at y = 0.

    Attributes:
        height: of hinge and pin above the floor, m.
        lean: of the frame's line from upright, rad.
        rake: of the rear legs from upright, rad.
        arm: from the crossing to the seat's hinge, m.
    """

    height: float
    lean: float
    rake: float
    arm: float

    @property
    def spread(self) -> float:
        """Angle between frame and rear legs at rest, rad; folding closes it."""
        return self.lean + self.rake

    @property
    def slant(self) -> float:
        """Angle between the seat and the frame's line at rest, rad."""
        return math.pi / 2.0 - self.lean

    @property
    def ratio(self) -> float:
        """Turns of the seat against the rear legs for one of those against the frame."""
        return 1.0 + self.slant / self.spread

    @property
    def run(self) -> float:
        """From the seat's hinge to its pin, m."""
        return self.arm * math.sin(self.spread) / math.sin(self.slant)

    @property
    def hinge(self) -> Point:
        """Where the seat is hinged to the rear legs."""
        return 0.0, self.height

    @property
    def pin(self) -> Point:
        """Where the seat's pin stands at rest."""
        return self.run, self.height

    @property
    def cross(self) -> Point:
        """Where the rear legs turn on the frame."""
        return self.arm * math.sin(self.rake), self.height - self.arm * math.cos(self.rake)

    def on_frame(self, far: float, before: float = 0.0) -> Point:
        """The point `far` m up the frame's line from the crossing and `before` m in front of it."""
        cos, sin = math.cos(self.lean), math.sin(self.lean)
        y, z = self.cross
        return y + far * sin - before * cos, z + far * cos + before * sin

    def on_legs(self, down: float, behind: float = 0.0) -> Point:
        """The point `down` m below the crossing on the rear legs and `behind` m behind them."""
        cos, sin = math.cos(self.rake), math.sin(self.rake)
        y, z = self.cross
        return y + down * sin + behind * cos, z - down * cos + behind * sin

    @property
    def frame_reach(self) -> float:
        """From the crossing down the frame to the floor, m."""
        return self.cross[1] / math.cos(self.lean)

    @property
    def legs_reach(self) -> float:
        """From the crossing down the rear legs to the floor, m."""
        return self.cross[1] / math.cos(self.rake)

    @cached_property
    def _course(self) -> tuple[Floats, Floats]:
        """How far up the frame and how far before its line the pin is while the chair folds."""
        share = np.linspace(1.0, 0.0, STEPS)
        legs, seat = share * self.spread, share * self.slant
        far = self.arm * np.cos(legs) + self.run * np.cos(seat)
        return far, self.arm * np.sin(legs) - self.run * np.sin(seat)

    @property
    def slide(self) -> tuple[float, float]:
        """Nearest and farthest that the pin comes to the crossing, m."""
        far, _ = self._course
        return float(far.min()), float(far.max())

    @property
    def stray(self) -> tuple[float, float]:
        """How far the pin strays behind (negative) and before the frame's line, m."""
        _, before = self._course
        return float(before.min()), float(before.max())
