"""Handles of windows: an espagnolette handle that hangs down when shut, and a cam lock."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union, upright, wire

Style = Literal["straight", "flat", "cranked"]
PLATE, PLAY = 0.010, 0.0012
"""Thickness of the plate under a handle, gap around its neck, m."""


@dataclass(frozen=True, kw_only=True)
class WindowHandle:
    """On a face that looks to -y; shut, its grip hangs down.

    Attributes:
        at: (x, y, z) of the neck on the face, m.
        length: of the grip, m.
        towards: -1 turns its lower end to -x, +1 to +x.
        turn_deg: 90 to swing or slide a sash, 180 to tilt it.
    """

    style: Style
    at: tuple[float, float, float]
    length: float
    towards: float
    turn_deg: float

    def plate(self, metal: Stock) -> Body:
        """The rosette with its two screw caps."""
        neck = cylinder(0.0085 + PLAY, 0.05, axis="y", segments=20).at(0.0, -0.04, 0.0)
        outline = rounded_rectangle(0.072, 0.030, 0.008, segments=4)
        plate = upright(prism(outline, PLATE), "y").at(0.0, -PLATE, 0.0) - neck
        screws = [
            cylinder(0.0035, 0.001, axis="y", segments=12).at(0.0, -PLATE - 0.0006, z)
            for z in (-0.0225, 0.0225)
        ]
        contact = slab((-0.015, -PLATE, -0.036), (0.015, 0.0, 0.036)).at(*self.at)
        return metal.piece(union([plate, *screws]).at(*self.at), contact=(contact,))

    def part(self, name: str, metal: Stock) -> DraftPart:
        """Neck and grip."""
        out, r, end = 0.043, 0.0085, -self.length
        neck = cylinder(0.0085, out - 0.002, axis="y", segments=20).at(0.0, -out, 0.0)
        contact: tuple[Solid, ...]
        core = slab((-0.006, -out, -0.006), (0.006, -PLATE - 0.0015, 0.006))
        if self.style == "flat":
            grip = slab((-0.010, -out - 0.006, end), (0.010, -out + 0.006, 0.012))
            solid, contact = union([grip, neck]), (core, grip)
        else:
            drop = 0.014 if self.style == "cranked" else 0.0
            path = np.array(
                [
                    (0, -out, 0.008),
                    (0, -out, -0.014),
                    (0, -out - drop, -0.036),
                    (0, -out - drop, end),
                ]
            )
            path = path if drop else path[[0, 3]]
            legs: tuple[Solid, ...] = tuple(
                wire(path[k : k + 2], 0.95 * r, sides=6).hull() for k in range(len(path) - 1)
            )
            solid, contact = union([wire(path, r, sides=14), neck]), (core, *legs)
        x, y, z = self.at
        taken = Grip(
            name=f"{name}_grip",
            kind="lever",
            position=(x, y - out, z - 0.65 * self.length),
            outward=(0.0, -1.0, 0.0),
            pull=(self.towards, 0.0, 0.0),
        )
        body = metal.piece(solid.at(*self.at), contact=tuple(c.at(*self.at) for c in contact))
        return DraftPart(name=name, label="lever", bodies=(body,), grips=(taken,))

    def joint(self, name: str, *, parent: str, child: str, friction: float) -> Joint:
        """Turned out of the shut position by +q, over a detent."""
        return Joint(
            name=name,
            type="revolute",
            parent=parent,
            child=child,
            axis=(0.0, -self.towards, 0.0),  # -z goes to -x about +y.
            origin=self.at,
            limit=Limit(lower=0.0, upper=math.radians(self.turn_deg)),
            friction=friction,
            damping=0.03,
            effort=12.0,
            latch=Latch(force=0.6, reach=math.radians(8.0)),
        )


@dataclass(frozen=True, kw_only=True)
class CamLock:
    """A cam on the top of a lower sash that reaches over a keeper on the upper one.

    Attributes:
        at: (x, y, z) of the pin on the rail's top, m.
        reach: from the pin to the cam's tip, towards +y, m.
    """

    at: tuple[float, float, float]
    reach: float

    def base(self, metal: Stock) -> Body:
        """The plate under the cam."""
        plate = slab((-0.030, -0.009, 0.0), (0.030, 0.009, 0.004)).at(*self.at)
        return metal.piece(plate, contact=(plate,))

    def keeper(self, metal: Stock, *, front: float, rear: float) -> Body:
        """A hook on the other sash, under the cam."""
        x, _, z = self.at
        plate = slab((x - 0.022, front, z), (x + 0.022, rear, z + 0.0035))
        return metal.piece(plate, contact=(plate,))

    def part(self, name: str, metal: Stock) -> DraftPart:
        """The cam with its thumb lever, which points to +x."""
        disc = prism(circle(0.0085, segments=20), 0.009).at(0.0, 0.0, 0.0055)
        cam = slab((-0.0075, 0.0, 0.0055), (0.0075, self.reach, 0.0105))
        lever = slab((0.0, -0.0045, 0.0105), (0.040, 0.0045, 0.0145))
        stem = slab((-0.006, -0.006, 0.0055), (0.006, 0.006, 0.0145))
        x, y, z = self.at
        grip = Grip(
            name=f"{name}_thumb",
            kind="lever",
            position=(x + 0.032, y, z + 0.012),
            outward=(0.0, 0.0, 1.0),
            pull=(0.0, -1.0, 0.0),
        )
        contact = tuple(piece.at(*self.at) for piece in (cam, lever, stem))
        body = metal.piece(union([disc, cam, lever]).at(*self.at), contact=contact)
        return DraftPart(name=name, label="latch", bodies=(body,), grips=(grip,))

    def joint(self, name: str, *, parent: str, child: str) -> Joint:
        """The thumb comes forward and the cam swings in over the lower sash."""
        return Joint(
            name=name,
            type="revolute",
            parent=parent,
            child=child,
            axis=(0.0, 0.0, -1.0),
            origin=(self.at[0], self.at[1], 0.0),
            limit=Limit(lower=0.0, upper=math.radians(135.0)),
            friction=0.15,
            damping=0.01,
            effort=5.0,
            latch=Latch(force=0.2, reach=math.radians(10.0)),
        )


def finger_lift(x: float, y: float, z: float, *, metal: Stock) -> Body:
    """A hook for two fingers on a rail's face."""
    plate = slab((x - 0.026, y - 0.003, z - 0.012), (x + 0.026, y, z + 0.012))
    hook = slab((x - 0.024, y - 0.022, z - 0.012), (x + 0.024, y - 0.003, z - 0.008))
    lip = slab((x - 0.024, y - 0.022, z - 0.012), (x + 0.024, y - 0.018, z - 0.002))
    pieces = (plate, hook, lip)
    return metal.piece(union(pieces), contact=pieces)
