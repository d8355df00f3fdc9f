"""Seeded light rigs: a studio that is set up anew for every asset."""

import math

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.render_job import LightRig
from artgen.studio import Softbox, soft_sky, softbox_light

DEGREE = math.pi / 180.0


def studio_rig(stream: Stream, *, center: Floats, radius: float) -> LightRig:
    """Key from one side, weaker and lower fill from the other, which reaches into open fronts, rim
    from behind; a white wall that faces the key shows 0.8 to 1.1."""
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
