"""The upper half of a laptop: cover, picture in its bezel, seal, webcam, logo, lid barrels."""

from collections.abc import Callable, Mapping

import numpy as np

from artgen.articulation.types import Body, Decal, DraftPart, Grip
from artgen.core.mesh import Floats
from artgen.generators.kit.density import ABS, ALUMINIUM, GLASS, RUBBER
from artgen.generators.kit.laptop_layout import PLAY, Layout
from artgen.generators.kit.lofted_shell import cover, plan
from artgen.geometry.profile import circle, regular_polygon, rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, union

RIM = 0.0011
"""Wall of the cover around the bezel, m."""
PANEL = 0.0009
"""Thickness of the bezel, m."""
REAR_CORNER = 0.003
BREATH = 0.00015
"""m that seals leave to the closed deck."""


def lid(at: Layout) -> DraftPart:
    """As it lies closed: the picture looks down, its upper edge is at the front."""
    bodies = [_cover(at), *_picture(at), *_seal(at), *_barrels(at), *_ledge(at), _webcam(at)]
    if at.p.logo != "none":
        bodies.append(_logo(at))
    front = Grip(
        name="lid_edge",
        kind="edge",
        position=(0.0, 0.0, (at.lid_z[0] + at.lid_z[1]) / 2.0),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
    return DraftPart(name="lid", label="lid", bodies=tuple(bodies), grips=(front,))


def _cover(at: Layout) -> Body:
    """The outer shell with a recess for the bezel and one for the logo."""
    x, y, (low, high) = at.width / 2.0, (0.0, at.lid_depth), at.lid_z
    radii = (at.p.corner, REAR_CORNER)
    solid = cover(x=x, y=y, z=(low, high), radii=radii, crown=at.crown)
    solid = solid - prism(plan(x, *y, radii, inset=RIM), PANEL + 0.002).at(z=low - 0.002)
    if at.p.logo != "none":
        solid = solid - _logo_shape(at, low=high - 0.0004, high=high + 0.001)
    return Body(
        solid=solid,
        surface="shell",
        density=at.style.lid_density * at.p.packing,
        edge=0.0004,
        collision=(slab((-x, 0.0, low), (x, at.lid_depth, high)),),
    )


def _picture(at: Layout) -> list[Body]:
    """The bezel fills the recess around the picture; glass lies level with it, plastic stands
    before it."""
    low, r = at.lid_z[0], at.screen
    radii = (at.p.corner, REAR_CORNER)
    around = plan(at.width / 2.0, 0.0, at.lid_depth, radii, inset=RIM)
    hole = rounded_rectangle(*r.size, 0.0004, segments=1) + r.middle
    sink = 0.0 if at.p.bezel == "glass" else 0.0005
    image = Decal(
        origin=(r.x0, r.y1, low + sink),
        right=(1.0, 0.0, 0.0),
        up=(0.0, -1.0, 0.0),
        size=at.screen_size,
    )
    return [
        Body(
            solid=prism(around, PANEL, holes=[hole]).at(z=low),
            surface="bezel",
            density=GLASS if at.p.bezel == "glass" else ABS,
        ),
        Body(
            solid=prism(hole, PANEL - sink).at(z=low + sink),
            surface="screen",
            density=GLASS,
            decal=image,
        ),
    ]


def _seal(at: Layout) -> list[Body]:
    """What keeps the lid off the deck: a ring of rubber, or pads."""
    low = at.lid_z[0]
    height = at.p.gap - BREATH
    if at.p.seal == "ring":
        x, radii = at.width / 2.0, (at.p.corner, REAR_CORNER)
        rings = [plan(x, 0.0, at.lid_depth, radii, inset=RIM + d) for d in (0.0001, 0.0014)]
        solids = [prism(rings[0], height, holes=[rings[1]]).at(z=low - height)]
    else:
        pad = rounded_rectangle(0.010, 0.0026, 0.0012, segments=3)
        x, near = at.width / 2.0 - 0.022, 0.0035
        places = [(-x, near), (x, near), (-x, at.lid_depth - near), (x, at.lid_depth - near)]
        if at.screen_size[0] > 0.30:
            places += [(-0.30 * at.width, near), (0.30 * at.width, near)]
        solids = [prism(pad, height).at(u, v, low - height) for u, v in sorted(set(places))]
    return [Body(solid=solid, surface="rubber", density=RUBBER) for solid in solids]


def _webcam(at: Layout) -> Body:
    """A lens in the middle of the upper bezel, level with it."""
    radius = min(0.0017, 0.30 * at.screen.y0)
    lens = prism(circle(radius, segments=14), 0.0005)
    return Body(
        solid=lens.at(0.0, 0.52 * at.screen.y0 + 0.0006, at.lid_z[0] - 0.00005),
        surface="lens",
        density=GLASS,
    )


def _barrels(at: Layout) -> list[Body]:
    """Knuckles with the arms that hold them to the cover."""
    low, y = at.lid_z[0] + 0.0003, at.axis_y
    bodies = []
    for left, right in at.barrels.lid:
        arm = slab((left, at.lid_depth, low), (right, y, at.arm_top))
        bodies.append(
            Body(
                solid=arm | at.barrels.knuckle((left, right)),
                surface="hinge",
                density=ALUMINIUM if at.p.hinge == "twin" else ABS,
                edge=0.0004,
                collision=(at.barrels.core((left, right)), arm),
            )
        )
    return bodies


def _ledge(at: Layout) -> list[Body]:
    """Strips beside the barrels, from the cover to just before the axis."""
    barrels, x = at.barrels, at.width / 2.0 - REAR_CORNER
    stops = sorted((a - PLAY, b + PLAY) for a, b in (*barrels.base, *barrels.lid))
    edges = [-x, *(edge for stop in stops for edge in stop), x]
    spans = [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 0.004]
    rear = at.axis_y - at.ledge_reach
    strips = [slab((a, at.lid_depth, at.lid_z[0]), (b, rear, at.ledge_top)) for a, b in spans]
    return [
        Body(solid=strip, surface="bezel", density=ABS, edge=0.0004, collision=(strip,))
        for strip in strips
    ]


def _logo(at: Layout) -> Body:
    """An inlay a hair proud of the cover."""
    high = at.lid_z[1]
    solid = _logo_shape(at, low=high - 0.0004, high=high + 0.00005)
    return Body(solid=solid, surface="logo", density=ALUMINIUM)


def _logo_shape(at: Layout, *, low: float, high: float) -> Solid:
    """The mark on the back, read by someone behind the open lid."""
    drawn = [prism(outline, high - low) for outline in LOGOS[at.p.logo](at.width)]
    aside = 0.36 * at.width if at.p.logo == "word" else 0.0
    ahead = 0.30 if at.p.logo == "word" else 0.0
    return union(drawn).at(aside, (0.5 - ahead) * at.lid_depth, low)


def _disc(width: float) -> list[Floats]:
    return [circle(0.045 * width, segments=32)]


def _hexagon(width: float) -> list[Floats]:
    return [regular_polygon(6, 0.055 * width)]


def _bars(width: float) -> list[Floats]:
    """Three slanted bars of growing length."""
    bars = []
    for k in range(3):
        x, half, tall = (k - 1) * 0.032 * width, 0.010 * width, (0.030 + 0.012 * k) * width
        lean = 0.35 * tall
        low, high = x - lean, x + lean
        corners = [
            (low - half, -tall),
            (low + half, -tall),
            (high + half, tall),
            (high - half, tall),
        ]
        bars.append(np.array(corners))
    return bars


def _word(width: float) -> list[Floats]:
    """Five blocks, as a small word looks from afar."""
    size = 0.009 * width
    block = rounded_rectangle(1.5 * size, 2.0 * size, 0.4 * size, segments=2)
    return [block + np.array((k * 2.1 * size, 0.0)) for k in range(-2, 3)]


LOGOS: Mapping[str, Callable[[float], list[Floats]]] = {
    "disc": _disc,
    "hexagon": _hexagon,
    "bars": _bars,
    "word": _word,
}
