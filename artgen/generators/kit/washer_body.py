"""The standing part of a front-loading washer, its detergent drawer and its filter flap."""

import math
from itertools import pairwise

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.appliance_cabinet import worktop
from artgen.generators.kit.appliance_handle import pocket_room
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, POLYPROPYLENE, STEEL
from artgen.generators.kit.printed import plate, printed, words
from artgen.generators.kit.wash_drum import TUB, bellows
from artgen.generators.kit.washer_design import FASCIA, WasherParams
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, prism, slab, union, upright

SHEET = 0.003
THIN = STEEL * 0.0007 / SHEET
"""kg/m3 of 0.7 mm sheet drawn 3 mm thick."""
BALLAST = 18.0
"""kg; concrete that keeps a spinning machine in its place."""
FLAP = 0.005
"""m; thickness of the filter flap."""
LABEL = (0.090, 0.026)


def base_bodies(p: WasherParams) -> tuple[Body, ...]:
    """Everything that stands still."""
    outer = slab((-p.half, 0.0, p.foot), (p.half, p.depth, p.top))
    inner = slab(
        (-p.half + SHEET, SHEET, p.foot + SHEET),
        (p.half - SHEET, p.depth - SHEET, p.top - SHEET),
    )
    passage = cylinder(p.opening + 0.0035, p.tub_front + 0.02, axis="y", segments=40)
    rooms = [
        passage.at(y=-0.01, z=p.center), p.drum.tub_room(), p.drawer_room.room(), p.door.slot(),
    ]  # fmt: skip
    if p.grip == "scoop":
        rooms.append(p.door.dish())
    flap_room, pump = _filter(p)
    rooms += flap_room
    hollow = union(rooms)
    works = inner - hollow
    mass = BALLAST + p.heft * p.width * p.depth * p.height * 1e3
    return (
        Body(solid=outer - inner - hollow, surface="cabinet", density=THIN, edge=0.002,
             collision=_contact(p)),
        Body(solid=works, surface="works", density=0.62 * mass / works.volume),
        _fascia(p),
        p.panel.core("panel"),
        p.panel.foil(),
        Body(solid=worktop(half_width=p.half, front=-FASCIA + 0.002, back=p.depth, bottom=p.top,
                           top=p.height), surface="worktop", density=650.0, edge=0.002),
        Body(solid=union(_feet(p)), surface="rubber", density=1800.0),
        bellows(center=p.center, radius=p.opening, lip=p.opening - p.lip, front=-0.0012,
                back=p.tub_front, surface="bellows"),
        Body(solid=p.door.lugs(), surface="metal", density=STEEL * 0.6),
        plate(label_plane(p), "rating_label", density=ABS, thickness=0.0005, sunk=0.0002),
        _kick(p),
        *pump,
    )  # fmt: skip


def drawer_part(p: WasherParams) -> DraftPart:
    """A front with a finger pocket before a tray of two or three cups with a siphon cap."""
    (x0, _, z0), (x1, y1, z1) = p.drawer_room.low, p.drawer_room.high
    low = (x0 + 0.004, 0.006, z0 + 0.003)
    high = (x1 - 0.004, y1 - 0.008, z0 + 0.72 * (z1 - z0))
    t = 0.0025
    cups = np.linspace(low[0] + t, high[0], p.cups + 1)
    walls = [
        slab(low, (high[0], high[1], low[2] + t)),
        slab((low[0], low[1], low[2] + t), (low[0] + t, high[1], high[2])),
        slab((high[0] - t, low[1], low[2] + t), (high[0], high[1], high[2])),
        slab((low[0] + t, high[1] - t, low[2] + t), (high[0] - t, high[1], high[2])),
        *(
            slab((x - t, low[1], low[2] + t), (x, high[1] - t, high[2] - 0.006))
            for x in (float(c) for c in cups[1:-1])
        ),
    ]
    place = (float(cups[0] + cups[1]) / 2.0 - t / 2.0, high[1] - 0.050, high[2] - 0.016)
    cap = box((cups[1] - cups[0] - 2.4 * t, 0.055, 0.010), at=place)
    front_low = (x0 - 0.005, -FASCIA - p.drawer_lip, z0 - 0.006)
    front_high = (x1 + 0.005, -FASCIA - 0.0006, z1 + 0.006)
    neck = slab((x0 + 0.004, -FASCIA - 0.001, z0 + 0.003), (x1 - 0.004, 0.0065, high[2]))
    front = slab(front_low, front_high)
    room, cup = pocket_room(
        half_length=0.34 * p.drawer_width, y=front_low[1], low=front_low[2] + 0.010,
        high=front_low[2] + 0.44 * (front_high[2] - front_low[2]), depth=p.drawer_lip + 0.010,
        wall=0.0018,
    )  # fmt: skip
    middle = (x0 + x1) / 2.0
    bodies = (
        Body(solid=union(walls), surface="tray", density=POLYPROPYLENE, collision=tuple(walls)),
        Body(solid=cap, surface="cap", density=POLYPROPYLENE, edge=0.001),
        Body(solid=(front | neck) - room.at(x=middle), surface="panel", density=0.5 * ABS,
             edge=0.002, collision=(front, neck)),
        Body(solid=cup.at(x=middle), surface="tray", density=ABS),
    )  # fmt: skip
    out = (0.0, -1.0, 0.0)
    grip = Grip(name="drawer_pocket", kind="edge", outward=out, pull=out,
                position=(middle, front_low[1], front_low[2] + 0.020))  # fmt: skip
    return DraftPart(name="detergent_drawer", label="drawer", bodies=bodies, grips=(grip,))


