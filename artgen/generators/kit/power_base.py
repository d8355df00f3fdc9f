"""The power base of a cordless kettle: a disc with its connector, a cord and rubber feet."""

import math

from artgen.articulation.types import Body
from artgen.generators.kit.cord import cord_stub
from artgen.generators.kit.density import ABS, RUBBER
from artgen.generators.kit.round_contact import round_boxes
from artgen.geometry.solid import cylinder, revolve, slab, union

SOCKET = 0.0225
"""m; inner radius of the ring under a jug that takes the connector."""


def power_base(
    *, radius: float, foot: float, height: float, seat: float, surface: str, metal: str, rubber: str
) -> tuple[Body, ...]:
    """A disc from z = `foot` to `foot + height` whose middle carries the connector.

    Args:
        seat: radius of the jug's skirt; a shallow ring around it keeps the jug from sliding.
    """
    top, edge = foot + height, min(0.008, 0.4 * height)
    ring = min(seat + 0.0022, radius - 0.004)
    outline = [
        (0.0, foot), (radius - 0.004, foot), (radius, foot + 0.004), (radius, top - edge),
        (radius - 0.35 * (radius - ring), top - 0.3 * edge), (ring + 0.0012, top + 0.0012),
        (ring, top), (0.0, top),
    ]  # fmt: skip
    boss = revolve(
        [(0.0, top - 0.002), (0.0195, top - 0.002), (0.0195, top + 0.006), (0.0165, top + 0.0085),
         (0.0, top + 0.0085)], segments=28,
    )  # fmt: skip
    pin = revolve(
        [(0.0030, top), (0.0125, top), (0.0125, top + 0.0105), (0.0115, top + 0.0115),
         (0.0030, top + 0.0115)], segments=24,
    )  # fmt: skip
    places = [
        (0.78 * radius * math.cos(a), 0.78 * radius * math.sin(a))
        for a in (math.pi * (0.25 + 0.5 * k) for k in range(4))
    ]
    feet = [cylinder(0.008, foot + 0.001, segments=16).at(x, y) for x, y in places]
    soles = [slab((x - 0.0055, y - 0.0055, 0.0), (x + 0.0055, y + 0.0055, foot)) for x, y in places]
    disc = revolve(outline, segments=56)
    contact = (*round_boxes(radius, foot, top), *round_boxes(0.0195, top, top + 0.008)[2:])
    return (
        Body(solid=union(feet), surface=rubber, density=RUBBER, collision=tuple(soles)),
        Body(solid=disc, surface=surface, density=0.75 * ABS, edge=0.0008, collision=contact),
        Body(solid=boss, surface=surface, density=ABS),
        Body(solid=pin, surface=metal, density=2500.0),
        cord_stub((-radius + 0.003, 0.0, foot + 0.45 * height), out=(-1.0, 0.0, 0.0),
                  surface=rubber, run=0.03),
    )  # fmt: skip
