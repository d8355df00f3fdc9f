"""The lid of a laptop: shell, bezel, lit screen, webcam, bumpers, logo."""

import math

from artgen.articulation.types import Body, Decal, DraftPart
from artgen.generators.kit.density import ALUMINIUM, GLASS, RUBBER
from artgen.generators.laptop_shape import LID_GAP, LaptopShape
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, tube, union

SHELL_DENSITY = 1000.0
"""kg/m3; sheet metal around a display panel and air."""
FACE = 0.0009
"""m; thickness of the bezel."""


def lid_part(s: LaptopShape) -> DraftPart:
    """Everything that turns."""
    bodies = [
        Body(
            solid=_shell(s),
            surface="shell",
            density=SHELL_DENSITY,
            edge=0.0006,
            collision=_collision(s),
        ),
        _bezel(s),
        _screen(s),
        *_details(s),
    ]
    return DraftPart(name="lid", label="lid", bodies=tuple(bodies))


def _shell(s: LaptopShape) -> Solid:
    """A plate with round front corners whose rear edge is a cylinder about the hinge axis."""
    length = s.axis_y + s.half_depth
    radius = s.p.corner_radius
    outline = rounded_rectangle(2 * s.half_width, length, (radius, radius, 0, 0), segments=6)
    plate = prism(outline, s.p.lid_thickness).at(0, s.axis_y - length / 2, s.lid_bottom)
    edge = cylinder(s.barrel, 2 * s.half_width, axis="x", segments=24)
    whole = plate | edge.at(-s.half_width, s.axis_y, s.axis_z)
    return whole - union([s.notch(span) for span in s.hinge_spans])


def _face(
    s: LaptopShape, inset: float, back: float, radius: float, low: float, high: float
) -> Solid:
    """A rounded sheet on the lid's underside from z = low to high above it."""
    front = -s.half_depth + inset
    outline = rounded_rectangle(2 * (s.half_width - inset), back - front, radius, segments=5)
    return prism(outline, high - low).at(0, (front + back) / 2, s.lid_bottom + low)


def _bezel(s: LaptopShape) -> Body:
    radius = max(0.001, s.p.corner_radius - 0.0012)
    sheet = _face(s, 0.0012, s.notch_front - 0.0025, radius, 0.0, FACE)
    return Body(solid=sheet, surface="bezel", density=GLASS)


def _screen(s: LaptopShape) -> Body:
    """The lit panel; its picture stands upright when the lid is open."""
    left, top = -s.half_width + s.p.bezel_side, -s.half_depth + s.p.bezel_top
    bottom = s.notch_front - s.p.bezel_chin
    panel = slab((left, top, s.lid_bottom), (-left, bottom, s.lid_bottom + 0.0005))
    decal = Decal(
        origin=(left, bottom, s.lid_bottom),
        right=(1.0, 0.0, 0.0),
        up=(0.0, -1.0, 0.0),
        size=(-2 * left, bottom - top),
    )
    return Body(solid=panel, surface="screen", density=GLASS, decal=decal)


def screen_size(s: LaptopShape) -> tuple[float, float]:
    """Width and height of the lit panel, m."""
    top, bottom = -s.half_depth + s.p.bezel_top, s.notch_front - s.p.bezel_chin
    return 2 * (s.half_width - s.p.bezel_side), bottom - top


def _details(s: LaptopShape) -> list[Body]:
    bodies = _logo(s)
    y = -s.half_depth + 0.006
    for x in (-s.half_width + 0.010, s.half_width - 0.010):
        dot = cylinder(0.0022, 0.4 * LID_GAP + 0.0003, segments=12)
        place = dot.at(x, y - 0.001, s.lid_bottom - 0.4 * LID_GAP)
        bodies.append(Body(solid=place, surface="rubber", density=RUBBER))
    if s.p.webcam:
        lens = cylinder(0.0013, 0.0004, segments=16).at(
            0, -s.half_depth + 0.0014 + s.p.bezel_top / 2, s.lid_bottom
        )
        bodies.append(Body(solid=lens, surface="metal", density=GLASS))
    return bodies


def _logo(s: LaptopShape) -> list[Body]:
    """An inlay in the middle of the back, flush with it."""
    depth = 0.0003
    size = 0.035 * s.p.width / 0.33
    shapes = {
        "disc": lambda: cylinder(size / 2, depth, segments=32),
        "ring": lambda: tube(size / 2, size / 3, depth, segments=32),
        "bar": lambda: prism(rounded_rectangle(1.6 * size, size / 4, size / 9), depth),
    }
    if s.p.logo not in shapes:
        return []
    inlay = shapes[s.p.logo]().at(0, -0.004, s.lid_top - depth)
    return [Body(solid=inlay, surface="metal", density=ALUMINIUM)]


def _collision(s: LaptopShape) -> tuple[Solid, ...]:
    """The plate up to the notches, and between them what fits inside the rear edge's cylinder."""
    plate = slab(
        (-s.half_width, -s.half_depth, s.lid_bottom), (s.half_width, s.notch_front, s.lid_top)
    )
    inner = s.barrel / math.sqrt(2)
    ends = [
        slab(
            (low + 0.0002, s.notch_front, s.axis_z - inner),
            (high - 0.0002, s.axis_y + inner, s.axis_z + inner),
        )
        for low, high in s.lid_segments()
    ]
    return (plate, *ends)
