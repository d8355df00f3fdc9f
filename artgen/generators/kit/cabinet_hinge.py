"""Hinges of cabinet doors: concealed cup hinges and butt hinges with a visible knuckle."""

import math
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.geometry.solid import Solid, cylinder, slab, union

KNUCKLE = 0.004
"""Radius of a butt hinge's knuckle, m."""
AXIS_AHEAD = KNUCKLE + 0.001
"""How far a butt hinge's axis lies before the door's face, m."""
BUTT = 0.066
"""Height of a butt hinge, m."""


@dataclass(frozen=True, kw_only=True)
class Hinges:
    """Bodies that go to the door, to the base, and those cut out of the door's bodies by order."""

    door: tuple[Body, ...]
    base: tuple[Body, ...]


def hinge_heights(low: float, high: float, *, taken: tuple[float, ...]) -> tuple[float, ...]:
    """z of the hinges of a door: two, and one more for each 0.45 m over 0.9 m; away from shelves.

    Args:
        low: z of the door's lower edge, m.
        high: z of its upper edge.
        taken: z of the shelves behind it.
    """
    count = 2 + max(0, math.ceil((high - low - 0.9) / 0.45))
    inset = min(0.1, 0.22 * (high - low))
    step = (high - low - 2.0 * inset) / (count - 1)
    return tuple(_clear_of(low + inset + k * step, taken) for k in range(count))


def _clear_of(z: float, taken: tuple[float, ...]) -> float:
    near = min(taken, key=lambda shelf: abs(shelf - z), default=math.inf)
    if abs(near - z) >= 0.045:
        return z
    return near + math.copysign(0.045, z - near)


def cup_hinge(
    *, edge: float, jamb: float, sign: float, back: float, face: float, z: float, stock: Stock
) -> Hinges:
    """A concealed hinge: rim of the cup and root on the door, plate and arm on the board beside.

    Args:
        edge: x of the door's hinge edge, m.
        jamb: x of the board's face that carries the plate.
        sign: +1 when the door extends along +x from its hinge, -1 otherwise.
        back: y of the door's rear.
        face: y of the carcass's front.
        z: height of the hinge.
        stock: metal.
    """
    rim = cylinder(0.0175, 0.0006, axis="y", segments=20).at(edge + sign * 0.0225, back, z)
    root = _block(jamb + sign * 0.0025, jamb + sign * 0.0125, back, back + 0.004, z, 0.007)
    plate = _block(jamb, jamb + sign * 0.0025, face + 0.022, face + 0.066, z, 0.016)
    arm = _block(jamb + sign * 0.0025, jamb + sign * 0.0115, face + 0.006, face + 0.074, z, 0.0065)
    return Hinges(door=(stock.piece(rim | root),), base=(stock.piece(plate | arm),))


def _block(x0: float, x1: float, y0: float, y1: float, z: float, half: float) -> Solid:
    return slab((min(x0, x1), y0, z - half), (max(x0, x1), y1, z + half))


def butt_hinge(
    *, jamb: float, gap: float, sign: float, face: float, z: float, stock: Stock
) -> Hinges:
    """Two leaves between door and jamb, and a knuckle of three before the face.

    Args:
        jamb: x of the jamb beside the door, m.
        gap: between jamb and door, at least 2 mm.
        sign: +1 when the door extends along +x from its hinge, -1 otherwise.
        face: y of the door's and the jamb's front.
        z: height of the hinge's middle.
        stock: metal.
    """
    axis_x, axis_y = jamb + sign * gap / 2.0, face - AXIS_AHEAD
    third, play = BUTT / 3.0, 0.0011
    low = z - BUTT / 2.0

    def knuckle(k: int) -> Solid:
        bottom, top = low + k * third + (play if k else 0.0), low + (k + 1) * third
        return cylinder(KNUCKLE, top - bottom, segments=12).at(axis_x, axis_y, bottom)

    def leaf(x0: float, x1: float, lows: tuple[int, ...]) -> Solid:
        plate = _block(x0, x1, face + 0.0005, face + 0.016, z, BUTT / 2.0)
        tails = [
            slab(
                (min(x0, x1), axis_y, low + k * third + (play if k else 0.0)),
                (max(x0, x1), face + 0.001, low + (k + 1) * third),
            )
            for k in lows
        ]
        return union([plate, *tails])

    door = leaf(jamb + sign * (gap / 2.0 + 0.0005), jamb + sign * gap, (1,))
    frame = leaf(jamb, jamb + sign * (gap / 2.0 - 0.0005), (0, 2))
    return Hinges(
        door=(stock.piece(union([door, knuckle(1)])),),
        base=(stock.piece(union([frame, knuckle(0), knuckle(2)])),),
    )
