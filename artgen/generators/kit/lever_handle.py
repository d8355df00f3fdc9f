"""Door handles that turn: a lever or a knob on each face of a leaf, on roses or backplates."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring, Vector
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import arc, circle, rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, prism, revolve, slab, union, upright, wire

LeverStyle = Literal["round", "flat", "curved", "return", "knob"]
Plate = Literal["round_rose", "square_rose", "backplate"]
Lock = Literal["none", "keyhole", "cylinder", "thumb_turn"]
ROSE, PLATE, NECK, PLAY = 0.026, 0.008, 0.0095, 0.0012
"""Half size of a rose, its thickness, radius of the neck, and gap around the neck, m."""
SPINDLE = 0.008
"""m; side of the square bar through the leaf (EN 1906)."""
TO_KEY = 0.072
"""m; from the spindle down to the key (DIN 18251)."""


@dataclass(frozen=True, kw_only=True)
class LeverSet:
    """A handle set of a leaf that hangs at its left; the levers point to the left.

    Attributes:
        style: of the lever; `knob` is round.
        length: from the spindle to the lever's end, m.
        radius: half of the lever's thickness, m.
        standoff: from the face to the lever's axis, m.
        turn_deg: how far it turns.
        at: (x, z) of the spindle.
        faces: y of the leaf's front and rear.
    """

    style: LeverStyle
    plate: Plate
    lock: Lock
    length: float
    radius: float
    standoff: float
    turn_deg: float
    at: tuple[float, float]
    faces: tuple[float, float]

    def hole(self) -> Solid:
        """What the leaf must leave free for the spindle."""
        (x, z), (front, rear) = self.at, self.faces
        return cylinder(0.0085, rear - front + 0.02, axis="y").at(x, front - 0.01, z)

    def fixed(self, metal: Stock, dark: Stock) -> tuple[Body, ...]:
        """Roses or backplates on both faces, with keyhole or cylinder."""
        bodies = []
        for solid, contact, stock in _face_plates(self, metal, dark):
            for face in (0, 1):
                pieces = tuple(self._placed(piece, face) for piece in contact)
                bodies.append(stock.piece(self._placed(solid, face), contact=pieces))
        return tuple(bodies)

    def part(self, name: str, metal: Stock) -> DraftPart:
        """Both levers and the spindle between them."""
        solid, contact = LEVERS[self.style](self)
        (x, z), (front, rear) = self.at, self.faces
        half = SPINDLE / 2.0
        spindle = slab((x - half, front - 0.01, z - half), (x + half, rear + 0.01, z + half))
        whole = union([self._placed(solid, 0), self._placed(solid, 1), spindle])
        pieces = tuple(self._placed(piece, face) for face in (0, 1) for piece in contact)
        label = "knob" if self.style == "knob" else "lever"
        body = metal.piece(whole, contact=pieces)
        grips = (self._grip(name, 0), self._grip(f"{name}_inside", 1))
        return DraftPart(name=name, label=label, bodies=(body,), grips=grips)

    def joint(self, name: str, *, parent: str, child: str, friction: float) -> Joint:
        """Pressed down by +q (a knob turns the same way); a spring brings it back."""
        (x, z), travel = self.at, math.radians(self.turn_deg)
        return Joint(
            name=name,
            type="revolute",
            parent=parent,
            child=child,
            axis=(0.0, -1.0, 0.0),  # The end of the lever, to the left, goes down.
            origin=(x, 0.0, z),
            limit=Limit(lower=0.0, upper=travel),
            friction=friction,
            damping=0.02,
            effort=10.0,
            spring=Spring(stiffness=0.9 / travel, reference=-0.6 * travel),
        )

    def _grip(self, name: str, face: int) -> Grip:
        y = self.faces[face] + (-1.0, 1.0)[face] * self.standoff
        outward: Vector = (0.0, -1.0, 0.0) if face == 0 else (0.0, 1.0, 0.0)
        (x, z), knob = self.at, self.style == "knob"
        return Grip(
            name=f"{name}_grip",
            kind="knob" if knob else "lever",
            position=(x if knob else x - 0.65 * self.length, y, z),
            outward=outward,
            pull=(-1.0, 0.0, 0.0) if knob else (0.0, 0.0, -1.0),
        )

    def _placed(self, solid: Solid, face: int) -> Solid:
        (x, z), y = self.at, self.faces[face]
        return (solid if face == 0 else solid.mirrored("y")).at(x, y, z)


Shape = tuple[Solid, tuple[Solid, ...]]
"""Visible solid and convex contact pieces of one side; the face is y = 0, the spindle at 0, 0."""


def _neck(reach: float) -> tuple[Solid, Solid]:
    """A round neck out of the rose, and the box inside it that stays clear of the rose."""
    bar = cylinder(NECK, reach - 0.002, axis="y", segments=20).at(0.0, -reach, 0.0)
    half = 0.7 * NECK
    return bar, slab((-half, -reach, -half), (half, -PLATE - 0.0015, half))


def _bent(h: LeverSet, path: Floats, sides: int) -> Shape:
    """A round lever along a path from the neck to its end, contact pieces along its legs."""
    neck, core = _neck(h.standoff)
    r = h.radius
    ends = np.linspace(0, len(path) - 1, min(2, len(path) - 1) + 1).round().astype(int).tolist()
    legs = tuple(wire(path[i : j + 1], 0.95 * r, sides=6).hull() for i, j in pairwise(ends))
    return union([wire(path, r, sides=sides), neck]), (core, *legs)


def _round(h: LeverSet) -> Shape:
    neck, core = _neck(h.standoff)
    r, path = 0.9 * h.radius, np.array([(NECK, -h.standoff, 0.0), (-h.length, -h.standoff, 0.0)])
    bar = slab((-h.length, -h.standoff - r, -r), (NECK, -h.standoff + r, r))
    return union([wire(path, h.radius, sides=14), neck]), (core, bar)


def _return(h: LeverSet) -> Shape:
    """Its end comes back to the door, so that sleeves do not catch."""
    r, back = h.radius, -PLATE - 0.012
    corner = arc((-h.length + 2.0 * r, -h.standoff + 2.0 * r), 2.0 * r, -math.pi / 2, -math.pi, 4)
    plan = np.concatenate([[(NECK, -h.standoff)], corner, [(-h.length, back)]])
    path = np.c_[plan, np.zeros(len(plan))]
    neck, core = _neck(h.standoff)
    bar = slab((-h.length, -h.standoff - 0.8 * r, -0.8 * r), (NECK, -h.standoff + 0.8 * r, 0.8 * r))
    end = slab((-h.length - 0.8 * r, -h.standoff, -0.8 * r), (-h.length + 0.8 * r, back, 0.8 * r))
    return union([wire(path, r, sides=12), neck]), (core, bar, end)


def _curved(h: LeverSet) -> Shape:
    """A lever that swings down and up again."""
    t = np.linspace(0.0, 1.0, 9)
    x = NECK - (h.length + NECK) * t
    z = -0.010 * np.sin(math.pi * t) + 0.006 * t**2
    y = -h.standoff + 0.006 * np.sin(math.pi * t)
    return _bent(h, np.stack([x, y, z], axis=1), 12)


def _flat(h: LeverSet) -> Shape:
    """A flat bar on a round neck."""
    neck, core = _neck(h.standoff)
    r = h.radius
    bar = slab(
        (-h.length, -h.standoff - 0.6 * r, -1.15 * r), (1.15 * r, -h.standoff + 0.6 * r, 1.15 * r)
    )
    return union([bar, neck]), (core, bar)


def _knob(h: LeverSet) -> Shape:
    """A turned knob: neck, swelling head, flat crown."""
    head, out = 2.6 * h.radius + 0.003, h.standoff + 0.010
    dome = arc((0.0, 0.0), 1.0, -0.9, 1.2, 9) * (head, 0.36 * out) + (0.0, 0.66 * out)
    outline = np.concatenate(
        [[(0.0, 0.002), (NECK, 0.002), (NECK, 0.3 * out)], dome, [(0.0, dome[-1, 1])]]
    )
    solid = revolve(outline, axis="y", segments=28).mirrored("y")
    core = _neck(0.42 * out)[1]
    crown = revolve([(0.0, dome[0, 1]), *dome.tolist(), (0.0, dome[-1, 1])], segments=12)
    return solid, (core, upright(crown, "y").mirrored("y").hull())


LEVERS: Mapping[LeverStyle, Callable[[LeverSet], Shape]] = {
    "round": _round,
    "flat": _flat,
    "curved": _curved,
    "return": _return,
    "knob": _knob,
}


def _face_plates(
    h: LeverSet, metal: Stock, dark: Stock
) -> list[tuple[Solid, tuple[Solid, ...], Stock]]:
    """Plates of one side with what is in them: solid, contact, stock."""
    neck = cylinder(NECK + PLAY, 0.02, axis="y", segments=20).at(0.0, -0.015, 0.0)
    rows: list[tuple[Solid, tuple[Solid, ...], Stock]] = []
    if h.plate == "backplate":
        low, high = (-0.165, 0.062) if h.lock != "none" else (-0.075, 0.075)
        outline = rounded_rectangle(high - low, 0.042, 0.010, segments=4)
        plate = _sheet(outline).at(0.0, 0.0, (low + high) / 2.0)
        contact = slab((-0.021, -PLATE, low), (0.021, 0.0, high))
        rows.append((plate - neck, (contact,), metal))
        screws = [_screw(z) for z in (low + 0.014, high - 0.014)]
        rows.append((union(screws), (), metal))
    else:
        rows.append((_rose(h.plate) - neck, (_rose_box(h.plate),), metal))
        if h.lock != "none":
            rows.append((_rose(h.plate).at(z=-TO_KEY), (_rose_box(h.plate).at(z=-TO_KEY),), metal))
    return rows + [(solid.at(z=-TO_KEY), (), stock) for solid, stock in _lock(h, metal, dark)]


def _sheet(outline: Floats) -> Solid:
    """An outline in (z, x) as a plate on the face."""
    return upright(prism(outline, PLATE), "y").at(0.0, -PLATE, 0.0)


def _rose(plate: Plate) -> Solid:
    side = 2.0 * ROSE
    square = plate == "square_rose"
    return _sheet(rounded_rectangle(side, side, 0.003) if square else circle(ROSE, segments=28))


def _rose_box(plate: Plate) -> Solid:
    half = ROSE if plate == "square_rose" else 0.8 * ROSE
    return slab((-half, -PLATE, -half), (half, 0.0, half))


def _screw(z: float) -> Solid:
    slot = box((0.0012, 0.004, 0.02)).at(0.0, -PLATE - 0.0014, z - 0.01)
    return cylinder(0.0042, 0.003, axis="y", segments=14).at(0.0, -PLATE - 0.0010, z) - slot


def _lock(h: LeverSet, metal: Stock, dark: Stock) -> list[tuple[Solid, Stock]]:
    """A keyhole, a profile cylinder or a thumb turn, 72 mm below the spindle."""
    if h.lock == "none":
        return []
    top = -PLATE
    if h.lock == "keyhole":
        hole = cylinder(0.0042, 0.001, axis="y", segments=14).at(0.0, top - 0.0003, 0.002)
        foot = slab((-0.0022, top - 0.0003, -0.012), (0.0022, top + 0.0007, 0.002))
        return [(hole | foot, dark)]
    if h.lock == "thumb_turn":
        stem = cylinder(0.009, 0.008, axis="y", segments=20).at(0.0, top - 0.006, 0.0)
        wing = slab((-0.003, top - 0.018, -0.016), (0.003, top - 0.005, 0.016))
        return [(stem | wing, metal)]
    plug = cylinder(0.0085, 0.005, axis="y", segments=20).at(0.0, top - 0.003, 0.003)
    body = slab((-0.005, top - 0.003, -0.018), (0.005, top + 0.002, 0.003))
    slit = slab((-0.0008, top - 0.0033, -0.001), (0.0008, top - 0.002, 0.008))
    return [(plug | body, metal), (slit, dark)]
