"""From where to look: directions by scheme; view v depends on its own number alone.

Every scheme is a sequence that is spread evenly however many views are taken, so more views fill
the gaps between the earlier ones and leave those as they are.
"""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from artgen.core.camera import orbit_direction
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from renders.settings import MOST_VIEWS, CameraScheme

Direction = tuple[float, float]
"""(azimuth, elevation) of the eye seen from the object, rad; azimuth 0 is the front (-y) and grows
towards +x."""

GOLDEN = 0.6180339887498949
"""Multiples of it, modulo 1, fill an interval evenly however many are taken."""
SIDE = math.radians(75.0)
"""Azimuth to either side of the front within which most views of an orbit lie."""
FIRST = (0.12, 0.32)
"""Where the first view stands, as a share of the whole range off its middle: 18 to 48 degrees."""
JITTER = math.radians(8.0)
BACK_CHANCE = 0.1
"""Share of an orbit's views, after the first, that look from behind."""
ELEVATION = (math.radians(6.0), math.radians(42.0))
LOWEST = math.radians(-20.0)
"""Of a sphere of views: lower, one sees little but undersides, which nobody photographs."""
LOWEST_OVER_GROUND = math.radians(4.0)
"""With a floor, which hides what is above it from an eye below."""


def directions(
    scheme: CameraScheme, stream: Stream, *, views: int, ground: bool
) -> Sequence[Direction]:
    """Where the eyes stand.

    Args:
        stream: of all the asset's cameras.
        views: how many, at most `MOST_VIEWS`.
        ground: there is a floor, so eyes stay above it.
    """
    return SCHEMES[scheme](stream, views, LOWEST_OVER_GROUND if ground else LOWEST)


def orbit(stream: Stream, views: int, _: float) -> Sequence[Direction]:
    """Around the front, the first a three-quarter view, azimuths stepping by the golden section."""
    side, turn = stream.child("azimuth").generator().random(2)
    start = 0.5 + (1.0 if side < 0.5 else -1.0) * between(FIRST, turn)
    return [_on_orbit(stream.child("view", v), (start + v * GOLDEN) % 1.0) for v in range(views)]


def _on_orbit(stream: Stream, place: float) -> Direction:
    behind, jitter, height = stream.generator().random(3)
    azimuth = SIDE * (2.0 * place - 1.0) + JITTER * (2.0 * jitter - 1.0)
    if behind < BACK_CHANCE and stream.path[-1] != "0":
        azimuth += math.pi
    return azimuth, between(ELEVATION, height)


def ring(stream: Stream, views: int, _: float) -> Sequence[Direction]:
    """All around at even azimuths: exactly even for 1, 2, 4, 8 ... views, in between with gaps of
    one to two; elevations are drawn."""
    start = stream.child("azimuth").generator().random()
    heights = [stream.child("view", v).generator().random() for v in range(views)]
    return [
        (math.tau * (start + halving(v)), between(ELEVATION, height))
        for v, height in enumerate(heights)
    ]


def sphere(stream: Stream, views: int, lowest: float) -> Sequence[Direction]:
    """All around, evenly by area, from `lowest` to straight above; the asset draws the start."""
    start, turn = stream.child("azimuth").generator().random(2)
    return [
        (azimuth + math.tau * turn, elevation)
        for azimuth, elevation in farthest_first(
            fibonacci(math.tau, lowest), start=float(start), count=views
        )
    ]


def hemisphere(stream: Stream, views: int, lowest: float) -> Sequence[Direction]:
    """The front half of a sphere of views."""
    start = stream.child("azimuth").generator().random()
    return farthest_first(fibonacci(math.pi, lowest), start=float(start), count=views)


SCHEMES: Mapping[CameraScheme, Callable[[Stream, int, float], Sequence[Direction]]] = {
    "orbit": orbit,
    "ring": ring,
    "sphere": sphere,
    "hemisphere": hemisphere,
}


def halving(number: int) -> float:
    """The number's binary digits mirrored at the point: 0, 1/2, 1/4, 3/4, 1/8 ... (van der
    Corput)."""
    share, step = 0.0, 0.5
    while number:
        share += step * (number & 1)
        number, step = number >> 1, step / 2.0
    return share


def fibonacci(width: float, lowest: float) -> Sequence[Direction]:
    """`MOST_VIEWS` directions of even density by area: heights in even steps above `lowest`,
    azimuths stepping by the golden section over `width` rad about the front."""
    heights = (np.arange(MOST_VIEWS) + 0.5) / MOST_VIEWS
    low = math.sin(lowest)
    return [
        (width * (k * GOLDEN % 1.0 - 0.5), math.asin(low + (1.0 - low) * height))
        for k, height in enumerate(heights)
    ]


def farthest_first(places: Sequence[Direction], *, start: float, count: int) -> Sequence[Direction]:
    """`count` of the places, each the farthest from those before it, the first at share `start` of
    the list.

    A Fibonacci sphere of V points moves all of them for V + 1; picking from one fine sphere leaves
    the earlier ones, at 0.8 to 1.2 of its distance between neighbors (docs/rendering.md).
    """
    units: Floats = np.array([orbit_direction(*place) for place in places])
    picked = [int(start * len(places))]
    nearness = units @ units[picked[0]]
    while len(picked) < count:
        picked.append(int(np.argmin(nearness)))
        nearness = np.maximum(nearness, units @ units[picked[-1]])
    return [places[k] for k in picked]


def between(bounds: tuple[float, float], share: float) -> float:
    """The number at a share of the way from the first bound to the second."""
    return bounds[0] + float(share) * (bounds[1] - bounds[0])