def drawer_joint(p: WasherParams) -> Joint:
    """The detergent drawer's slide."""
    return Joint(
        name="detergent_drawer_slide", type="prismatic", parent="base", child="detergent_drawer",
        axis=(0.0, -1.0, 0.0), limit=Limit(lower=0.0, upper=round(0.82 * p.drawer_depth, 3)),
        friction=6.0, damping=4.0, effort=60.0, velocity=0.8,
    )  # fmt: skip


def flap_part(p: WasherParams) -> DraftPart:
    """A plate that tips forward about its lower edge, with a notch for a coin."""
    (x, z), s = p.flap_corner, p.flap_size
    notch = slab(
        (x + s / 2 - 0.012, -0.01, z + s - 0.005), (x + s / 2 + 0.012, 0.002, z + s + 0.01)
    )
    leaf = slab((x, 0.0, z), (x + s, FLAP, z + s))
    body = Body(solid=leaf - notch, surface="trim", density=ABS, edge=0.0008, collision=(leaf,))
    out = (0.0, -1.0, 0.0)
    grip = Grip(name="flap_edge", kind="edge", position=(x + s / 2, 0.002, z + s - 0.005),
                outward=out, pull=out)  # fmt: skip
    return DraftPart(name="filter_flap", label="flap", bodies=(body,), grips=(grip,))


def flap_joint(p: WasherParams) -> Joint:
    """About the lower front edge."""
    return Joint(
        name="filter_flap_hinge", type="revolute", parent="base", child="filter_flap",
        axis=(1.0, 0.0, 0.0), origin=(0.0, 0.0, p.flap_corner[1]),
        limit=Limit(lower=0.0, upper=math.radians(95.0)), friction=0.05, damping=0.01, effort=2.0,
    )  # fmt: skip


def label_plane(p: WasherParams) -> PanelPlane:
    """On the cabinet inside the ring's shadow, shown by the open door, above the opening."""
    return PanelPlane(
        origin=(-LABEL[0] / 2.0, 0.0, p.center + p.opening + 0.009),
        right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=(LABEL[0], 0.018),
    )  # fmt: skip


def rating_print(p: WasherParams) -> SurfaceSpec:
    """Load, voltage and power."""
    drum = p.drum
    liters = math.pi * drum.radius**2 * (drum.back - drum.front) * 1e3
    lines = (f"{liters / 7.0:.0f} kg  1400 min-1  EN 60456", "220-240 V~ 50 Hz  2100 W")
    marks = [
        words((0.004, 0.0125 - 0.0070 * k), line, cap=0.0032, ink="#2a2c2e", anchor="left")
        for k, line in enumerate(lines)
    ]
    return printed("rating_label", (LABEL[0], 0.018), background="#d2d4d6", marks=marks)


def _fascia(p: WasherParams) -> Body:
    """The panel's block across the whole width."""
    block = slab((-p.half, -FASCIA, p.split), (p.half, 0.0, p.top))
    (x0, _, z0), (x1, _, z1) = p.drawer_room.low, p.drawer_room.high
    sides = (
        slab((-p.half, -FASCIA, p.split), (x0, 0.0, p.top)),
        slab((x1, -FASCIA, p.split), (p.half, 0.0, p.top)),
        slab((x0, -FASCIA, p.split), (x1, 0.0, z0)),
        slab((x0, -FASCIA, z1), (x1, 0.0, p.top)),
    )
    return Body(
        solid=p.panel.cut(block) - p.drawer_room.room(), surface="panel", density=0.5 * ABS,
        edge=0.003, collision=sides,
    )  # fmt: skip


