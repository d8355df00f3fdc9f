"""The handle of a single-lever mixer: a cap over a ball cartridge that swings and lifts."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, cone, cylinder, hull, prism, revolve, slab, union, upright

LeverStyle = Literal["paddle", "loop", "pin", "stick"]
GAP = 0.0010
"""m; between the ball and the cap, and under the cap's front rim."""


@dataclass(frozen=True, kw_only=True)
class MixerHandle:
    """A ball and a cap in the frame of a round seat: z out of the seat, the lever along -y.

    Attributes:
        name: prefix of the parts.
        radius: of the cap and of the seat, m.
        height: of the cap.
        length: of the lever beyond the cap.
        rise: angle of the lever above the seat's plane, rad.
        style: of the lever.
        swing: to each side, rad.
        lift: rad.
    """

    name: str
    radius: float
    height: float
    length: float
    rise: float
    style: LeverStyle
    swing: float
    lift: float

    @property
    def ball(self) -> float:
        """Radius of the ball."""
        return self.radius - 0.0042

    @property
    def center(self) -> float:
        """z of the ball's middle, about which the cap tilts."""
        return min(0.45 * self.ball, self.height - self.ball - 0.004)

    def parts(
        self, plane: PanelPlane, ball: Stock, cap: Stock, marks: tuple[str, str]
    ) -> tuple[DraftPart, DraftPart]:
        """The ball that swings and the cap that tilts on it, with a red and a blue mark."""
        core = Body(
            solid=plane.placed(self._ball()), surface=ball.surface, density=ball.density,
            collision=(plane.placed(self._ball_contact()),),
        )  # fmt: skip
        lever, contact = self._lever()
        solid = (union([self._cap(), lever]) - self._hollow()) - self._under()
        shell = Body(
            solid=plane.placed(solid), surface=cap.surface, density=cap.density, edge=cap.edge,
            collision=tuple(plane.placed(piece) for piece in (*self._cap_contact(), contact)),
        )  # fmt: skip
        spots = [
            Body(solid=plane.placed(spot), surface=mark, density=cap.density)
            for spot, mark in zip(self._marks(), marks, strict=True)
        ]
        grip = Grip(
            name=f"{self.name}_grip",
            kind="lever",
            position=self._point(plane, -0.7 * self.length - self.radius, self._tip_height(0.7)),
            outward=plane.outward,
            pull=plane.outward,
        )
        return (
            DraftPart(name=f"{self.name}_cartridge", label="column", bodies=(core,)),
            DraftPart(name=self.name, label="lever", bodies=(shell, *spots), grips=(grip,)),
        )

    def joints(self, plane: PanelPlane, *, parent: str) -> tuple[Joint, Joint]:
        """Temperature turns the ball, rest in the middle; flow lifts the cap."""
        right = plane.right
        return (
            Joint(
                name=f"{self.name}_swing",
                type="revolute",
                parent=parent,
                child=f"{self.name}_cartridge",
                axis=plane.outward,
                origin=plane.origin,
                limit=Limit(lower=-self.swing, upper=self.swing),
                friction=0.15,
                damping=0.01,
                effort=4.0,
            ),
            Joint(
                name=f"{self.name}_lift",
                type="revolute",
                parent=f"{self.name}_cartridge",
                child=self.name,
                axis=(-right[0] + 0.0, -right[1] + 0.0, -right[2] + 0.0),
                origin=self._point(plane, 0.0, self.center),
                limit=Limit(lower=0.0, upper=self.lift),
                friction=0.35,
                damping=0.02,
                effort=5.0,
            ),
        )

    def _point(self, plane: PanelPlane, y: float, z: float) -> tuple[float, float, float]:
        return plane.point(0.0, y, z)

    def _ball(self) -> Solid:
        """What shows under the cap's raised rear rim: a ball cut flat at the seat and inside the
        cap, so that it is a disc rather than a sphere to solvers of its inertia."""
        angles = np.linspace(-math.asin(self.center / self.ball) + 0.03, math.pi / 6.0, 9)
        outline = [(self.ball * math.cos(a), self.center + self.ball * math.sin(a)) for a in angles]
        ends = [(0.0, outline[0][1]), *outline, (0.0, outline[-1][1])]
        top = ends[-1][1]
        notch = slab(
            (0.3 * self.ball, -0.0020, top - 0.0020), (0.7 * self.ball, 0.0020, top + 0.01)
        )
        return revolve(ends, segments=28) - notch

    def _ball_contact(self) -> Solid:
        half = self.ball / math.sqrt(3.0) - 0.0005
        return slab((-half, -half, 0.0006), (half, half, self.center + 0.5 * self.ball))

    def _hollow(self) -> Solid:
        angles = np.linspace(-math.pi / 2.0, math.pi / 2.0, 15)
        r = self.ball + GAP
        outline = [(max(0.0, r * math.cos(a)), self.center + r * math.sin(a)) for a in angles]
        return revolve(outline, segments=28)

    def _cap(self) -> Solid:
        """A low cylinder whose upper edge is beveled."""
        bevel = 0.18 * self.radius
        wall = cylinder(self.radius, self.height - bevel, segments=32)
        top = cone(self.radius, self.radius - 0.8 * bevel, bevel, segments=32)
        return union([wall, top.at(z=self.height - bevel)])

    def _under(self) -> Solid:
        """Below a plane that rises to the rear, so that the rim clears the seat when lifted."""
        r, c = self.radius, self.center
        rear = c + (r * math.sin(self.lift) + 0.0015 - c) / math.cos(self.lift)
        rear = max(rear, GAP)
        outline = [(-1.0, -1.0), (1.0, -1.0), (1.0, GAP + (rear - GAP) * (1.0 + r) / (2.0 * r)),
                   (r, rear), (-r, GAP), (-1.0, GAP)]  # fmt: skip
        return upright(prism(outline, 1.0), "x").at(x=-0.5)

    def _cap_contact(self) -> list[Solid]:
        """The cap's top and its sides beyond the ball."""
        r, top = self.radius, self.height
        low = self.center + self.ball + GAP
        half = 0.70 * r
        sides = [
            slab((x0, -0.34 * r, 0.5 * top), (x1, 0.34 * r, low))
            for x0, x1 in ((-0.94 * r, -self.ball - GAP), (self.ball + GAP, 0.94 * r))
            if x1 - x0 > 0.001 and low > 0.5 * top
        ]
        return [slab((-half, -half, low), (half, half, top)), *sides]

    def _tip_height(self, share: float) -> float:
        return self.height - 0.006 + share * self.length * math.tan(self.rise)

    def _lever(self) -> tuple[Solid, Solid]:
        """(lever, its contact piece), from inside the cap outwards, rising by `rise`."""
        reach = self.radius + self.length
        solid = _LEVERS[self.style](self.radius, reach, self.length)
        lower, upper = solid.bounds
        ease = np.array([0.12 * (upper[0] - lower[0]), 0.0, 0.0])
        upper[1] = min(upper[1], -self.ball - GAP)
        around = slab(lower + ease, upper - ease)
        lifted, contact = (
            piece.turned("x", -self.rise, about=(0.0, -self.radius, 0.0)).at(z=self.height - 0.0075)
            for piece in (solid, around)
        )
        return lifted, contact

    def _marks(self) -> tuple[Solid, Solid]:
        """A red and a blue spot side by side on the front of the cap."""
        z = 0.42 * self.height
        spots = []
        for x0, x1 in ((-0.0042, -0.0004), (0.0004, 0.0042)):
            depth = math.sqrt(self.radius**2 - 0.0042**2)
            front, back = -self.radius - 0.0004, -depth + 0.001
            spots.append(slab((x0, front, z - 0.0016), (x1, back, z + 0.0016)))
        return spots[0], spots[1]


