"""A hung leaf of a house door: its hinges, handle set and latch put together; hung at its left."""

import math
from dataclasses import dataclass, replace

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Precondition
from artgen.generators.kit.board import Stock
from artgen.generators.kit.door_fittings import LetterPlate
from artgen.generators.kit.door_hinge import DoorHinge
from artgen.generators.kit.door_leaf import pierced
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.lever_handle import LeverSet
from artgen.generators.kit.mirror_image import mirrored_body, mirrored_joint, mirrored_part
from artgen.generators.kit.mortise_latch import MortiseLatch
from artgen.geometry.solid import Solid

FREE = 0.9
"""Share of a handle's turn from which the leaf is free."""


@dataclass(frozen=True, kw_only=True)
class Metals:
    """Stocks of the ironmongery."""

    handle: Stock
    hinge: Stock
    lock: Stock
    dark: Stock


@dataclass(frozen=True, kw_only=True)
class Hung:
    """What a leaf brings along: parts, joints, what goes to the frame and is cut out of it."""

    parts: tuple[DraftPart, ...]
    joints: tuple[Joint, ...]
    preconditions: tuple[Precondition, ...]
    frame: tuple[Body, ...] = ()
    strike: tuple[Body, ...] = ()
    strike_hole: Solid | None = None

    def struck(self, jamb: tuple[Body, ...]) -> tuple[Body, ...]:
        """The jamb's bodies with this leaf's strike let in."""
        if self.strike_hole is None:
            return jamb
        return pierced(jamb, self.strike_hole, clear=self.strike_hole) + self.strike

    def mirrored(self) -> "Hung":
        """Left and right exchanged."""
        return replace(
            self,
            parts=tuple(mirrored_part(part) for part in self.parts),
            joints=tuple(mirrored_joint(joint) for joint in self.joints),
            frame=tuple(mirrored_body(body) for body in self.frame),
            strike=tuple(mirrored_body(body) for body in self.strike),
            strike_hole=self.strike_hole.mirrored("x") if self.strike_hole else None,
        )


@dataclass(frozen=True, kw_only=True)
class SwingLeaf:
    """A leaf that opens towards -y.

    Attributes:
        name: of the part; the names of its handle and latch begin with it.
        rect: of the leaf, m.
        faces: y of its front and rear, m.
        bodies: the leaf itself.
        hinge: one of its hinges.
        heights: z of the hinges' middles.
        opening: largest angle, rad.
        friction: of all hinges together, N m.
    """

    name: str
    rect: Rect
    faces: tuple[float, float]
    bodies: tuple[Body, ...]
    hinge: DoorHinge
    heights: tuple[float, ...]
    opening: float
    friction: float
    metals: Metals

    def joint(self) -> Joint:
        """Its pins; +q swings the free edge towards -y."""
        return Joint(
            name=f"{self.name}_swing",
            type="revolute",
            parent="base",
            child=self.name,
            axis=(0.0, 0.0, -1.0),
            origin=(*self.hinge.axis, 0.0),
            limit=Limit(lower=0.0, upper=self.opening),
            friction=self.friction,
            damping=0.4,
            effort=60.0,
        )

    def hung(
        self,
        *,
        extras: tuple[Body, ...] = (),
        grips: tuple[Grip, ...] = (),
        levers: LeverSet | None = None,
        latch: MortiseLatch | None = None,
        letters: LetterPlate | None = None,
        lever_friction: float = 0.1,
    ) -> Hung:
        """The leaf with what is fixed to it. A handle without a latch is a fixed one."""
        m, bodies = self.metals, self.bodies
        if levers:
            bodies = pierced(bodies, levers.hole())
        if latch:
            bodies = pierced(bodies, latch.pocket(), clear=latch.pocket())
            bodies += latch.forend(m.lock)
        parts: list[DraftPart] = []
        joints = [self.joint()]
        rules = []
        if letters:
            bodies = pierced(bodies, letters.slot(), clear=letters.slot())
            bodies += tuple(letters.fixed(m.handle))
            parts.append(letters.part(m.handle))
            joints.append(letters.joint(self.name))
        if levers:
            handle = levers.part(f"{self.name}_handle", m.handle)
            bodies += levers.fixed(m.handle, m.dark)
            if latch:
                turn, bolt, rule = self._lock(levers, latch, handle, lever_friction)
                parts += [handle, latch.part(bolt.child, m.lock)]
                joints += [turn, bolt]
                rules.append(rule)
            else:
                bodies += handle.bodies
            if not latch:  # It does not turn: the leaf is drawn by it.
                grips += tuple(replace(grip, pull=(0.0, -1.0, 0.0)) for grip in handle.grips)
        bodies += tuple(self.hinge.leaf_side(z, m.hinge) for z in self.heights) + extras
        leaf = DraftPart(name=self.name, label="door", bodies=bodies, grips=grips)
        return Hung(
            parts=(leaf, *parts),
            joints=tuple(joints),
            preconditions=tuple(rules),
            frame=tuple(self.hinge.jamb_side(z, m.hinge) for z in self.heights),
            strike=latch.strike(m.lock) if latch else (),
            strike_hole=latch.strike_hole() if latch else None,
        )

    def _lock(
        self, levers: LeverSet, latch: MortiseLatch, handle: DraftPart, friction: float
    ) -> tuple[Joint, Joint, Precondition]:
        """The handle's turn, the bolt that follows it, and that the leaf waits for them."""
        turn = levers.joint(
            f"{handle.name}_turn", parent=self.name, child=handle.name, friction=friction
        )
        travel = math.radians(levers.turn_deg)
        bolt = latch.joint(
            f"{self.name}_latch_draw",
            parent=self.name,
            child=f"{self.name}_latch",
            handle=turn.name,
            travel=travel,
        )
        rule = Precondition(joint=f"{self.name}_swing", requires=turn.name, at_least=FREE * travel)
        return turn, bolt, rule


def widest_swing(*, hinge: DoorHinge, bare: float, proud: float, wanted: float) -> float:
    """How far a leaf turns before its face meets the architrave, at most `wanted`, rad.

    Args:
        hinge: one of the leaf's hinges.
        bare: from the jamb's face to the architrave, m.
        proud: how far the architrave stands out from the jamb, m.
    """
    x, y = hinge.axis
    ahead, beside = hinge.face - y, bare + x - hinge.jamb
    corner, radius = math.atan2(proud - ahead, beside), math.hypot(proud - ahead, beside)
    # At angle q the architrave's corner lies -radius sin(q + corner) behind the pin; the face lies
    # `ahead` behind it, and 2 mm stay between them.
    return min(wanted, math.pi - corner + math.asin(max(-1.0, min(1.0, (ahead - 0.002) / radius))))
