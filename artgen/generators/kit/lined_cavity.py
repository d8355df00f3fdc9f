"""A lined cooking space: a rounded tunnel closed at the back, and the boxes around it."""

from dataclasses import dataclass

from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright

Point = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class LinedCavity:
    """A space open towards -y.

    Attributes:
        low: its lower corner; y is where its lining begins.
        high: its upper corner.
        corner: radius of its long edges.
        lining: thickness of the lining.
    """

    low: Point
    high: Point
    corner: float
    lining: float

    @property
    def middle(self) -> Point:
        """The center."""
        (x0, y0, z0), (x1, y1, z1) = self.low, self.high
        return (x0 + x1) / 2.0, (y0 + y1) / 2.0, (z0 + z1) / 2.0

    def room(self) -> Solid:
        """What to leave free, through the front."""
        return self._tunnel(0.0, self.low[1] - 0.05)

    def outside(self) -> Solid:
        """The lining with what it encloses."""
        return self._tunnel(self.lining, self.low[1])

    def lined(self) -> Solid:
        """The lining."""
        return self.outside() - self.room()

    def walls(self, low: Point, high: Point) -> tuple[Solid, ...]:
        """Five boxes between the space and a cuboid around it."""
        (x0, _, z0), (x1, y1, z1) = self.low, self.high
        (a0, b0, c0), (a1, b1, c1) = low, high
        return (
            slab((a0, b0, c0), (a1, b1, z0)),
            slab((a0, b0, z1), (a1, b1, c1)),
            slab((a0, b0, z0), (x0, b1, z1)),
            slab((x1, b0, z0), (a1, b1, z1)),
            slab((x0, y1, z0), (x1, b1, z1)),
        )

    def _tunnel(self, grown: float, front: float) -> Solid:
        (x0, _, z0), (x1, y1, z1) = self.low, self.high
        outline = rounded_rectangle(
            z1 - z0 + 2.0 * grown, x1 - x0 + 2.0 * grown, self.corner + grown, segments=4
        )
        solid = upright(prism(outline, y1 + grown - front), "y")
        return solid.at((x0 + x1) / 2.0, front, (z0 + z1) / 2.0)
