"""Seat and lid of a toilet on one pin: the lid lies on the seat, the seat on the rim."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Precondition
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.sliced_contact import sliced_wall
from artgen.generators.kit.toilet_pan import Pan, outline
from artgen.geometry.solid import Solid, cylinder, loft, slab, union

LIFT = 0.0045
"""m; that buffers keep between rim and seat, and seat and lid."""
PIN, RADIUS = 0.017, 0.0115
"""Height of the pin over the rim, radius of the hinge's knuckles, m."""
PLATE = -0.032
"""y of the rear edge of the seat's plate, m."""
BEHIND = 0.5
"""Degrees by which the seat stays behind the lid."""
FREE = 0.95
"""Share of the lid's way from which the seat is free."""


@dataclass(frozen=True, kw_only=True)
class SeatSet:
    """Seat and lid for a pan, m.

    Attributes:
        seat: thickness of the seat.
        lid: thickness of the lid at its edge.
        crown: how far the lid's middle rises over its edge.
        over: how far both stand over the pan's edge.
        hinge: half of the distance of the hinges.
        opening: of the lid, rad.
        friction: of a hinge, N m.
        damping: N m s/rad; a soft-closing seat has much.
    """

    pan: Pan
    seat: float
    lid: float
    crown: float
    over: float
    hinge: float
    opening: float
    friction: float
    damping: float

    @property
    def pin(self) -> float:
        """z of the hinge's axis."""
        return self.pan.rim + PIN

    @property
    def behind(self) -> float:
        """y of the rearmost point that the open lid reaches."""
        lean = self.opening - math.pi / 2.0
        top = self.seat + 2.0 * LIFT + self.lid + self.crown - PIN
        return (self.pan.length + self.over) * math.sin(max(lean, 0.0)) + top + 0.002

    def posts(self, metal: Stock) -> list[Body]:
        """The two feet on the pan that hold the pin."""
        bodies = []
        for x in (-self.hinge, self.hinge):
            foot = slab((x - 0.010, -0.0105, self.pan.rim - 0.002), (x + 0.010, 0.0105, self.pin))
            head = cylinder(0.0105, 0.020, axis="x", segments=18).at(x - 0.010, 0.0, self.pin)
            base = cylinder(0.020, 0.0035, segments=24).at(x, 0.0, self.pan.rim - 0.0005)
            bodies.append(metal.piece(union([foot, head, base]), contact=(foot,)))
        return bodies

    def parts(self, plastic: Stock, rubber: Stock) -> tuple[DraftPart, DraftPart]:
        """Seat and lid."""
        seat_z = self.pan.rim + LIFT
        lid_z = seat_z + self.seat + LIFT
        seat, touch = self._ring(seat_z, seat_z + self.seat)
        spots = self._spots()
        high = min(seat_z + self.seat, self.pin + 0.004)
        seat_arms = self._arms(0.0225, start=PLATE - 0.008, z=(seat_z + 0.001, high))
        lid_arms = self._arms(-0.0225, start=-0.028, z=(self.pin - 0.004, lid_z + 0.006))
        lid, cover = self._cover(lid_z)
        length = self.pan.length + self.over
        return (
            DraftPart(
                name="seat",
                label="seat",
                bodies=(
                    plastic.piece(union([seat, *seat_arms]), contact=touch),
                    _buffers(spots, seat_z, rubber),
                ),
                grips=(_front("seat_front", -length, seat_z + self.seat / 2.0),),
            ),
            DraftPart(
                name="lid",
                label="lid",
                bodies=(
                    plastic.piece(union([lid, *lid_arms]), contact=cover),
                    _buffers(spots, lid_z, rubber),
                ),
                grips=(_front("lid_front", -length, lid_z + self.lid / 2.0),),
            ),
        )

    def joints(self) -> tuple[tuple[Joint, Joint], Precondition]:
        """Both lift their front by +q; the seat waits until the lid is up."""
        free = FREE * self.opening
        lid = self._joint("lid", self.opening)
        seat = self._joint("seat", free - math.radians(BEHIND))
        return (lid, seat), Precondition(joint=seat.name, requires=lid.name, at_least=free)

    def _joint(self, child: str, upper: float) -> Joint:
        return Joint(
            name=f"{child}_hinge",
            type="revolute",
            parent="base",
            child=child,
            axis=(-1.0, 0.0, 0.0),
            origin=(0.0, 0.0, self.pin),
            limit=Limit(lower=0.0, upper=upper),
            friction=self.friction,
            damping=self.damping,
            effort=30.0,
        )

    def _plan(self, inset: float, rear: float) -> Floats:
        """The pan's outline, cut off behind."""
        pan = self.pan
        half, front = pan.half + self.over - inset, -pan.length - self.over + inset
        return outline(half, front, rear - inset, 0.86 * pan.half - inset, pan.power)

    def _ring(self, z0: float, z1: float) -> tuple[Solid, tuple[Solid, ...]]:
        """The seat: rounded outside and around its hole."""
        r, mouth = 0.3 * (z1 - z0), self.pan.mouth(0.006)
        steps = (
            (z0, 0.5 * r),
            (z0 + 0.5 * r, 0.0),
            (z1 - r, 0.0),
            (z1 - 0.3 * r, 0.3 * r),
            (z1, r),
        )
        plate = loft([_at(self._plan(inset, PLATE), z) for z, inset in steps])
        middle = mouth.mean(axis=0)
        flare = ((z0 - 0.001, 0.0), (z1 - r, 0.0), (z1 - 0.3 * r, 0.012), (z1 + 0.001, 0.05))
        hole = loft([_at(middle + (1.0 + grown) * (mouth - middle), z) for z, grown in flare])
        front = -self.pan.length - self.over + 0.004
        share = np.linspace(0.0, 1.0, 13) ** 1.2
        cuts = (front + (PLATE - front) * share).tolist()
        contact = sliced_wall([self._plan(0.3 * r, PLATE)], [mouth], z=(z0, z1), cuts=cuts)
        return plate - hole, contact

    def _cover(self, z0: float) -> tuple[Solid, tuple[Solid, ...]]:
        """The lid: a plate with rounded edges that rises to its middle."""
        z1, r, rear = z0 + self.lid, 0.4 * self.lid, -0.017
        steps = [
            (z0, 0.3 * r),
            (z0 + 0.3 * r, 0.0),
            (z1 - r, 0.0),
            (z1 - 0.3 * r, 0.3 * r),
            (z1, r),
        ]
        steps += [(z1 + 0.55 * self.crown, 0.045), (z1 + self.crown, 0.10)]
        solid = loft([_at(self._plan(inset, rear), z) for z, inset in steps])
        front = -self.pan.length - self.over + 0.004
        cuts = (front + (rear - front) * np.linspace(0.0, 1.0, 9) ** 1.4).tolist()
        return solid, sliced_wall([self._plan(r, rear)], [], z=(z0, z1), cuts=cuts)

    def _arms(self, beside: float, *, start: float, z: tuple[float, float]) -> list[Solid]:
        """Knuckles beside the posts, inwards or outwards, with their arms to the plate."""
        arms, (low, high) = [], z
        for side in (-1.0, 1.0):
            x = side * (self.hinge - beside)
            arms.append(cylinder(RADIUS, 0.022, axis="x", segments=18).at(x - 0.011, 0.0, self.pin))
            arms.append(slab((x - 0.011, start, low), (x + 0.011, 0.0, high)))
        return arms

    def _spots(self) -> list[tuple[float, float]]:
        """(x, y) of buffers over the rim: two in front, two behind."""
        pan, mid = self.pan, self.pan.border / 2.0
        back = -0.32 * pan.length
        side = pan.half - mid - 0.010
        front = -pan.length + mid + 0.045
        return [(-side, back), (side, back), (-0.55 * pan.half, front), (0.55 * pan.half, front)]


def _buffers(spots: list[tuple[float, float]], z: float, rubber: Stock) -> Body:
    height = LIFT - 0.0006
    pads = [cylinder(0.008, height + 0.002, segments=12).at(x, y, z - height) for x, y in spots]
    return rubber.piece(union(pads))


def _front(name: str, y: float, z: float) -> Grip:
    return Grip(
        name=name, kind="edge", position=(0.0, y, z), outward=(0.0, -1.0, 0.0), pull=(0.0, 0.0, 1.0)
    )


def _at(plan: Floats, z: float) -> Floats:
    return np.c_[plan, np.full(len(plan), z)]
