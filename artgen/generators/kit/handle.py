"""Handles for fronts that face -y: bars, bows, knobs, cups."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, cylinder, revolve, slab, union, wire

Way = Literal["x", "z"]
"""Along which axis a long handle lies."""


@dataclass(frozen=True, kw_only=True)
class Handle:
    """A handle's measures, m.

    Attributes:
        style: key of `STYLES`.
        length: distance of the screws of bars and bows.
        radius: of bars and bows; knobs and cups scale with it.
        standoff: from the front to a bar's axis.
    """

    style: str
    length: float
    radius: float
    standoff: float

    @property
    def reach(self) -> float:
        """How far it stands out from the front."""
        return REACH[self.style](self)

    @property
    def span(self) -> float:
        """Its longest side, along the front."""
        return SPAN[self.style](self)

    def at(self, x: float, y: float, z: float, way: Way, stock: Stock) -> Body:
        """Mounted with its middle at (x, z) on a front whose face is the plane y."""
        solid, contact = STYLES[self.style](self)
        solid, contact = _laid(solid, way), tuple(_laid(piece, way) for piece in contact)
        return stock.piece(solid.at(x, y, z), contact=tuple(piece.at(x, y, z) for piece in contact))


Shape = tuple[Solid, tuple[Solid, ...]]
"""Visible solid and convex contact pieces, lying along x on the face y = 0."""


def _laid(solid: Solid, way: Way) -> Solid:
    return solid.turned("y", math.pi / 2.0) if way == "z" else solid


def _round_bar(h: Handle) -> Shape:
    over, r = 0.022, h.radius
    bar = cylinder(r, h.length + 2.0 * over, axis="x", segments=14)
    bar = bar.at(-h.length / 2.0 - over, -h.standoff, 0.0)
    post = cylinder(0.8 * r, h.standoff, axis="y", segments=12).at(0.0, -h.standoff, 0.0)
    posts = [post.at(s * h.length / 2.0) for s in (-1.0, 1.0)]
    return union([bar, *posts]), _bridge(h, over - 0.85 * r, 0.85 * r)


def _square_bar(h: Handle) -> Shape:
    contact = _bridge(h, 0.0, h.radius)
    return union(contact), contact


def _bridge(h: Handle, over: float, half: float) -> tuple[Solid, ...]:
    """Boxes of a bar and its two posts."""
    end, foot = h.length / 2.0, h.length / 2.0 - 1.6 * half
    low, high = -h.standoff - half, -h.standoff + half
    bar = slab((-end - over - half, low, -half), (end + over + half, high, half))
    posts = [
        slab(
            (min(s * foot, s * (end + half)), high, -half),
            (max(s * foot, s * (end + half)), 0.0, half),
        )
        for s in (-1.0, 1.0)
    ]
    return (bar, *posts)


def _bow(h: Handle) -> Shape:
    """A round bar bent to a shallow bow."""
    half, rise = h.length / 2.0, h.standoff
    angles = np.linspace(0.0, math.pi, 15)
    x = -half * np.cos(angles)
    y = -rise * np.sin(angles) ** 0.55
    path = np.stack([x, y, np.zeros_like(x)], axis=1)
    path[0], path[-1] = (-half, 0.001, 0.0), (half, 0.001, 0.0)
    bent = wire(path, h.radius, sides=8) - slab((-1.0, 0.0, -1.0), (1.0, 0.05, 1.0))
    return bent, _bridge(
        Handle(style="bow", length=h.length, radius=h.radius, standoff=rise),
        -h.radius,
        0.8 * h.radius,
    )


def _knob(h: Handle) -> Shape:
    """A turned knob: foot, neck, domed head."""
    head, neck, out = 2.5 * h.radius, 1.05 * h.radius, 0.85 * h.standoff
    dome = arc((0.0, 0.0), 1.0, -0.45, math.pi / 2.0, 7)
    dome = dome * (head, 0.16 * out) + (0.0, 0.8 * out)
    outline = np.concatenate(
        [
            [(0.0, 0.0), (1.5 * neck, 0.0), (1.5 * neck, 0.06 * out), (neck, 0.2 * out)],
            [(neck, 0.45 * out)],
            dome[:-1],
            [(0.0, 0.96 * out)],
        ]
    )
    solid = revolve(outline, axis="y", segments=18).mirrored("y")
    side = 0.8 * head
    return solid, (
        slab((-side, -0.95 * out, -side), (side, -0.66 * out, side)),
        slab((-neck, -0.66 * out, -neck), (neck, 0.0, neck)),
    )


def _cup(h: Handle) -> Shape:
    """A shell open below, hung from a small flange."""
    half, out, rise = 0.046, 0.9 * h.standoff, 0.030
    shell = _ellipsoid(half, out, rise) - _ellipsoid(half - 0.0022, out - 0.0022, rise - 0.0022)
    room = slab((-1.0, -1.0, -0.006), (1.0, 0.0, 1.0))
    flange = slab((-0.6 * half, -0.002, 0.9 * rise), (0.6 * half, 0.0, rise + 0.008))
    wings = slab((-half - 0.006, -0.002, -0.006), (half + 0.006, 0.0, 0.010))
    mouth = slab((-half + 0.0022, -1.0, -1.0), (half - 0.0022, 1.0, 0.010))
    solid = union([shell & room, flange, wings - mouth])
    lip = slab((-0.8 * half, -out, -0.006), (0.8 * half, -out + 0.004, 0.4 * rise))
    roof = slab((-0.7 * half, -0.7 * out, 0.72 * rise), (0.7 * half, 0.0, rise))
    return solid, (lip, roof)


def _ellipsoid(a: float, b: float, c: float) -> Solid:
    """Half axes along x, y, z; a turned one, stretched."""
    profile = arc((0.0, 0.0), 1.0, -math.pi / 2.0, math.pi / 2.0, 8)
    profile[[0, -1], 0] = 0.0
    return revolve(profile, segments=20).transformed(np.diag([a, b, c, 1.0]))


STYLES: Mapping[str, Callable[[Handle], Shape]] = {
    "bar": _round_bar,
    "square": _square_bar,
    "bow": _bow,
    "knob": _knob,
    "cup": _cup,
}
REACH: Mapping[str, Callable[[Handle], float]] = {
    "bar": lambda h: h.standoff + h.radius,
    "square": lambda h: h.standoff + h.radius,
    "bow": lambda h: h.standoff + h.radius,
    "knob": lambda h: 0.816 * h.standoff,
    "cup": lambda h: 0.9 * h.standoff,
}
SPAN: Mapping[str, Callable[[Handle], float]] = {
    "bar": lambda h: h.length + 0.044,
    "square": lambda h: h.length + 2.0 * h.radius,
    "bow": lambda h: h.length + 2.0 * h.radius,
    "knob": lambda h: 5.0 * h.radius,
    "cup": lambda h: 0.104,
}
