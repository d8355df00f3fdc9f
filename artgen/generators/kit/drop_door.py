"""Doors that fall open about a pin near their lower edge: dishwashers, ovens."""

from dataclasses import dataclass

import numpy as np

from artgen.geometry.profile import arc, rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, hull, prism, slab, union, upright

EAR = 0.005
"""m; thickness of a hinge ear."""
EAR_RADIUS = 0.0075
PIN_RADIUS = 0.003
PIN_PLAY = 0.001
NOTCH = 0.0095
"""m; how far about the pin the door leaves room for an ear."""


@dataclass(frozen=True, kw_only=True)
class DropDoor:
    """A closed door in front of the plane y = 0; the pin runs along x.

    Attributes:
        half_width: m.
        inner: y of the inner face (< 0).
        outer: y of the outer face.
        skin: thickness of the outer panel.
        bottom: z of the inner body's lower edge.
        skin_bottom: z of the outer panel's lower edge.
        top: z.
        pivot: (y, z) of the pin.
    """

    half_width: float
    inner: float
    outer: float
    skin: float
    bottom: float
    skin_bottom: float
    top: float
    pivot: tuple[float, float]

    @property
    def seam(self) -> float:
        """y of the plane between outer panel and inner body."""
        return self.outer + self.skin

    @property
    def ears(self) -> tuple[float, float]:
        """x of the middle of each hinge ear."""
        x = self.half_width - 0.024
        return -x, x


def inner_body(
    door: DropDoor,
    *,
    top: float,
    dish: tuple[float, float, float],
    depth: float,
    narrowed: float,
) -> Solid:
    """The liner: flat border for seal and wheels, dished inside, notched for the hinge ears.

    Args:
        top: z of its upper edge.
        dish: half width, lower and upper z of the dish, m.
        depth: of the dish.
        narrowed: what each side leaves to the outer panel's returns.
    """
    reach = door.half_width - narrowed
    block = slab((-reach, door.seam, door.bottom), (reach, door.inner, top))
    half, low, high = dish
    return block - _dish(door, half, low, high, depth) - notches(door)


def wrapped_panel(
    door: DropDoor, *, top: float, returns: float, sheet: float, edge: float
) -> Solid:
    """The outer panel of formed sheet up to `top`; its sides return over the inner body, up to
    z = `returns` and to `edge` m before the inner face."""
    panel = slab(
        (-door.half_width, door.outer, door.skin_bottom), (door.half_width, door.seam, top)
    )
    side = slab(
        (door.half_width - sheet, door.seam, door.bottom),
        (door.half_width, door.inner - edge, returns),
    )
    return union([panel, side, side.mirrored("x")])


def _dish(door: DropDoor, half: float, low: float, high: float, depth: float) -> Solid:
    """A rounded pan with sloping sides, open at the inner face."""
    middle = np.array([(low + high) / 2.0, 0.0])
    mouth = rounded_rectangle(high - low, 2 * half, 0.030, segments=4) + middle
    ground = rounded_rectangle(high - low - 0.014, 2 * half - 0.014, 0.024, segments=4) + middle
    levels = ((mouth, door.inner + 0.001), (ground, door.inner - depth))
    return hull([(x, y, z) for outline, y in levels for z, x in outline])


def notches(door: DropDoor) -> Solid:
    """Room for both ears at every angle: they come in from behind and turn downwards."""
    y, z = door.pivot
    half = (EAR + 0.004) / 2.0
    low, high = (y - NOTCH, door.bottom - 0.01), (door.inner + 0.01, z + NOTCH)
    return union([slab((x - half, *low), (x + half, *high)) for x in door.ears])


def pins(door: DropDoor) -> list[Solid]:
    """One pin across each notch."""
    y, z = door.pivot
    width = EAR + 0.004
    pin = cylinder(PIN_RADIUS, width, axis="x", segments=12)
    return [pin.at(x - width / 2.0, y, z) for x in door.ears]


def hinge_ears(door: DropDoor, *, back: float) -> list[Solid]:
    """Ears of the cabinet, from y = `back` forward around the pins."""
    y, z = door.pivot
    nose = arc((y, z), EAR_RADIUS, np.pi / 2.0, 1.5 * np.pi, 8)
    outline = np.concatenate([nose, [(back, z - EAR_RADIUS), (back, z + EAR_RADIUS)]])
    bore = arc((y, z), PIN_RADIUS + PIN_PLAY, 0.0, 2.0 * np.pi, 12)[:-1]
    ear = upright(prism(outline, EAR, holes=[bore]), "x")
    return [ear.at(x=x - EAR / 2.0) for x in door.ears]


def detergent_dispenser(*, y: float, x: float, z: float, depth: float) -> tuple[Solid, ...]:
    """Tray, sliding lid, latch and rinse-aid cap on the dish of a door, flush with its inner face.

    Args:
        y: of the dish's ground.
        x: of the tray's middle.
        z: of the tray's middle.
        depth: from the ground to the inner face.
    """
    tray = upright(prism(rounded_rectangle(0.100, 0.168, 0.012, segments=3), 0.55 * depth), "y")
    lid = upright(prism(rounded_rectangle(0.074, 0.088, 0.008, segments=3), 0.30 * depth), "y")
    latch = slab((-0.010, 0.0, -0.006), (0.010, 0.12 * depth, 0.006))
    cap = cylinder(0.023, 0.26 * depth, axis="y", segments=20)
    bar = slab((-0.017, 0.0, -0.003), (0.017, 0.14 * depth, 0.003))
    level = y + 0.55 * depth
    return (
        tray.at(x, y, z),
        lid.at(x - 0.032, level, z),
        latch.at(x - 0.032, level + 0.30 * depth, z + 0.022),
        cap.at(x + 0.050, level, z),
        bar.at(x + 0.050, level + 0.26 * depth, z),
    )