def _paddle(radius: float, reach: float, length: float) -> Solid:
    """A flat tongue with round ends, its upper edge eased."""
    near, far = 0.0095, 0.0115
    circles = [
        np.c_[center + circle(r - inset, segments=24), np.full(24, z)]
        for center, r in (
            (np.array((0.0, -0.4 * radius)), near),
            (np.array((0.0, far - reach)), far),
        )
        for z, inset in ((0.0, 0.0), (0.0050, 0.0), (0.0062, 0.0012))
    ]
    return hull(np.concatenate(circles))


def _loop(radius: float, reach: float, length: float) -> Solid:
    """A flat bar with a long slot."""
    bar = prism(rounded_rectangle(0.020, reach - 0.3 * radius, 0.0095, segments=6), 0.0062)
    slot = prism(rounded_rectangle(0.0095, 0.62 * length, 0.0045, segments=5), 0.02)
    middle = -(reach + 0.3 * radius) / 2.0
    return bar.at(y=middle) - slot.at(0.0, -radius - 0.58 * length, -0.005)


def _pin(radius: float, reach: float, length: float) -> Solid:
    """A thin round rod with a thicker end."""
    rod = cylinder(0.0036, reach - 0.5 * radius, axis="y", segments=12).at(y=-reach, z=0.0)
    end = cylinder(0.0048, 0.022, axis="y", segments=14).at(y=-reach, z=0.0)
    return union([rod, end])


def _stick(radius: float, reach: float, length: float) -> Solid:
    """A square bar."""
    bar = upright(
        prism(rounded_rectangle(0.009, 0.012, 0.001, segments=2), reach - 0.5 * radius), "y"
    )
    return bar.at(y=-reach)


_LEVERS = {"paddle": _paddle, "loop": _loop, "pin": _pin, "stick": _stick}
