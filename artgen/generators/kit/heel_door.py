"""Doors on pins near one edge whose heel is round about the pin, so that it turns clear of the
cabinet: microwave ovens, ovens, refrigerators.

Everything is drawn as a door hinged on its left: x from the heel to the free edge, y = 0 the
cabinet's front, the door before it (y < 0), z along the pin. `placed` puts it where it belongs.
"""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, Joint, Latch, Limit, Spring, Vector
from artgen.core.mesh import Floats
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, cylinder, prism, slab, union

Hinge = Literal["left", "right", "bottom"]
EAR = 0.004
"""m; thickness of a hinge ear, as large as its play in its notch twice over."""
PLAY = 0.0012
"""m; between ear and notch, and between pin and bore."""
PIN = 0.0025
"""m; radius of a pin."""
TURN: Mapping[Hinge, Floats] = {
    "left": np.eye(3),
    "right": np.diag([-1.0, 1.0, 1.0]),
    "bottom": np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
}
"""From the drawing to the object; mirrored for two of them, which a door drawn so bears."""
AXIS: Mapping[Hinge, Vector] = {
    "left": (0.0, 0.0, -1.0),
    "right": (0.0, 0.0, 1.0),
    "bottom": (1.0, 0.0, 0.0),
}
"""+q turns the free edge towards -y."""


@dataclass(frozen=True, kw_only=True)
class HeelDoor:
    """A closed door.

    Attributes:
        hinge: the edge that the pin is near.
        corner: where the drawing's zero lies in the object frame, m.
        width: from heel to free edge.
        length: along the pin.
        thickness: m.
        gap: between the door and its cabinet.
        heel: radius of the heel, distance of the pin from the door's back and its heel edge.
        ears: z of the middle of each hinge ear.
    """

    hinge: Hinge
    corner: Vector
    width: float
    length: float
    thickness: float
    gap: float
    heel: float
    ears: tuple[float, ...]

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
        """(x, y) of the pin's axis."""
        return self.heel, self.back - self.heel

    @property
    def matrix(self) -> Floats:
        """(4, 4) from the drawing to the object frame."""
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = TURN[self.hinge], self.corner
        return matrix

    def placed(self, solid: Solid) -> Solid:
        """A drawn solid in the object frame."""
        return solid.transformed(self.matrix)

    def carried(self, body: Body) -> Body:
        """A drawn body in the object frame."""
        return dataclasses.replace(
            body,
            solid=self.placed(body.solid),
            collision=tuple(self.placed(piece) for piece in body.collision),
        )

    def point(self, x: float, y: float, z: float) -> Vector:
        """A drawn point in the object frame."""
        u, v, w = (float(c) for c in self.matrix[:3, :3] @ (x, y, z) + self.corner)
        return u, v, w

    def layer(self, front: float, back: float) -> Solid:
        """The leaf between two depths (y), its heel rounded and notched for the ears."""
        cut = slab((-1.0, front, -1.0), (self.width + 1.0, back, self.length + 1.0))
        return (prism(self._outline(), self.length) & cut) - self._notches()

    def ear_solids(self) -> Solid:
        """The cabinet's ears around the pins, from y = 0 forward."""
        x, y = self.pin
        radius = self._ear_radius
        nose = arc((x, y), radius, math.pi, 2.0 * math.pi, 8)
        outline = np.concatenate([nose, [(x + radius, 0.003), (x - radius, 0.003)]])
        bore = arc((x, y), PIN + PLAY, 0.0, 2.0 * math.pi, 12)[:-1]
        ear = prism(outline, EAR, holes=[bore])
        return union([ear.at(z=z - EAR / 2.0) for z in self.ears])

    def pin_solids(self) -> Solid:
        """The door's pins across the notches."""
        x, y = self.pin
        high = EAR + 2.0 * PLAY
        return union([cylinder(PIN, high, segments=12).at(x, y, z - high / 2.0) for z in self.ears])

    def joint(
        self,
        *,
        upper: float,
        friction: float,
        latch: Latch | None = None,
        spring: Spring | None = None,
        name: str = "door_hinge",
        child: str = "door",
    ) -> Joint:
        """The hinge on the base."""
        return Joint(
            name=name,
            type="revolute",
            parent="base",
            child=child,
            axis=AXIS[self.hinge],
            origin=self.point(*self.pin, 0.0),
            limit=Limit(lower=0.0, upper=upper),
            friction=friction,
            damping=0.15,
            effort=30.0,
            latch=latch,
            spring=spring,
        )

    @property
    def _ear_radius(self) -> float:
        return 0.42 * self.heel

    def _outline(self) -> Floats:
        """The door's section: a rectangle whose heel is a quarter circle about the pin."""
        heel = arc(self.pin, self.heel, math.pi / 2.0, math.pi, 8)
        return np.concatenate(
            [heel, [(0.0, self.front), (self.width, self.front), (self.width, self.back)]]
        )

    def _notches(self) -> Solid:
        """Room for the ears at every angle up to 100 degrees or so."""
        (x, y), reach = self.pin, self._ear_radius + PLAY
        half = EAR / 2.0 + PLAY
        low, high = (-0.01, y - reach - 0.22 * self.heel), (x + reach, 0.01)
        return union([slab((*low, z - half), (*high, z + half)) for z in self.ears])
