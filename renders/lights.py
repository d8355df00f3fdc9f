"""Seeded light rigs, set up anew for every asset: a studio, bare area lights, rooms and skies as
images."""

import math
from collections.abc import Callable, Mapping
from pathlib import Path

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.render_job import LightRig
from artgen.studio import Softbox, soft_sky, softbox_light
from renders.environments import HEIGHT, exposed, written
from renders.skies import Weather, sky_map
from renders.softboxes import Panel, room_map

DEGREE = math.pi / 180.0
WHITE = (0.8, 1.1)
"""What the brightest white wall shows under an image of a surrounding."""

Draw = Callable[[float, float], float]


def light_rig(
    scheme: str, stream: Stream, *, center: Floats, radius: float, folder: Path
) -> LightRig:
    """The light of one asset.

    Args:
        scheme: a `LightScheme` of `renders.settings`.
        center, radius: of what is lit, m.
        folder: receives the image of a surrounding; its name follows from its content.
    """
    if scheme in MAPS:
        rng = stream.generator()
        name, radiance = MAPS[scheme](lambda low, high: float(rng.uniform(low, high)))
        white = float(rng.uniform(*WHITE))
        room = written(exposed(radiance, white), folder)
        return LightRig(name=name, lights=(), sky=room.sky, environment=room.environment)
    rig = area_rig if scheme == "area" else studio_rig
    return rig(stream, center=center, radius=radius)


def outdoors(draw: Draw) -> tuple[str, Floats]:
    """A clear sky with the sun before the object, or, one time in four, an overcast one."""
    cloudy = draw(0.0, 1.0) < 0.25
    weather = Weather(
        azimuth=draw(-100, 100) * DEGREE,
        elevation=draw(14, 62) * DEGREE,
        turbidity=draw(2.2, 6.0),
        overcast=cloudy,
    )
    return ("sky overcast" if cloudy else "sky clear"), sky_map(weather, HEIGHT)


def softbox_room(draw: Draw) -> tuple[str, Floats]:
    """A gray room with a key softbox, a fill on the other side, a strip or a window behind, and
    often a large soft light overhead, which metals mirror."""
    side = -1.0 if draw(0.0, 1.0) < 0.5 else 1.0
    warmth = draw(-0.04, 0.08)
    key = Panel(
        azimuth=side * draw(20, 65) * DEGREE,
        elevation=draw(28, 58) * DEGREE,
        size=(draw(0.6, 1.3), draw(0.6, 1.3)),
        radiance=draw(4.0, 9.0),
        warmth=warmth,
    )
    fill = Panel(
        azimuth=-side * draw(25, 80) * DEGREE,
        elevation=draw(5, 30) * DEGREE,
        size=(draw(0.8, 1.8), draw(0.8, 1.8)),
        radiance=draw(1.2, 3.0),
        warmth=-warmth,
        edge=0.15,
    )
    panes = (3, 2) if draw(0.0, 1.0) < 0.5 else (1, 1)
    back = Panel(
        azimuth=side * draw(130, 215) * DEGREE,
        elevation=draw(15, 45) * DEGREE,
        size=(draw(0.9, 1.6), draw(0.8, 1.2)) if panes != (1, 1) else (0.25, draw(1.0, 2.0)),
        radiance=draw(3.0, 8.0),
        warmth=draw(-0.08, 0.0),
        edge=0.02,
        panes=panes,
    )
    top = Panel(
        azimuth=0.0,
        elevation=draw(70, 86) * DEGREE,
        size=(draw(1.0, 2.2), draw(1.0, 2.2)),
        radiance=draw(0.0, 3.0),
        edge=0.2,
    )
    room = room_map(
        (top, back, fill, key), walls=draw(0.1, 0.45), floor=draw(0.35, 0.8), height=HEIGHT
    )
    return "softboxes", room


MAPS: Mapping[str, Callable[[Draw], tuple[str, Floats]]] = {
    "sky": outdoors,
    "softboxes": softbox_room,
}
"""Schemes whose surrounding is an image: name of the rig, and (H, 2 H, 3) radiance."""


def area_rig(stream: Stream, *, center: Floats, radius: float) -> LightRig:
    """Two to four softboxes of any size in a dim room, one of them before the object; harder
    shadows than the studio's. The brightest upright or level white wall shows 0.63 to 1.6, 1.03 in
    the median (300 seeds)."""
    rng = stream.generator()

    def draw(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    boxes = [
        Softbox(
            azimuth=(draw(-70, 70) if k == 0 else draw(-180, 180)) * DEGREE,
            elevation=draw(15, 70) * DEGREE,
            distance=draw(3.0, 6.0),
            side=draw(0.4, 2.0),
            white=draw(0.7, 0.9) if k == 0 else draw(0.1, 0.5),
            warmth=draw(-0.08, 0.12),
        )
        for k in range(int(rng.integers(2, 5)))
    ]
    lights = tuple(softbox_light(box, center=center, radius=radius) for box in boxes)
    return LightRig(name="area", lights=lights, sky=soft_sky(draw(0.05, 0.12), floor=0.6))


def studio_rig(stream: Stream, *, center: Floats, radius: float) -> LightRig:
    """Key from one side, weaker and lower fill from the other, which reaches into open fronts, rim
    from behind. The brightest upright or level white wall shows 0.81 to 1.45, 1.12 in the median
    (300 seeds)."""
    rng = stream.generator()
    side = -1.0 if rng.random() < 0.5 else 1.0

    def draw(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    warmth = draw(-0.05, 0.08)
    key = Softbox(
        azimuth=side * draw(22, 65) * DEGREE,
        elevation=draw(32, 62) * DEGREE,
        distance=draw(3.5, 5.0),
        side=draw(1.4, 3.0),
        white=draw(0.5, 0.72),
        warmth=warmth,
    )
    fill = Softbox(
        azimuth=-side * draw(12, 65) * DEGREE,
        elevation=draw(5, 30) * DEGREE,
        distance=draw(3.5, 5.0),
        side=draw(2.0, 3.4),
        white=draw(0.2, 0.4),
        warmth=-warmth,
    )
    rim = Softbox(
        azimuth=side * draw(140, 215) * DEGREE,
        elevation=draw(35, 65) * DEGREE,
        distance=draw(3.5, 5.0),
        side=draw(1.2, 2.4),
        white=draw(0.2, 0.5),
    )
    sky = soft_sky(draw(0.22, 0.36), floor=draw(0.35, 0.7), warmth=draw(0.0, 0.06))
    boxes = (key, fill, rim)
    lights = tuple(softbox_light(box, center=center, radius=radius) for box in boxes)
    return LightRig(name="studio", lights=lights, sky=sky)
