"""Sheet-metal cabinets of floor-standing appliances: shell, toe recess, kick plate, feet, top."""

from dataclasses import dataclass

from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, prism, slab, union

SHEET = 0.003
"""m; thickness of the sheet as drawn; its density is scaled to the real one."""


@dataclass(frozen=True, kw_only=True)
class Cabinet:
    """An open-fronted cabinet from y = 0 backwards.

    Attributes:
        half_width: outside, m.
        depth: y of its back.
        foot: z where the shell begins.
        top: z of its upper side, worktop excluded.
        toe_height: z below which the front recedes.
        toe_depth: y of the receding front.
    """

    half_width: float
    depth: float
    foot: float
    top: float
    toe_height: float
    toe_depth: float


def shell(cabinet: Cabinet) -> Solid:
    """Side, top and rear sheets with the toe recess cut out of the sides."""
    c = cabinet
    low, high = (-c.half_width, 0.0, c.foot), (c.half_width, c.depth, c.top)
    inside = slab(
        (-c.half_width + SHEET, -0.01, c.foot - 0.01),
        (c.half_width - SHEET, c.depth - SHEET, c.top - SHEET),
    )
    toe = slab((-1.0, -0.01, c.foot - 0.01), (1.0, c.toe_depth, c.toe_height))
    return slab(low, high) - inside - toe


def chassis(cabinet: Cabinet, *, top: float) -> Solid:
    """The closed block of pump, motor, softener and ballast between shell sides, up to `top`."""
    c = cabinet
    return slab(
        (-c.half_width + SHEET, c.toe_depth, c.foot + 0.004),
        (c.half_width - SHEET, c.depth - SHEET, top),
    )


def kick_plate(cabinet: Cabinet, *, thickness: float, slots: int) -> Solid:
    """The plate that closes the toe recess, with slots for air."""
    c = cabinet
    low, high = c.foot + 0.006, c.toe_height - 0.003
    plate = slab(
        (-c.half_width + 0.004, c.toe_depth - thickness, low),
        (c.half_width - 0.004, c.toe_depth, high),
    )
    pitch, middle = 0.030, 0.5 * (low + high)
    cuts = [
        slab(
            (x - 0.011, c.toe_depth - thickness - 0.01, middle - 0.003),
            (x + 0.011, c.toe_depth + 0.01, middle + 0.003),
        )
        for x in (pitch * (k - (slots - 1) / 2.0) for k in range(slots))
    ]
    return plate - union(cuts) if cuts else plate


def feet(cabinet: Cabinet, *, radius: float) -> list[Solid]:
    """Four screw feet with their threaded stems, from the floor to the chassis."""
    c = cabinet
    x, front, back = c.half_width - 0.045, c.toe_depth + 0.045, c.depth - 0.05
    pad = 0.35 * c.foot
    return [
        union(
            [
                cylinder(radius, pad, segments=12).at(u, v),
                cylinder(0.4 * radius, c.foot + 0.004 - pad, segments=6).at(u, v, pad),
            ]
        )
        for u in (-x, x)
        for v in (front, back)
    ]


def worktop(*, half_width: float, front: float, back: float, bottom: float, top: float) -> Solid:
    """A board with rounded front corners."""
    outline = rounded_rectangle(
        2.0 * half_width, back - front, (0.012, 0.012, 0.004, 0.004), segments=3
    )
    return prism(outline, top - bottom).at(0.0, (front + back) / 2.0, bottom)


def cabinet_collision(
    cabinet: Cabinet,
    *,
    cavity_half_width: float,
    cavity_depth: float,
    floor: float,
    ceiling: float,
    foot_radius: float,
) -> tuple[Solid, ...]:
    """Boxes of walls, floor, ceiling, rear and feet around an open cavity."""
    c, x = cabinet, cabinet.half_width
    legs = [
        box((2 * foot_radius, 2 * foot_radius, c.foot), at=(u, v, 0.0))
        for u in (-x + 0.045, x - 0.045)
        for v in (c.toe_depth + 0.045, c.depth - 0.05)
    ]
    return (
        slab((-x, c.toe_depth, c.foot), (x, c.depth, c.toe_height)),
        slab((-x, 0.0, c.toe_height), (x, c.depth, floor)),
        slab((-x, 0.0, floor), (-cavity_half_width, cavity_depth, ceiling)),
        slab((cavity_half_width, 0.0, floor), (x, cavity_depth, ceiling)),
        slab((-x, cavity_depth, floor), (x, c.depth, ceiling)),
        slab((-x, 0.0, ceiling), (x, c.depth, c.top)),
        *legs,
    )