def _contact(p: WasherParams) -> tuple[Solid, ...]:
    """Boxes around the porthole, the drum, and the detergent drawer."""
    a, c, r = p.half, p.center, p.drum.radius + TUB
    hole, front, back = p.opening - p.lip, p.drum.front - TUB, p.drum.back + TUB
    low, high = p.foot, p.top
    room = p.drawer_room
    made = [
        slab((-a, front, low), (-r, back, c + r)),
        slab((r, front, low), (a, back, c + r)),
        slab((-r, front, low), (r, back, c - r)),
        slab((-a, back, low), (a, p.depth, high)),
        slab((-a, 0.0, c + r), (room.low[0], back, p.height)),
        slab((room.high[0], 0.0, c + r), (a, back, p.height)),
        slab((room.low[0], 0.0, c + r), (room.high[0], back, room.low[2])),
        slab((room.low[0], 0.0, room.high[2]), (room.high[0], back, p.height)),
        slab((room.low[0], room.high[1], room.low[2]), (room.high[0], back, room.high[2])),
        slab((-a, 0.0, c + hole), (a, front, c + r)),
        *(box((0.05, 0.05, p.foot), at=(x, y, 0.0)) for x, y in _foot_places(p)),
    ]
    floor = c - hole
    if p.flap == "none":
        made.append(slab((-a, 0.0, low), (a, front, floor)))
    else:
        (x, z), s = p.flap_corner, p.flap_size
        made += [
            slab((-a, FLAP + 0.020, low), (a, front, floor)),
            slab((-a, 0.0, low), (a, FLAP + 0.020, z - 0.001)),
            slab((-a, 0.0, z - 0.001), (x - 0.001, FLAP + 0.020, z + s + 0.001)),
            slab((x + s + 0.001, 0.0, z - 0.001), (a, FLAP + 0.020, z + s + 0.001)),
            slab((-a, 0.0, z + s + 0.001), (a, FLAP + 0.020, floor)),
        ]
    edges = np.linspace(-hole, hole, 7)
    for below, above in pairwise(edges.tolist()):
        near = 0.0 if below < 0.0 < above else min(abs(below), abs(above))
        x = math.sqrt(hole * hole - near * near)
        made += [
            slab((-a, 0.0, c + below), (-x, front, c + above)),
            slab((x, 0.0, c + below), (a, front, c + above)),
        ]
    return tuple(made)


def _foot_places(p: WasherParams) -> list[tuple[float, float]]:
    return [(x, y) for x in (-p.half + 0.05, p.half - 0.05) for y in (0.05, p.depth - 0.05)]


def _feet(p: WasherParams) -> list[Solid]:
    foot = cylinder(0.024, 0.6 * p.foot, segments=16) | cylinder(0.008, p.foot + 0.002, segments=8)
    return [foot.at(x, y) for x, y in _foot_places(p)]


def _kick(p: WasherParams) -> Body:
    """A groove-framed strip at the foot, in the trim's color."""
    strip = slab(
        (-p.half + 0.004, -0.0015, p.foot + 0.002), (p.half - 0.004, 0.001, p.foot + 0.010)
    )
    return Body(solid=strip, surface="trim", density=ABS)


def _filter(p: WasherParams) -> tuple[list[Solid], list[Body]]:
    """Room behind the flap, and the pump's cap in it."""
    if p.flap == "none":
        return [], []
    (x, z), s = p.flap_corner, p.flap_size
    outline = rounded_rectangle(s + 0.002, s + 0.002, 0.002, segments=2)
    room = upright(prism(outline, FLAP + 0.050), "y").at(x + s / 2, -0.01, z + s / 2)
    cap = cylinder(0.30 * s, 0.022, axis="y", segments=20).at(y=FLAP + 0.019)
    bar = slab((-0.26 * s, FLAP + 0.010, -0.005), (0.26 * s, FLAP + 0.030, 0.005))
    solid = (cap | bar).at(x + s / 2, 0.0, z + s / 2)
    return [room], [Body(solid=solid, surface="cap", density=POLYPROPYLENE)]
