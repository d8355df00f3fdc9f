"""Gas lifts of swivel chairs: a tube in the foot, a rod that rises from it, a cover that hangs."""

from dataclasses import dataclass, replace
from typing import Literal

from artgen.articulation.types import Body, DraftPart, Joint, Limit, Spring
from artgen.core.conventions import GRAVITY
from artgen.generators.kit.board import Stock
from artgen.geometry.solid import Solid, cylinder, revolve, slab, tube, union

Cover = Literal["bellows", "steps", "bare"]
TUBE = 0.025
"""m; outer radius of the pressure tube (DIN 4550: 50 mm)."""
BORE = 0.0158
ROD = 0.0140
"""m; radius of the rod (28 mm)."""
TAPER = 0.0132
"""m; radius of the rod's head in the seat."""
OVERLAP = 0.025
"""m; how much of the tube the cover still hides when the seat is highest."""


@dataclass(frozen=True, kw_only=True)
class GasLift:
    """The column around the z axis.

    Attributes:
        low: lower end of the tube, m.
        hub: height of the top of the foot's hub, m.
        travel: how far the seat rises, m.
        cover: what hides the tube.
        head: how far the rod stands into the seat's socket, m.
    """

    low: float
    hub: float
    travel: float
    cover: Cover
    head: float = 0.030

    @property
    def tube_top(self) -> float:
        """Upper end of the tube, m."""
        return self.hub + self.travel + OVERLAP

    @property
    def shoulder(self) -> float:
        """Height of the cover's top at rest, where the seat begins, m."""
        return self.tube_top + 0.014

    def tube_body(self, stock: Stock) -> Body:
        """The tube, part of the foot."""
        solid = tube(TUBE, BORE, self.tube_top - self.low, segments=20).at(z=self.low)
        ring = slab((0.0112, -0.0112, self.low), (0.0235, 0.0112, self.tube_top))
        side = slab((-0.0112, 0.0112, self.low), (0.0112, 0.0235, self.tube_top))
        contact = (ring, ring.mirrored("x"), side, side.mirrored("y"))
        return stock.piece(solid, contact=contact)

    def part(self, rod: Stock, cover: Stock) -> DraftPart:
        """Rod with its head, and the cover."""
        foot = self.low + 0.012
        straight = cylinder(ROD, self.shoulder - foot, segments=20).at(z=foot)
        head = cylinder(TAPER, self.head, segments=20).at(z=self.shoulder)
        half = 0.0096
        core = slab((-half, -half, foot), (half, half, self.shoulder + self.head))
        bodies = [rod.piece(union([straight, head]), contact=(core,))]
        hood = self._hood()
        pieces = self._hood_contact() if self.cover != "bare" else ()
        bodies.insert(0, replace(cover, edge=0.0).piece(hood, contact=pieces))
        return DraftPart(name="column", label="column", bodies=tuple(bodies))

    def joint(self, carried: float, *, friction: float) -> Joint:
        """Up by +q; the gas carries the seat, the valve's friction holds it where it is."""
        lift = carried * GRAVITY
        return Joint(
            name="column_lift",
            type="prismatic",
            parent="base",
            child="column",
            axis=(0.0, 0.0, 1.0),
            limit=Limit(lower=0.0, upper=self.travel),
            friction=friction,
            damping=400.0,
            effort=3.0 * friction,
            velocity=0.4,
            spring=Spring(stiffness=0.15 * lift / self.travel, reference=7.0 * self.travel),
        )

    def _hood(self) -> Solid:
        """A collar with its clip, and below it bellows or telescopic steps around the tube."""
        top = self.shoulder
        ring = tube(0.0300, ROD - 0.001, 0.010, segments=20).at(z=top - 0.010)
        clip = slab((-0.008, -0.0335, top - 0.009), (0.008, -0.028, top - 0.001))
        collar = union([ring, clip])
        if self.cover == "bare":
            return collar
        inner, low, high = TUBE + 0.0015, self.hub + 0.003, top - 0.009
        count = 8 if self.cover == "bellows" else 3
        rise = (high - low) / count
        outline: list[tuple[float, float]] = [(inner, high), (inner, low)]
        for k in range(count):
            z = low + k * rise
            if self.cover == "bellows":
                outline += [(0.0300, z + 0.05 * rise), (0.0345, z + 0.50 * rise)]
            else:
                wide = 0.0370 - 0.003 * k
                outline += [(wide, z), (wide, z + rise - 0.001)]
        outline.append((0.0295, high))
        return union([collar, revolve(outline, segments=20)])

    def _hood_contact(self) -> tuple[Solid, ...]:
        low, high = self.hub + 0.003, self.shoulder - 0.001
        wall = slab((0.0245, -0.016, low), (0.0295, 0.016, high))
        side = slab((-0.016, 0.0245, low), (0.016, 0.0295, high))
        return (wall, wall.mirrored("x"), side, side.mirrored("y"))
