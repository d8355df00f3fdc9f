"""The drum of a front-loading washer with its paddles, and the rubber bellows before it."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint
from artgen.generators.kit.density import POLYPROPYLENE, RUBBER, STAINLESS
from artgen.geometry.solid import Solid, cylinder, hull, revolve, slab, union

SHEET = 0.003
"""m; drum wall as drawn; its density is scaled to 0.5 mm."""
REAR = 0.006
CONTACT = 5
"""Boxes of a quarter of the drum's wall."""
FIRST = 0.5
"""rad; of the first paddle from upright."""
TUB = 0.010
"""m; between drum and tub."""


@dataclass(frozen=True, kw_only=True)
class WashDrum:
    """A drum that turns about y at (x = 0, z = center).

    Attributes:
        center: z of its axis.
        radius: outside.
        mouth: radius of its opening.
        front: y of its front wall.
        back: y of its rear wall's outer face.
        paddles: ribs that lift the laundry.
        paddle_height: m.
    """

    center: float
    radius: float
    mouth: float
    front: float
    back: float
    paddles: int
    paddle_height: float

    def part(self, *, shell: str, rear: str, paddle: str) -> DraftPart:
        """Perforated shell, rear wall with its star, paddles."""
        weight = STAINLESS * 0.0006 / SHEET
        bodies = (
            Body(solid=self._set(self._shell()), surface=shell, density=weight,
                 collision=self._wall_boxes()),
            Body(solid=self._set(self._rear()), surface=rear, density=0.30 * STAINLESS),
            Body(solid=self._set(self._paddles()), surface=paddle, density=0.35 * POLYPROPYLENE),
        )  # fmt: skip
        grip = self._grip()
        return DraftPart(name="drum", label="drum", bodies=bodies, grips=(grip,))

    def joint(self, *, friction: float) -> Joint:
        """The drum's shaft."""
        return Joint(
            name="drum_axle", type="continuous", parent="base", child="drum",
            axis=(0.0, -1.0, 0.0), origin=(0.0, 0.0, self.center), limit=None, friction=friction,
            damping=0.02, effort=20.0, velocity=10.0,
        )  # fmt: skip

    def tub_room(self) -> Solid:
        """What the machine leaves free for it."""
        room = cylinder(
            self.radius + TUB, self.back - self.front + 2.0 * TUB, axis="y", segments=40
        )
        return self._set(room.at(y=self.front - TUB))

    def _grip(self) -> Grip:
        """On the crest of the first paddle, reached through the mouth."""
        sin, cos = math.sin(FIRST), math.cos(FIRST)
        far = self.radius - SHEET - self.paddle_height
        return Grip(
            name="drum_paddle",
            kind="edge",
            position=(far * sin, (self.front + self.back) / 2.0, self.center + far * cos),
            outward=(-sin, 0.0, -cos),
            pull=(-cos, 0.0, sin),
        )

    def _set(self, solid: Solid) -> Solid:
        return solid.at(z=self.center)

    def _shell(self) -> Solid:
        """The wall with two beads, a conical front and a rolled lip."""
        f, b, r, m, t = self.front, self.back, self.radius, self.mouth, SHEET
        outline = [
            (m + 0.004, f + 0.004), (m, f + 0.008), (m - 0.0015, f + 0.004), (m + 0.001, f),
            (m + 0.006, f - 0.001), (r - 0.012, f + 0.010), (r, f + 0.024), (r, b),
            (r - t, b), (r - t, f + 0.026), (r - 0.014, f + 0.013), (m + 0.008, f + 0.003),
        ]  # fmt: skip
        return revolve(outline, axis="y", segments=44)

    def _rear(self) -> Solid:
        """A disc with a hub and six pressed arms."""
        r, b = self.radius - SHEET, self.back
        disc = cylinder(r, REAR, axis="y", segments=44).at(y=b - REAR)
        hub = cylinder(0.24 * r, 0.012, axis="y", segments=32).at(y=b - REAR - 0.010)
        arm = hull(
            [(u, b - REAR + 0.001, w) for u, w in ((0.2 * r, -0.035), (0.2 * r, 0.035),
                                                   (0.9 * r, -0.020), (0.9 * r, 0.020))]
            + [(u, b - REAR - 0.006, w) for u, w in ((0.2 * r, -0.024), (0.2 * r, 0.024),
                                                     (0.85 * r, -0.010), (0.85 * r, 0.010))]
        )  # fmt: skip
        arms = [arm.turned("y", k * math.pi / 3.0 + 0.3) for k in range(6)]
        return union([disc, hub, *arms])

    def _paddles(self) -> Solid:
        """Hollow ribs along the wall, rounded at their tops and sloped at both ends."""
        r, h = self.radius - SHEET + 0.0005, self.paddle_height
        low, high = self.front + 0.034, self.back - REAR - 0.006
        base = math.sqrt(r * r - 0.034**2)
        points = [(x, y, base + 0.001) for x in (-0.034, 0.034) for y in (low, high)]
        points += [(x, y, r - 0.7 * h) for x in (-0.016, 0.016) for y in (low + 0.02, high - 0.012)]
        points += [(x, y, r - h) for x in (-0.007, 0.007) for y in (low + 0.03, high - 0.02)]
        rib = hull(points)
        return union(
            [rib.turned("y", 2.0 * math.pi * k / self.paddles + FIRST) for k in range(self.paddles)]
        )

    def _wall_boxes(self) -> tuple[Solid, ...]:
        """Upright boxes along the wall, and the rear."""
        f, b = self.front + 0.012, self.back
        middle = self.radius - 0.5 * SHEET
        quarter = []
        steps = np.linspace(0.0, math.pi / 2.0, CONTACT + 1)
        for low, high in pairwise(steps.tolist()):
            x = middle * (math.cos(low) + math.cos(high)) / 2.0
            z = middle * (math.sin(low) + math.sin(high)) / 2.0
            scale = middle / math.hypot(x, z) * (1.0 - 0.004 / middle)
            half = 0.0052
            span = (max(half, 0.26 * middle * (math.cos(low) - math.cos(high))),
                    max(half, 0.26 * middle * (math.sin(high) - math.sin(low))))  # fmt: skip
            if span[0] > half and span[1] > half:
                span = (half, half)
            quarter.append((x * scale, z * scale, *span))
        boxes = [
            slab(
                (sx * x - a, f, self.center + sz * z - c), (sx * x + a, b, self.center + sz * z + c)
            )
            for sx in (-1.0, 1.0)
            for sz in (-1.0, 1.0)
            for x, z, a, c in quarter
        ]
        r = 0.70 * self.radius
        rear = slab((-r, b - REAR, self.center - r), (r, b, self.center + r))
        return (*boxes, rear)


def bellows(
    *, center: float, radius: float, lip: float, front: float, back: float, surface: str
) -> Body:
    """A folded rubber sleeve from the cabinet's opening back to the tub.

    Args:
        center: z of its axis, m.
        radius: of the opening that it lines.
        lip: its smallest radius, where the door's bowl lies in it.
        front: y of its front edge.
        back: y of its rear edge.
    """
    span, deep = back - front, radius - lip
    share = ((0.0, 0.40), (0.03, 0.9), (0.10, 1.0), (0.20, 0.92), (0.28, 0.45), (0.36, 0.12),
             (0.46, 0.06), (0.54, 0.50), (0.62, 0.72), (0.70, 0.55), (0.78, 0.16), (0.86, 0.12),
             (0.93, 0.55), (1.0, 0.75))  # fmt: skip
    inner = [(radius - deep * s, front + span * u) for u, s in share]
    outline = [*inner, (radius + 0.004, back), (radius + 0.004, front)]
    solid = revolve(outline[::-1], axis="y", segments=40).at(z=center)
    return Body(solid=solid, surface=surface, density=RUBBER)
