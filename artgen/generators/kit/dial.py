"""A knob on a shaft that is turned over a printed scale: browning, timers, temperatures."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.control_console import PanelPlane
from artgen.geometry.solid import Solid, cone, cylinder, prism, slab, union

SHAFT, PLAY, GAP = 0.0030, 0.0006, 0.0010
"""m; radius of the shaft, its room in the hole, room under the knob."""
DialStyle = Literal["bar", "ribbed", "drum"]


@dataclass(frozen=True, kw_only=True)
class Dial:
    """A knob in the frame of the face it stands on.

    Attributes:
        name: of the part.
        center: (u, v) on the face, m.
        radius: of the knob.
        height: above the face.
        style: a disc with a grip bar, a ribbed cone, or a plain drum with a skirt.
        start: angle of the pointer at rest, rad, counter-clockwise from the face's +u.
        sweep: rad that it turns clockwise; None turns on without end.
        label: its role.
        lift: thickness of what lies on the face around it (a printed plate).
    """

    name: str
    center: tuple[float, float]
    radius: float
    height: float
    style: DialStyle = "ribbed"
    start: float = math.radians(225.0)
    sweep: float | None = math.radians(270.0)
    label: Literal["dial", "knob"] = "dial"
    friction: float = 0.01
    lift: float = 0.0

    def hole(self) -> Solid:
        """What the face must leave free for the shaft, in the face's frame."""
        return cylinder(SHAFT + PLAY, 0.0135, segments=12).at(*self.center, -0.0095)

    def part(self, plane: PanelPlane, surface: str, mark: str, *, density: float) -> DraftPart:
        """Knob and shaft of `surface`, the pointer of `mark`."""
        base = self.lift + GAP
        knob = union([_FORMS[self.style](self.radius, self.height - base).at(0.0, 0.0, base),
                      cylinder(SHAFT, base + 0.009, segments=12).at(0.0, 0.0, -0.008)])  # fmt: skip
        tip = self._pointer()
        return DraftPart(
            name=self.name,
            label=self.label,
            bodies=(
                Body(
                    solid=self._placed(plane, knob),
                    surface=surface,
                    density=density,
                    edge=0.0005 if self.style != "ribbed" else 0.0,
                    collision=tuple(self._placed(plane, piece) for piece in self._touch(base)),
                ),
                Body(solid=self._placed(plane, tip), surface=mark, density=density),
            ),
            grips=(
                Grip(
                    name=f"{self.name}_grip",
                    kind="knob",
                    position=plane.point(*self.center, self.height),
                    outward=plane.outward,
                    pull=self._way(plane),
                ),
            ),
        )

    def joint(self, plane: PanelPlane, *, parent: str) -> Joint:
        """Clockwise, seen from before the face, by +q."""
        x, y, z = (-c + 0.0 for c in plane.outward)
        return Joint(
            name=f"{self.name}_turn",
            type="continuous" if self.sweep is None else "revolute",
            parent=parent,
            child=self.name,
            axis=(x, y, z),
            origin=plane.point(*self.center),
            limit=None if self.sweep is None else Limit(lower=0.0, upper=self.sweep),
            friction=self.friction,
            damping=0.0008,
            effort=1.0,
            velocity=3.0,
        )

    def _placed(self, plane: PanelPlane, solid: Solid) -> Solid:
        return plane.placed(solid.at(*self.center, 0.0))

    def _touch(self, base: float) -> list[Solid]:
        """Three boxes whose corners lie on the rim."""
        halves = ((0.92, 0.39), (0.39, 0.92), (0.70, 0.70))
        return [
            slab(
                (-a * self.radius, -b * self.radius, base),
                (a * self.radius, b * self.radius, self.height),
            )
            for a, b in halves
        ]

    def _pointer(self) -> Solid:
        """A stripe on the knob's top, drawn along its radius."""
        low, high = 0.30 * self.radius, 0.72 * self.radius
        half, top = max(0.0007, 0.05 * self.radius), self.height
        stripe = slab((low, -half, top - 0.0012), (high, half, top + 0.0004))
        return stripe.turned("z", self.start)

    def _way(self, plane: PanelPlane) -> tuple[float, float, float]:
        """The way of the pointer's tip as the knob starts to turn clockwise."""
        along = math.sin(self.start), -math.cos(self.start)
        way = along[0] * np.asarray(plane.right) + along[1] * np.asarray(plane.up)
        x, y, z = (float(c) for c in way / np.linalg.norm(way))
        return x, y, z


def _bar(radius: float, height: float) -> Solid:
    disc = cone(radius, 0.96 * radius, 0.45 * height, segments=28)
    grip = slab(
        (-0.86 * radius, -0.16 * radius, 0.4 * height), (0.86 * radius, 0.16 * radius, height)
    )
    return union([disc, grip.turned("z", math.radians(225.0))])


def _ribbed(radius: float, height: float) -> Solid:
    """Eighteen ribs, a chamfered rim."""
    angles = 2.0 * np.pi * np.arange(36) / 36.0
    reach = np.where(np.arange(36) % 2 == 0, radius, 0.94 * radius)
    outline = np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=1)
    ring = prism(outline, 0.9 * height)
    return union([ring, cone(0.94 * radius, 0.86 * radius, height, segments=36)])


def _drum(radius: float, height: float) -> Solid:
    skirt = cone(radius, 0.97 * radius, 0.22 * height, segments=28)
    return union([skirt, cone(0.82 * radius, 0.76 * radius, height, segments=28)])


_FORMS = {"bar": _bar, "ribbed": _ribbed, "drum": _drum}
