"""Leaves that shut refrigerators: rectangular doors on pivots, drawer fronts, bellows gaskets.

Everything is drawn as a door hinged on its left: x from the hinge's edge to the free edge, y = 0
the cabinet's front, the leaf before it (y < 0), z upwards. `placed` puts it where it belongs.
"""

import dataclasses
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, Grip, Joint, Latch, Limit, Vector
from artgen.core.mesh import Floats
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import RUBBER, STEEL
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union, upright

Hinge = Literal["left", "right"]
SEAL_PLAY = 0.0010
"""m; what is drawn between the pressed gasket and the cabinet."""
SEAL_WIDTH = 0.014
PIN = 0.0040
"""m; radius of a pivot."""
PLATE = 0.0030
"""m; thickness of a hinge plate."""
PLATE_PLAY = 0.0012
"""m; between a hinge plate and the leaf."""


@dataclass(frozen=True, kw_only=True)
class ColdLeaf:
    """A closed leaf.

    Attributes:
        name: of the part.
        hinge: side of the pivots; a drawer's front is drawn as hinged on its left.
        corner: where the drawing's zero lies in the object frame, m.
        width: from the hinge's edge to the free edge.
        length: upright.
        thickness: from front to back.
        gap: between the back and the cabinet; the gasket fills it.
        inset: of the pivot's axis from the hinge's edge.
        setback: of the pivot's axis from the back.
        seal_inset: of the gasket from the leaf's edges.
    """

    name: str
    hinge: Hinge
    corner: Vector
    width: float
    length: float
    thickness: float
    gap: float
    inset: float
    setback: float
    seal_inset: float

    @property
    def front(self) -> float:
        """y of the outer face."""
        return -self.gap - self.thickness

    @property
    def back(self) -> float:
        """y of the inner face."""
        return -self.gap

    @property
    def pin(self) -> tuple[float, float]:
        """(x, y) of the pivots' axis."""
        return self.inset, self.back - self.setback

    @property
    def matrix(self) -> Floats:
        """(4, 4) from the drawing to the object frame."""
        matrix = np.diag([1.0 if self.hinge == "left" else -1.0, 1.0, 1.0, 1.0])
        matrix[:3, 3] = self.corner
        return matrix

    def placed(self, solid: Solid) -> Solid:
        """A drawn solid in the object frame."""
        return solid.transformed(self.matrix)

    def carried(self, body: Body) -> Body:
        """A drawn body without decal in the object frame."""
        return dataclasses.replace(
            body,
            solid=self.placed(body.solid),
            collision=tuple(self.placed(piece) for piece in body.collision),
        )

    def point(self, x: float, y: float, z: float) -> Vector:
        """A drawn point in the object frame."""
        u, v, w = (float(c) for c in self.matrix[:3, :3] @ (x, y, z) + self.corner)
        return u, v, w

    def slab(self, *, front: float, back: float, inset: float = 0.0) -> Solid:
        """The whole leaf between two depths (y), smaller by `inset` all around."""
        return slab((inset, front, inset), (self.width - inset, back, self.length - inset))

    def face(self, low: tuple[float, float], size: tuple[float, float]) -> PanelPlane:
        """A panel on the outer face whose lower edge is at z = low[1].

        Its side that lies nearer to the drawing's zero is at x = low[0].
        """
        left = low[0] if self.hinge == "left" else low[0] + size[0]
        return PanelPlane(
            origin=self.point(left, self.front, low[1]),
            right=(1.0, 0.0, 0.0),
            up=(0.0, 0.0, 1.0),
            size=size,
        )

    def gasket(self, surface: str) -> Body:
        """A magnetic bellows all around: its fold, and the magnet's strip before it."""
        deep = -self.back - SEAL_PLAY
        rings = ((0.0, 0.55, 0.0032), (0.55, 1.0, 0.0))
        solids = []
        for start, end, narrowed in rings:
            outer = self._outline(self.seal_inset + narrowed)
            inner = self._outline(self.seal_inset + SEAL_WIDTH - narrowed)
            ring = upright(prism(outer, (end - start) * deep, holes=[inner]), "y")
            solids.append(ring.at(y=self.back + start * deep))
        return Body(solid=union(solids), surface=surface, density=0.55 * RUBBER)

    def bores(self, depth: float = 0.0090) -> Solid:
        """Room for the pins in the leaf's ends."""
        hole = cylinder(PIN + 0.001, depth + 0.01, segments=8)
        return union([hole.at(*self.pin, z) for z in (-0.01, self.length - depth)])

    def hinge_plates(self, surface: str, *, ends: tuple[bool, bool] = (True, True)) -> list[Body]:
        """The cabinet's plates below and above the leaf with their pins; whose ends are wanted."""
        x, y = self.pin
        bodies = []
        for z, side, wanted in ((0.0, -1.0, ends[0]), (self.length, 1.0, ends[1])):
            if not wanted:
                continue
            near = z + side * PLATE_PLAY
            low, high = sorted((near, near + side * PLATE))
            arm = slab((x - 0.009, y, low), (x + 0.017, 0.001, high))
            nose = cylinder(0.009, PLATE, segments=10).at(x, y, low)
            wide = slab((x - 0.009, -0.004, low), (x + 0.060, 0.001, high))
            pin = cylinder(PIN, 0.0075 + PLATE_PLAY, segments=8)
            pin = pin.at(x, y, near if side < 0.0 else near - 0.0075 - PLATE_PLAY)
            box = slab((x - 0.009, y - 0.009, low), (x + 0.017, 0.0, high))
            body = Body(
                solid=union([arm, nose, wide, pin]), surface=surface, density=STEEL,
                collision=(box,),
            )  # fmt: skip
            bodies.append(self.carried(body))
        return bodies

    def hinge_cap(self, surface: str, *, top: float) -> list[Body]:
        """A cover over the upper hinge on a case that ends at z = `top`; none on lower leaves."""
        over = top - self.corner[2]
        if self.length < over - 0.02:
            return []
        x, y = self.pin
        low, high = (x - 0.010, y - 0.006, over - 0.0035), (x + 0.075, 0.085, over + 0.016)
        upper = slab((*low[:2], over + 0.001), high)
        cap = Body(solid=slab(low, high), surface=surface, density=500.0, edge=0.005,
                   collision=(upper,))  # fmt: skip
        return [self.carried(cap)]

    def swung(self, x: float, y: float, angle: float) -> tuple[float, float]:
        """Where a drawn point is after the door has turned by `angle` rad."""
        dx, dy = x - self.pin[0], y - self.pin[1]
        cos, sin = math.cos(angle), math.sin(angle)
        return self.pin[0] + dx * cos + dy * sin, self.pin[1] - dx * sin + dy * cos

    def clearing_angle(self, corners: list[tuple[float, float]], *, beside: float) -> float:
        """The least angle, rad, from which on no drawn corner lies further right than `beside`."""
        for angle in np.radians(np.arange(60.0, 176.0, 1.0)):
            if max(self.swung(x, y, angle)[0] for x, y in corners) <= beside:
                return float(angle)
        return math.radians(176.0)

    def widest(self) -> float:
        """rad; how far it turns before the hinge's edge meets the corner of the case beside it."""
        x, y = self.pin
        for angle in np.radians(np.arange(80.0, 175.0, 0.5)):
            if x - x * math.cos(angle) + y * math.sin(angle) > -0.0018:
                return float(angle) - math.radians(0.5)
        return math.radians(175.0)

    def free_reach(self, y: float, *, beside: float) -> float:
        """The largest x of what stands out to depth `y` and turns past a wall at x = `beside`."""
        radius = beside - self.pin[0]
        return self.pin[0] + math.sqrt(radius**2 - (y - self.pin[1]) ** 2)

    def swing(
        self, *, upper: float, friction: float, latch: Latch | None, effort: float = 40.0
    ) -> Joint:
        """The joint of a door: +q turns the free edge towards -y."""
        return Joint(
            name=f"{self.name}_hinge",
            type="revolute",
            parent="base",
            child=self.name,
            axis=(0.0, 0.0, -1.0 if self.hinge == "left" else 1.0),
            origin=self.point(*self.pin, 0.0),
            limit=Limit(lower=0.0, upper=upper),
            friction=friction,
            damping=0.4,
            effort=effort,
            latch=latch,
        )

    def slide(self, *, travel: float, friction: float, latch: Latch | None) -> Joint:
        """The joint of a drawer's front."""
        return Joint(
            name=f"{self.name}_slide",
            type="prismatic",
            parent="base",
            child=self.name,
            axis=(0.0, -1.0, 0.0),
            limit=Limit(lower=0.0, upper=travel),
            friction=friction,
            damping=8.0,
            effort=200.0,
            velocity=1.0,
            latch=latch,
        )

    def grip(self, x: float, y: float, z: float, kind: Literal["handle", "edge"]) -> Grip:
        """Where it is pulled."""
        outward = (0.0, -1.0, 0.0)
        return Grip(name=f"{self.name}_{kind}", kind=kind, position=self.point(x, y, z),
                    outward=outward, pull=outward)  # fmt: skip

    def _outline(self, inset: float) -> Floats:
        """(z, x) of a rounded rectangle inside the leaf's edges."""
        high, wide = self.length - 2.0 * inset, self.width - 2.0 * inset
        outline = rounded_rectangle(high, wide, 0.012, segments=1)
        return np.asarray(outline + np.array([self.length / 2.0, self.width / 2.0]))
