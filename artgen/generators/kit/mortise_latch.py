"""A mortise lock: forend in the leaf's edge, bolt that the handle draws, strike in the jamb."""

from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Joint, Limit, Mimic
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright

PLAY = 0.0008
"""m; around the bolt in its holes."""
FOREND = 0.003
"""m; thickness of the forend, flush in the edge."""


@dataclass(frozen=True, kw_only=True)
class MortiseLatch:
    """A latch in the right edge of a leaf.

    Attributes:
        edge: x of the leaf's right edge, m.
        gap: between the edge and the jamb, m.
        middle: y of the leaf's middle, m.
        z: of the handle's spindle, m.
        throw: how far the bolt stands out of the edge, m.
        height: of the bolt, m.
        deadbolt: its end shows in the forend below.
    """

    edge: float
    gap: float
    middle: float
    z: float
    throw: float
    height: float
    deadbolt: bool

    @property
    def stroke(self) -> float:
        """How far the handle draws it: flush after nine tenths."""
        return self.throw / 0.88

    def pocket(self) -> Solid:
        """What the leaf must leave free."""
        return self._room(self.edge - 0.022 - self.stroke - 0.002, self.edge + 0.001)

    def strike_hole(self) -> Solid:
        """What the jamb must leave free."""
        return self._room(self.edge + self.gap - 0.001, self.edge + self.throw + 0.003)

    def forend(self, metal: Stock) -> tuple[Body, ...]:
        """The plate in the leaf's edge, and the end of the deadbolt."""
        plate = _upright_plate(0.020, 0.235, FOREND).at(
            self.edge - FOREND, self.middle, self.z - 0.04
        )
        bodies = [metal.piece(plate - self.pocket())]
        if self.deadbolt:
            z = self.z - 0.075
            bolt = slab(
                (self.edge - 0.002, self.middle - 0.006, z - 0.016),
                (self.edge + 0.0006, self.middle + 0.006, z + 0.016),
            )
            bodies.append(metal.piece(bolt))
        return tuple(bodies)

    def strike(self, metal: Stock) -> tuple[Body, ...]:
        """The plate in the jamb, with the holes of latch and deadbolt."""
        jamb = self.edge + self.gap
        plate = _upright_plate(0.024, 0.17, 0.002).at(jamb, self.middle, self.z - 0.04)
        z = self.z - 0.075
        dead = slab(
            (jamb - 1.0, self.middle - 0.007, z - 0.018),
            (jamb + 1.0, self.middle + 0.007, z + 0.018),
        )
        plate = plate - self.strike_hole()
        return (metal.piece(plate - dead if self.deadbolt else plate),)

    def part(self, name: str, metal: Stock) -> DraftPart:
        """The bolt: a tongue that slopes towards the jamb it closes on; what stands out touches."""
        tail, tip = self.edge - 0.022, self.edge + self.throw
        near, far = self.middle - 0.006, self.middle + 0.006
        plan = [
            (tail, near),
            (tip, near),
            (tip, near + 0.003),
            (self.edge + 0.002, far),
            (tail, far),
        ]
        bolt = prism(plan, self.height).at(0.0, 0.0, self.z - self.height / 2.0)
        tongue = prism(
            [(self.edge + 0.0004, near), *plan[1:4], (self.edge + 0.0004, far)], self.height
        )
        contact = tongue.at(0.0, 0.0, self.z - self.height / 2.0)
        body = metal.piece(bolt, contact=(contact,))
        return DraftPart(name=name, label="latch", bodies=(body,))

    def joint(self, name: str, *, parent: str, child: str, handle: str, travel: float) -> Joint:
        """Drawn into the leaf in proportion to the turn of the joint `handle`, `travel` rad."""
        return Joint(
            name=name,
            type="prismatic",
            parent=parent,
            child=child,
            axis=(-1.0, 0.0, 0.0),
            limit=Limit(lower=0.0, upper=self.stroke),
            friction=0.5,
            damping=0.5,
            effort=30.0,
            velocity=0.5,
            mimic=Mimic(joint=handle, multiplier=self.stroke / travel),
        )

    def _room(self, x0: float, x1: float) -> Solid:
        half = self.height / 2.0 + PLAY
        return slab(
            (x0, self.middle - 0.006 - PLAY, self.z - half),
            (x1, self.middle + 0.006 + PLAY, self.z + half),
        )


def _upright_plate(width: float, height: float, thickness: float) -> Solid:
    """A plate with rounded ends on the plane x = 0, towards +x, its middle at zero."""
    return upright(prism(rounded_rectangle(width, height, 0.0099, segments=4), thickness), "x")
