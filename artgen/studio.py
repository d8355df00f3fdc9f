"""A photographer's studio: key, fill and rim softboxes around an object, and a soft surrounding."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from artgen.core.camera import orbit_direction
from artgen.core.mesh import Floats
from artgen.render_job import AreaLight, Color, LightRig, Point, Sky


@dataclass(frozen=True, kw_only=True)
class Softbox:
    """A square light by where it stands, in radii of the object, and how bright a wall it makes.

    Attributes:
        azimuth: from the front, towards +x, rad.
        elevation: above the horizon, rad.
        distance: from the object's center to the light's, radii.
        side: radii.
        white: linear radiance of a white wall at the center that faces the light.
        warmth: red over green minus 1; blue over green is 1 minus it.
    """

    azimuth: float
    elevation: float
    distance: float
    side: float
    white: float
    warmth: float = 0.0


def softbox_light(box: Softbox, *, center: Sequence[float] | Floats, radius: float) -> AreaLight:
    """The light itself: a wall at distance d that faces a source of area A and radiance L shows
    L A / (pi d^2), for sizes well below d."""
    middle = np.asarray(center, float)
    toward = orbit_direction(box.azimuth, box.elevation)
    radiance = box.white * math.pi * (box.distance / box.side) ** 2
    return AreaLight(
        position=_point(middle + radius * box.distance * toward),
        target=_point(middle),
        size=(radius * box.side, radius * box.side),
        radiance=tinted(radiance, box.warmth),
    )


def tinted(value: float, warmth: float) -> Color:
    """A gray made warmer (red) or colder (blue)."""
    return value * (1.0 + warmth), value, value * (1.0 - warmth)


def soft_sky(value: float, *, floor: float, warmth: float = 0.0) -> Sky:
    """A surrounding of radiance `value` that is brighter above, and `floor` times that below."""
    return Sky(
        nadir=tinted(floor * value, warmth),
        horizon=tinted(0.8 * value, 0.0),
        zenith=tinted(1.6 * value, -warmth),
    )


def portrait_rig(*, center: Sequence[float] | Floats, radius: float) -> LightRig:
    """The rig of every thumbnail; its bright surrounding is what bare metal shows."""
    boxes = (
        Softbox(
            azimuth=math.radians(-42), elevation=math.radians(46), distance=4, side=2.4, white=0.55
        ),
        Softbox(
            azimuth=math.radians(38), elevation=math.radians(14), distance=4, side=2.6, white=0.30
        ),
        Softbox(
            azimuth=math.radians(165), elevation=math.radians(45), distance=4, side=2.0, white=0.4
        ),
    )
    return LightRig(
        name="portrait",
        lights=tuple(softbox_light(box, center=center, radius=radius) for box in boxes),
        sky=soft_sky(0.45, floor=0.8),
    )


def _point(values: Floats) -> Point:
    x, y, z = (float(v) for v in values)
    return x, y, z
