"""Where to look from: cameras on an orbit around the front, near enough to fill the image."""

import math

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.core.stream import Stream

GOLDEN = 0.6180339887498949
"""Multiples of it, modulo 1, fill an interval evenly however many are taken."""
SIDE = math.radians(75.0)
"""Azimuth to either side of the front within which most views lie."""
FIRST = (0.12, 0.32)
"""Where the first view stands, as a share of the whole range off its middle: 18 to 48 degrees."""
JITTER = math.radians(8.0)
BACK_CHANCE = 0.1
"""Share of views, after the first, that look from behind."""
ELEVATION = (math.radians(6.0), math.radians(42.0))
FOV = (math.radians(26.0), math.radians(48.0))
"""Across the image: a 75 mm to 40 mm lens on a square of 35 mm film's height."""
FILL = (0.84, 0.94)


def orbit_cameras(
    points: Floats, stream: Stream, *, views: int, size: tuple[int, int]
) -> tuple[Camera, ...]:
    """`views` cameras that all see (N, 3) `points`; view v depends on its own number alone.

    The first is a three-quarter view from either side; azimuths then step by the golden section, so
    that few views already lie apart, and more views leave the earlier ones as they are.
    """
    side, turn = stream.child("azimuth").generator().random(2)
    start = 0.5 + (1.0 if side < 0.5 else -1.0) * _between(FIRST, turn)
    return tuple(
        _orbit_camera(points, stream.child("view", v), place=(start + v * GOLDEN) % 1.0, size=size)
        for v in range(views)
    )


def _orbit_camera(points: Floats, stream: Stream, *, place: float, size: tuple[int, int]) -> Camera:
    behind, jitter, height, width, fill = stream.generator().random(5)
    azimuth = SIDE * (2.0 * place - 1.0) + JITTER * (2.0 * jitter - 1.0)
    if behind < BACK_CHANCE and stream.path[-1] != "0":
        azimuth += math.pi
    return framed(
        points,
        direction=orbit_direction(azimuth, _between(ELEVATION, height)),
        fov=_between(FOV, width),
        size=size,
        fill=_between(FILL, fill),
    )


def _between(bounds: tuple[float, float], share: float) -> float:
    return bounds[0] + float(share) * (bounds[1] - bounds[0])
