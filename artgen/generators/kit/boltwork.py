"""Locking bolts behind a door's plate: a hollow cover, round bolts on a carrier, their way."""

from dataclasses import dataclass

from artgen.geometry.solid import Solid, cylinder, slab, union

SKIN = 0.0015
"""m; sheet of the cover."""
PLAY = 0.0008
"""m; between a bolt and its hole."""
REACH = 0.052
"""m; length of a bolt up to the carrier."""
CARRIER = 0.014
"""m; width of the carrier's bar."""


@dataclass(frozen=True, kw_only=True)
class Boltwork:
    """Drawn for bolts that leave towards +x; behind the plate is +y.

    Attributes:
        near: x of the cover's end at the hinge.
        far: x of the cover's end at the bolts.
        low, high: z of the cover.
        front, back: y of the cover; it lies on the plate at `front`.
        radius: of the bolts.
        heights: z of each bolt.
        thrown: x of the tips when locked.
    """

    near: float
    far: float
    low: float
    high: float
    front: float
    back: float
    radius: float
    heights: tuple[float, ...]
    thrown: float

    @property
    def travel(self) -> float:
        """How far the bolts are drawn back: their tips end 1 mm inside the cover, m."""
        return self.thrown - (self.far - SKIN - 0.001)

    @property
    def level(self) -> float:
        """y of the bolts' axes."""
        return self.front + 0.003 + self.radius

    def cover(self) -> Solid:
        """The sheet box with a hole for every bolt."""
        outer = slab((self.near, self.front, self.low), (self.far, self.back, self.high))
        inner = slab(
            (self.near + SKIN, self.front - 0.01, self.low + SKIN),
            (self.far - SKIN, self.back - SKIN, self.high - SKIN),
        )
        holes = [
            cylinder(self.radius + PLAY, 0.03, axis="x", segments=16).at(
                self.far - 0.02, self.level, z
            )
            for z in self.heights
        ]
        return (outer - inner) - union(holes)

    def cover_collision(self) -> tuple[Solid, ...]:
        """Four sheets; that with the holes is left open."""
        a, b, c, d = self.near, self.far, self.low, self.high
        f, k = self.front, self.back
        return (
            slab((a, k - SKIN, c), (b, k, d)),
            slab((a, f, c), (a + SKIN, k - SKIN, d)),
            slab((a + SKIN, f, c), (b, k - SKIN, c + SKIN)),
            slab((a + SKIN, f, d - SKIN), (b, k - SKIN, d)),
        )

    def bolts(self) -> tuple[Solid, tuple[Solid, ...]]:
        """(bolts on their carrier when thrown, its collision boxes)."""
        root, r = self.thrown - REACH, self.radius
        low, high = min(self.heights) - 1.4 * r, max(self.heights) + 1.4 * r
        bar = slab((root - CARRIER, self.level - 0.5 * r, low), (root, self.level + 0.5 * r, high))
        rods = [
            cylinder(r, REACH + 0.004, axis="x", segments=16).at(root - 0.004, self.level, z)
            for z in self.heights
        ]
        half = 0.7 * r
        touch = [
            slab((root, self.level - half, z - half), (self.thrown, self.level + half, z + half))
            for z in self.heights
        ]
        return union([bar, *rods]), (bar, *touch)
