"""Handles on a shaft that is turned to draw bolts: levers, spoked wheels, T-handles."""

import math
from collections.abc import Callable, Mapping

from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cone, cylinder, prism, revolve, slab, union, upright

SHAFT = 0.006
"""m; radius of the shaft behind the rose."""
STAND = 0.034
"""m; how far handles stand off."""


def turn_handle(style: str, size: float, *, shaft: float) -> tuple[Solid, tuple[Solid, ...]]:
    """(handle around the +z axis on z = 0 with its shaft below, collision pieces).

    Args:
        style: a key of `STYLES`.
        size: reach from the axis, m.
        shaft: its length below z = 0, m.
    """
    solid, touch = STYLES[style](size)
    return union([solid, cylinder(SHAFT, shaft + 0.002, segments=12).at(z=-shaft)]), touch


def rose(radius: float) -> Solid:
    """The turned plate around the shaft, on z = 0, with room for the shaft."""
    hole = SHAFT + 0.0012
    return revolve([(hole, 0.0), (radius, 0.0), (0.92 * radius, 0.004), (hole, 0.005)], segments=28)


def _lever(size: float) -> tuple[Solid, tuple[Solid, ...]]:
    """A hub and an arm along +x."""
    hub = cone(0.013, 0.011, STAND, segments=20)
    section = rounded_rectangle(0.014, 0.020, 0.005, segments=3)
    arm = upright(prism(section, size), "x").at(0.0, 0.0, STAND - 0.007)
    touch = (
        slab((-0.009, -0.009, 0.007), (0.009, 0.009, STAND)),
        slab((0.009, -0.007, STAND - 0.014), (size, 0.007, STAND)),
    )
    return union([hub, arm]), touch


def _wheel(size: float) -> tuple[Solid, tuple[Solid, ...]]:
    """Three spokes with ball ends."""
    hub = cone(0.017, 0.014, STAND, segments=20)
    ball = _ball(0.010)
    spokes, touch = [], [slab((-0.011, -0.011, 0.007), (0.011, 0.011, STAND))]
    for k in range(3):
        angle = math.pi / 2.0 + 2.0 * math.pi * k / 3.0
        rod = cone(0.006, 0.0045, size - 0.004, axis="x", segments=10)
        spoke = union([rod, ball.at(size - 0.004)]).at(z=STAND - 0.010)
        spokes.append(spoke.turned("z", angle))
        reach = slab((0.012, -0.006, STAND - 0.016), (size + 0.005, 0.006, STAND - 0.004))
        touch.append(reach.turned("z", angle))
    return union([hub, *spokes]), tuple(touch)


def _tee(size: float) -> tuple[Solid, tuple[Solid, ...]]:
    """A bar across the axis."""
    hub = cone(0.012, 0.009, STAND, segments=20)
    outline = rounded_rectangle(1.5 * size, 0.018, 0.0085, segments=5)
    bar = prism(outline, 0.014).at(z=STAND - 0.012)
    touch = (
        slab((-0.008, -0.008, 0.007), (0.008, 0.008, STAND - 0.012)),
        slab((-0.72 * size, -0.008, STAND - 0.012), (0.72 * size, 0.008, STAND + 0.002)),
    )
    return union([hub, bar]), touch


def _ball(radius: float) -> Solid:
    angles = [math.pi * (k / 8.0 - 0.5) for k in range(9)]
    outline = [(max(0.0, radius * math.cos(a)), radius * math.sin(a)) for a in angles]
    return revolve(outline, segments=14)


STYLES: Mapping[str, Callable[[float], tuple[Solid, tuple[Solid, ...]]]] = {
    "lever": _lever,
    "wheel": _wheel,
    "tee": _tee,
}
"""Word to handle."""
