"""What furniture stands on: plinths, legs, frames, hairpins."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import circle
from artgen.geometry.solid import Solid, box, cylinder, hull, slab, union, wire

TUBE_FILL = 0.29
"""Share of steel in the section of a square tube 25 mm wide with walls of 2 mm."""


@dataclass(frozen=True, kw_only=True)
class Stand:
    """The room under a body: x from -width / 2, y from front to back, z from 0 to height, m.

    Attributes:
        inset: of legs from the body's edges; of a plinth's face from the body's front.
        splay: how far a leg's foot lies outside its head.
        girth: of legs: diameter or side at the head.
    """

    width: float
    front: float
    back: float
    height: float
    inset: float
    splay: float
    girth: float

    def lean(self, wanted: float, foot: float) -> float:
        """How far a foot of radius `foot` may lie outside its head and stay under the body."""
        return min(wanted, self.inset - foot)

    @property
    def corners(self) -> list[tuple[float, float, float, float]]:
        """(x, y, outwards x, outwards y) of the four legs, and of two more under long bodies."""
        x, front, back = (
            self.width / 2.0 - self.inset,
            self.front + self.inset,
            self.back - self.inset,
        )
        ends = [(sx * x, y, sx, sy) for sx in (-1.0, 1.0) for y, sy in ((front, -1.0), (back, 1.0))]
        middle = [(0.0, front, 0.0, -1.0), (0.0, back, 0.0, 1.0)]
        return ends + (middle if self.width > 1.65 else [])


def plinth(s: Stand, wood: Stock, metal: Stock) -> tuple[Body, ...]:
    """A frame of boards, set back in front for the toes and flush at the sides."""
    t, x, front = 0.018, s.width / 2.0, s.front + s.inset
    back = s.back - 0.012
    return (
        wood.board((-x + 0.002, front, 0.0), (x - 0.002, front + t, s.height), grain="x"),
        wood.board((-x + 0.002, back - t, 0.0), (x - 0.002, back, s.height), grain="x"),
        wood.board((-x + 0.002, front + t, 0.0), (-x + 0.002 + t, back - t, s.height), grain="y"),
        wood.board((x - 0.002 - t, front + t, 0.0), (x - 0.002, back - t, s.height), grain="y"),
    )


def round_legs(s: Stand, wood: Stock, metal: Stock) -> tuple[Body, ...]:
    """Turned legs that taper to the foot and lean outwards, on round mounting plates."""
    bodies: list[Body] = []
    head, foot, plate = s.girth / 2.0, 0.56 * s.girth / 2.0, 0.003
    lean = s.lean(s.splay, foot)
    for x, y, ox, oy in s.corners:
        rings = [
            _ring(x, y, s.height - plate, head),
            _ring(x + ox * lean, y + oy * lean, 0.0, foot),
        ]
        bodies += _leg(hull(np.concatenate(rings)), wood)
        bodies.append(
            metal.piece(cylinder(1.35 * head, plate, segments=16).at(x, y, s.height - plate))
        )
    return tuple(bodies)


def _ring(x: float, y: float, z: float, radius: float) -> Floats:
    """(14, 3) points of a level circle."""
    around = circle(radius, segments=14)
    return np.stack([around[:, 0] + x, around[:, 1] + y, np.full(14, z)], axis=1)


def square_legs(s: Stand, wood: Stock, metal: Stock) -> tuple[Body, ...]:
    """Legs of square section, flush with the corners, their inner faces tapered, under an apron."""
    bodies: list[Body] = []
    head, foot, apron = s.girth, 0.62 * s.girth, min(0.045, 0.3 * s.height)
    x, front, back = s.width / 2.0, s.front + 0.004, s.back
    for sx in (-1.0, 1.0):
        for y, sy in ((front, 1.0), (back, -1.0)):
            points = [
                (sx * (x - dx * side), y + sy * dy * side, z)
                for side, z in ((foot, 0.0), (head, s.height - apron), (head, s.height))
                for dx in (0.0, 1.0)
                for dy in (0.0, 1.0)
            ]
            bodies += _leg(hull(points), wood)
        sides = sorted((sx * (x - 0.006), sx * (x - 0.024)))
        bodies.append(
            wood.board(
                (sides[0], front + head, s.height - apron), (sides[1], back - head, s.height)
            )
        )
    for y in (front + 0.006, back - 0.024):
        bodies.append(wood.board((-x + head, y, s.height - apron), (x - head, y + 0.018, s.height)))
    return tuple(bodies)


def _leg(solid: Solid, stock: Stock) -> list[Body]:
    """A leg that is touched as the box around its middle third, so that no hull file is needed."""
    lower, upper = solid.bounds
    middle, half = (lower + upper) / 2.0, (upper - lower) / 2.0
    contact = box((*(1.4 * half[:2]), upper[2] - lower[2]), at=(*middle[:2], lower[2]))
    return [stock.piece(solid, contact=(contact,), grain="z")]


def metal_frame(s: Stand, wood: Stock, metal: Stock) -> tuple[Body, ...]:
    """Two closed loops of square tube at the ends, joined by two bars under the body."""
    t = min(0.8 * s.girth, 0.025)
    x, front, back = s.width / 2.0 - s.inset, s.front + 0.02, s.back - 0.02
    top = s.height - t
    pieces = []
    for side in (-x, x - t):
        pieces += [
            slab((side, front, 0.0), (side + t, back, t)),
            slab((side, front, top), (side + t, back, s.height)),
            slab((side, front, t), (side + t, front + t, top)),
            slab((side, back - t, t), (side + t, back, top)),
        ]
    for y in (front + 0.25 * (back - front), back - 0.25 * (back - front) - t):
        pieces.append(slab((-x + t, y, top), (x - t, y + t, s.height)))
    hollow = Stock(surface=metal.surface, density=TUBE_FILL * metal.density, edge=metal.edge)
    return (hollow.piece(union(pieces), contact=tuple(pieces)),)


def hairpins(s: Stand, wood: Stock, metal: Stock) -> tuple[Body, ...]:
    """Three-rod legs bent from round steel, welded to square plates."""
    bodies: list[Body] = []
    rod, plate, spread = 0.005, 0.004, 0.06
    top, lean = s.height - plate, s.lean(s.splay + 0.02, 3.0 * rod)
    for x, y, ox, oy in s.corners:
        foot = np.array([x + ox * lean, y + oy * lean, 1.1 * rod])
        heads = np.array(
            [(x - ox * spread, y, top), (x, y - oy * spread, top)]
            if ox
            else [(x - 0.7 * spread, y, top), (x + 0.7 * spread, y, top)]
        )
        low, high = heads.min(axis=0)[:2] - 0.012, heads.max(axis=0)[:2] + 0.012
        rods = wire(_hairpin(heads[0], foot, heads[1]), rod, sides=8)
        below = slab((-5.0, -5.0, -1.0), (5.0, 5.0, top))
        middle = (heads.mean(axis=0) + foot)[:2] / 2.0
        contact = slab((*(middle - 0.012), 0.0), (*(middle + 0.012), top))
        plates = slab((*low, top), (*high, s.height))
        bodies += [metal.piece(rods & below, contact=(contact,)), metal.piece(plates)]
    return tuple(bodies)


def _hairpin(head: Floats, foot: Floats, tail: Floats) -> Floats:
    """(N, 3) path down to a round bend at the foot and up again; its ends lie 2 mm high."""
    across, up = (tail - head) / np.linalg.norm(tail - head), np.array([0.0, 0.0, 1.0])
    bend = 0.009
    angles = np.linspace(0.0, math.pi, 7)[:, None]
    turn = foot + bend * ((1.0 - np.sin(angles)) * up - np.cos(angles) * across)
    return np.concatenate([[head + 0.002 * up], turn, [tail + 0.002 * up]])


STANDS: Mapping[str, Callable[[Stand, Stock, Stock], tuple[Body, ...]]] = {
    "plinth": plinth,
    "round_legs": round_legs,
    "square_legs": square_legs,
    "frame": metal_frame,
    "hairpin": hairpins,
}
