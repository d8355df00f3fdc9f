"""Heads of desk lamps, drawn below their joint at zero: shades with a bulb, bars of light."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.lamp_arm import TONGUE, tongue
from artgen.generators.kit.round_contact import round_boxes
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, hull, prism, revolve, slab, union

HeadStyle = Literal["cone", "dome", "bell", "bar"]
WEDGES = 8
SHELL = 0.0016
"""m; thickness of a shade."""


@dataclass(frozen=True, kw_only=True)
class LampHead:
    """A head whose light leaves downwards.

    Attributes:
        style: shape of the shade, or a bar of light.
        radius: of the shade's rim, or half the length of the bar, m.
        depth: of the shade, or half the width of the bar, m.
        neck: from the joint to the socket, m.
        vents: slots in the socket's cover.
    """

    style: HeadStyle
    radius: float
    depth: float
    neck: float
    vents: bool

    def bodies(self, shade: Stock, inner: Stock, glow: Stock, metal: Stock) -> list[Body]:
        """Tongue, neck, shade and what glows."""
        return (
            self._bar(shade, glow)
            if self.style == "bar"
            else self._shade(shade, inner, glow, metal)
        )

    def _tongue(self) -> Solid:
        stem = slab((-TONGUE / 2.0, -0.0085, -self.neck - 0.004), (TONGUE / 2.0, 0.0085, 0.0))
        return union([tongue(), stem])

    def _bar(self, shade: Stock, glow: Stock) -> list[Body]:
        """A flat bar across, its diffuser let into the underside."""
        low, thick = -self.neck - 0.012, 0.012
        outline = rounded_rectangle(
            2.0 * self.radius, 2.0 * self.depth, 0.7 * self.depth, segments=4
        )
        case = prism(outline, thick).at(z=low)
        lens = rounded_rectangle(2.0 * self.radius - 0.016, 2.0 * self.depth - 0.014,
                                 0.6 * self.depth - 0.003, segments=4)  # fmt: skip
        diffuser = prism(lens, 0.004).at(z=low - 0.0008)
        knuckle = slab((-0.016, -0.012, low + thick - 0.001), (0.016, 0.012, -self.neck + 0.006))
        touch = slab((-self.radius, -self.depth, low), (self.radius, self.depth, low + thick))
        entry = slab((-0.010, self.depth - 0.012, low + thick - 0.001),
                     (0.010, self.depth - 0.004, low + thick + 0.0035))  # fmt: skip
        return [
            shade.piece(union([self._tongue(), case, knuckle, entry]) - diffuser, contact=(touch,)),
            glow.piece(diffuser),
        ]

    def profile(self) -> Floats:
        """(radius, height) of the shade's outside from its rim to the socket."""
        top, rim = -self.neck - 0.030, -self.neck - 0.030 - self.depth
        r0, r1 = self.radius, 0.0225
        share = np.linspace(0.0, 1.0, 2 if self.style == "cone" else 6)
        if self.style == "dome":
            angle = share * math.acos(r1 / r0)
            return np.c_[r0 * np.cos(angle), rim + self.depth * np.sin(angle) / math.sin(angle[-1])]
        if self.style == "bell":
            swing = (1.0 - share) ** 2
            return np.c_[
                r1 + (r0 - r1) * (0.35 * (1 - share) + 0.65 * swing), rim + self.depth * share
            ]
        return np.c_[r0 + (r1 - r0) * share, rim + (top - rim) * share]

    def _shade(self, shade: Stock, inner: Stock, glow: Stock, metal: Stock) -> list[Body]:
        profile = self.profile()
        outline = np.concatenate([profile, (profile - (SHELL, 0.0))[::-1]])
        lip = profile[0] + np.array(
            [(-SHELL, 0.0), (0.0012, 0.0), (0.0012, 0.004), (-SHELL, 0.004)]
        )
        shell = union([revolve(outline, segments=36), revolve(lip, segments=36)])
        lining = revolve(
            np.concatenate(
                [profile - (SHELL - 0.0001, 0.0), (profile - (SHELL + 0.0006, 0.0))[::-1]]
            ),
            segments=36,
        )
        top = -self.neck - 0.030
        entry = cylinder(0.0042, 0.010, axis="y", segments=12).at(0.0, 0.0205, top + 0.014)
        cover = self._cover(top) | entry
        bulb_low = float(profile[0, 1]) + 0.012
        boxes = round_boxes(0.0225, top, -self.neck + 0.002)
        return [
            shade.piece(union([self._tongue(), cover]), contact=boxes),
            shade.piece(shell, contact=self._wedges(profile)),
            inner.piece(lining),
            metal.piece(cylinder(0.0135, 0.012, segments=18).at(z=top - 0.014)),
            glow.piece(self._bulb(bulb_low, top - 0.014)),
        ]

    def _cover(self, top: float) -> Solid:
        """The cover of the socket above the shade, with cooling slots."""
        r, high = 0.0235, -self.neck
        cap = revolve([(0.0, top - 0.002), (r, top - 0.002), (r, high - 0.004), (r - 0.005, high),
                       (0.0, high)], segments=28)  # fmt: skip
        if not self.vents:
            return cap
        slot = slab((-0.0012, -0.1, top + 0.006), (0.0012, 0.1, high - 0.008))
        ring = cylinder(0.1, 0.1, segments=8).at(z=top) - cylinder(r - 0.0015, 0.3, segments=28).at(
            z=top - 0.1
        )
        slots = union([slot.turned("z", math.pi * k / 6.0) for k in range(6)])
        return cap - (slots & ring)

    def _bulb(self, low: float, top: float) -> Solid:
        """A pear-shaped lamp with its neck in the socket."""
        height = min(top - low, 0.085)
        r = 0.30 * height
        low = top - height
        ball = [(r * math.sin(a), low + r * (1.0 - math.cos(a))) for a in np.linspace(0.0, 2.1, 7)]
        return revolve(
            [*ball, (0.0115, top - 0.2 * height), (0.0115, top), (0.0, top)], segments=18
        )

    def _wedges(self, profile: Floats) -> tuple[Solid, ...]:
        """Slabs around the open inside: the lower part of the shade, to where the bulb fills it."""
        low, high = profile[0], profile[-1]
        if len(profile) > 2:
            high = profile[3]
        step = 2.0 * math.pi / WEDGES
        pieces = []
        for k in range(WEDGES):
            turns = [(k + s) * step for s in (-0.5, 0.5)]
            pieces.append(hull([
                (reach * math.cos(a), reach * math.sin(a), z)
                for r, z in (low, high) for a in turns
                for reach in (1.028 * r - SHELL, 1.028 * r)
            ]))  # fmt: skip
        return tuple(pieces)
