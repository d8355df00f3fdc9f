"""Handles of valves that turn about their stem: cross, lever, tripod and fluted ones."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.printed import printed, ring, words
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cone, cylinder, hull, prism, revolve, slab, union

ValveStyle = Literal["cross", "lever", "tripod", "fluted"]
GAP = 0.0012
"""m; between bonnet and handle."""
INDEX = 0.0068
"""m; radius of the index button with its letter."""
COLORS = {"H": "#b3261e", "C": "#1f4fa3"}


@dataclass(frozen=True, kw_only=True)
class ValveHandle:
    """A handle in the frame of its seat: z out of the seat, which lies at the bonnet's top.

    Attributes:
        name: of the part.
        letter: `H` or `C`, on its index button.
        size: from the middle to the tip of a spoke, m.
        height: of the hub.
        style: of the handle.
        turn: rad from shut to open.
        sense: +1 opens counter-clockwise as seen from outside, -1 clockwise.
        start: angle of the first spoke at rest, rad from the frame's +x.
    """

    name: str
    letter: str
    size: float
    height: float
    style: ValveStyle
    turn: float
    sense: int
    start: float

    def part(self, plane: PanelPlane, spokes: Stock, hub: Stock, index: str) -> DraftPart:
        """Hub, spokes and index button; `plane.origin` is the seat's middle."""
        middle = self._hub()
        arms, contact = self._arms()
        button = cylinder(INDEX, 0.0024, segments=20).at(z=self.height - 0.0012)
        corner = plane.point(-INDEX, -INDEX, self.height)
        image = PanelPlane(
            origin=corner, right=plane.right, up=plane.up, size=(2.0 * INDEX, 2.0 * INDEX)
        )
        half = 0.0065
        core = slab((-half, -half, GAP), (half, half, self.height))
        bodies = [
            hub.piece(plane.placed(middle), contact=(plane.placed(core),)),
            spokes.piece(
                plane.placed(arms), contact=tuple(plane.placed(piece) for piece in contact)
            ),
            Body(solid=plane.placed(button), surface=index, density=2300.0, decal=image.decal()),
        ]
        return DraftPart(
            name=self.name, label="knob", bodies=tuple(bodies), grips=(self._grip(plane),)
        )

    def joint(self, plane: PanelPlane, *, parent: str) -> Joint:
        """Opens by +q."""
        x, y, z = (self.sense * c + 0.0 for c in plane.outward)
        return Joint(
            name=f"{self.name}_turn",
            type="revolute",
            parent=parent,
            child=self.name,
            axis=(x, y, z),
            origin=plane.origin,
            limit=Limit(lower=0.0, upper=self.turn),
            friction=0.12,
            damping=0.002,
            effort=4.0,
        )

    def index(self, name: str) -> SurfaceSpec:
        """The white button with its letter and ring."""
        side, ink = 2.0 * INDEX, COLORS[self.letter]
        marks = [
            ring((INDEX, INDEX), 0.86 * INDEX, width=0.0007, ink=ink),
            words((INDEX, INDEX), self.letter, cap=0.0052, ink=ink),
        ]
        return printed(name, (side, side), background="#f2f1ec", marks=marks, roughness=0.18)

    def _grip(self, plane: PanelPlane) -> Grip:
        tip = self.size * math.cos(self.start), self.size * math.sin(self.start)
        way = np.asarray(plane.right) * -tip[1] + np.asarray(plane.up) * tip[0]
        x, y, z = (float(c) for c in self.sense * way / np.linalg.norm(way))
        return Grip(
            name=f"{self.name}_grip",
            kind="knob",
            position=plane.point(0.0, 0.0, self.height),
            outward=plane.outward,
            pull=(x, y, z),
        )

    def _hub(self) -> Solid:
        """A turned hub: skirt, waist and crown, with the hole of its grub screw."""
        h = self.height
        profile = [(0.0, GAP), (0.0125, GAP), (0.0130, 0.22 * h), (0.0098, 0.42 * h),
                   (0.0104, 0.80 * h), (0.0088, h), (0.0, h)]  # fmt: skip
        screw = cylinder(0.0014, 0.01, axis="x", segments=8).at(0.0065, 0.0, 0.30 * h)
        return revolve(profile, segments=24) - screw

    def _arms(self) -> tuple[Solid, tuple[Solid, ...]]:
        count, make = _STYLES[self.style]
        one = make(self.size).at(z=0.62 * self.height)
        turned = [one.turned("z", self.start + 2.0 * math.pi * k / count) for k in range(count)]
        if self.style == "fluted":
            return turned[0], (_flute_contact(self.size, self.height).turned("z", self.start),)
        if self.style == "cross" and abs(math.sin(2.0 * self.start)) < 1e-9:
            low, high = 0.62 * self.height - 0.0048, 0.62 * self.height + 0.0048
            a, b = self.size, 0.0048
            return union(turned), (
                slab((-a, -b, low), (a, b, high)),
                slab((-b, -a, low), (b, a, high)),
            )
        return union(turned), tuple(piece.hull() for piece in turned)


def _cross(size: float) -> Solid:
    """A spoke that narrows, with a ball at its end; drawn along +x about z = 0."""
    spoke = cone(0.0050, 0.0034, size - 0.006, axis="x", segments=12)
    return union([spoke, _ball(0.0054).at(x=size - 0.0054)])


def _ball(radius: float) -> Solid:
    angles = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 7)
    outline = [(max(0.0, radius * math.cos(a)), radius * math.sin(a)) for a in angles]
    return revolve(outline, segments=14)


def _lever(size: float) -> Solid:
    """One arm like a paddle that rises a little and ends round."""
    rings = []
    for x, r, z in ((0.0, 0.0062, 0.0), (0.6 * size, 0.0050, 0.002), (size, 0.0068, 0.006)):
        outline = rounded_rectangle(2.0 * r, 0.62 * r, 0.3 * r, segments=4)
        rings.append(np.c_[np.full(len(outline), x), outline[:, 0], z + outline[:, 1]])
    solids = [hull(np.concatenate(pair)) for pair in (rings[:2], rings[1:])]
    return union(solids)


def _fluted(size: float) -> Solid:
    """A wheel with flutes around the hub."""
    radius = 0.66 * size
    angles = 2.0 * np.pi * np.arange(48) / 48.0
    reach = radius * (1.0 + 0.05 * np.cos(8.0 * angles))
    outline = np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=1)
    return prism(outline, 0.016).at(z=-0.009)


def _flute_contact(size: float, height: float) -> Solid:
    half = 0.66 * size * 0.72
    return slab((-half, -half, 0.62 * height - 0.009), (half, half, 0.62 * height + 0.007))


_STYLES = {
    "cross": (4, _cross),
    "lever": (1, _lever),
    "tripod": (3, _cross),
    "fluted": (1, _fluted),
}
