"""The standing part of an oven: housing, front frame, lined cavity with its fittings, plinth."""

import math

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, ALUMINIUM, GLASS, RUBBER, STEEL
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.oven_design import FRAME, OvenParams
from artgen.generators.kit.printed import plate, printed, words
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, prism, slab, union, upright, wire

SHEET = 0.003
THIN = STEEL * 0.0008 / SHEET
"""kg/m3 of 0.8 mm sheet drawn 3 mm thick."""
SEAL = 0.002
"""m; how far the seal stands out of the frame."""
COVER = 0.018
"""m; depth of the fan's cover."""
LABEL = (0.090, 0.020)


def base_bodies(p: OvenParams) -> tuple[Body, ...]:
    """Everything that stands still but panel and hob."""
    outer = slab((-p.body_half, FRAME, p.sill), (p.body_half, p.depth, p.top))
    inner = slab(
        (-p.body_half + SHEET, FRAME, p.sill + SHEET),
        (p.body_half - SHEET, p.depth - SHEET, p.top - SHEET),
    )
    frame = slab((-p.half + 0.001, 0.0, p.sill), (p.half - 0.001, FRAME, p.top))
    rooms = [p.cavity.room(), *((drawer_room(p).room(),) if has_drawer(p) else ())]
    works = inner - p.cavity.outside()
    for room in rooms[1:]:
        works = works - room
    mass = p.heft * 2.0 * p.body_half * p.depth * (p.top - p.sill) * 1e3
    bodies = [
        Body(solid=outer - inner, surface="cover", density=THIN, edge=0.002, collision=_walls(p)),
        Body(solid=works, surface="works", density=0.55 * mass / works.volume),
        Body(solid=p.cavity.lined(), surface="liner", density=THIN),
        Body(solid=frame - union(rooms) - union(_slits(p)), surface="frame",
             density=STEEL * 0.001 / FRAME, edge=0.0006, collision=_wings(p)),
        Body(solid=_seal(p.cavity), surface="seal", density=RUBBER),
        Body(solid=p.leaf.placed(p.leaf.ear_solids()), surface="metal", density=STEEL),
        Body(solid=p.ladders.solid(), surface="wire", density=STEEL),
        Body(solid=union(_feet(p)), surface="rubber", density=RUBBER),
        plate(label_plane(p), "rating_label", density=ALUMINIUM, thickness=0.0005, sunk=0.0002),
        *_fittings(p),
    ]  # fmt: skip
    if has_drawer(p):
        bodies.append(_runners(p))
    return tuple(bodies)


def has_drawer(p: OvenParams) -> bool:
    """A range may have one below its door."""
    return p.is_range and p.drawer


def drawer_room(p: OvenParams) -> LinedCavity:
    """The compartment of the drawer."""
    return LinedCavity(
        low=(-p.body_half + 0.014, FRAME, p.sill + 0.010),
        high=(p.body_half - 0.014, p.depth - 0.060, p.sill + p.drawer_height - 0.012),
        corner=0.002,
        lining=0.002,
    )


def panel_housing(p: OvenParams) -> Body:
    """The block behind the panel's foil."""
    block = slab((-p.half, p.face, p.split), (p.half, 0.0, p.top))
    return Body(
        solid=p.panel.cut(block), surface="panel", density=0.25 * ABS, edge=0.002,
        collision=(block,),
    )  # fmt: skip


def range_bodies(p: OvenParams) -> tuple[Body, ...]:
    """Collar and hob, the lower front where there is no drawer, a plinth, a splash guard."""
    hob, rear = p.cooktop, p.depth
    collar = slab((-p.half, p.face, p.top), (p.half, rear, hob.bottom))
    bodies = [
        Body(solid=collar, surface="front", density=130.0, edge=0.003, collision=(collar,)),
        *hob.bodies(),
    ]
    plinth = slab((-p.half + 0.02, 0.040, 0.008), (p.half - 0.02, 0.046, p.sill + 0.001))
    bodies.append(Body(solid=plinth, surface="works", density=STEEL * 0.2))
    if not p.drawer:
        low, high = (-p.half, p.face, p.sill + 0.002), (p.half, 0.0, p.sill + p.drawer_height)
        front = slab(low, high)
        bodies.append(
            Body(solid=front, surface="front", density=150.0, edge=0.0025, collision=(front,))
        )
    if p.backguard:
        guard = slab((-p.half, rear - 0.030, hob.bottom - 0.001),
                     (p.half, rear - 0.001, hob.top + p.guard_height))  # fmt: skip
        bodies.append(
            Body(solid=guard, surface="front", density=400.0, edge=0.004, collision=(guard,))
        )
    return tuple(bodies)


def label_plane(p: OvenParams) -> PanelPlane:
    """On the front frame below the cavity, where the open door shows it."""
    z = (p.door_low + p.cavity.low[2] - LABEL[1]) / 2.0
    return PanelPlane(origin=(0.02, 0.0, z), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=LABEL)


def rating_print(p: OvenParams) -> SurfaceSpec:
    """Volume, voltage and power."""
    liters = 1e3 * math.prod(b - a for a, b in zip(p.cavity.low, p.cavity.high, strict=True))
    lines = (f"OVEN {liters:.0f} L   EN 60350-1", "220-240 V~ 50 Hz   3.4 kW")
    marks = [
        words((0.005, 0.0135 - 0.0075 * k), line, cap=0.0036, ink="#1c1d1f", anchor="left")
        for k, line in enumerate(lines)
    ]
    return printed("rating_label", LABEL, background="#c6c8ca", marks=marks, metallic=1.0)


def lamp_surface(p: OvenParams) -> SurfaceSpec:
    """Warm light behind frosted glass."""
    return SurfaceSpec(
        name="lamp", recipe="plain", color=(1.0, 0.80, 0.52), roughness=0.3, emission=p.lamp
    )


def _walls(p: OvenParams) -> tuple[Solid, ...]:
    x, low, high = p.body_half, p.sill, p.top
    feet = [box((0.03, 0.03, p.sill), at=(u, v, 0.0)) for u, v in _foot_places(p)]
    if not has_drawer(p):
        return (*p.cavity.walls((-x, 0.0, low), (x, p.depth, high)), *feet)
    level = p.sill + p.drawer_height
    return (
        *drawer_room(p).walls((-x, 0.0, low), (x, p.depth, level)),
        *p.cavity.walls((-x, 0.0, level), (x, p.depth, high)),
        *feet,
    )


def _wings(p: OvenParams) -> tuple[Solid, ...]:
    """The front frame beyond a built-in housing."""
    if p.is_range:
        return ()
    right = slab((p.body_half, 0.0, p.sill), (p.half - 0.001, FRAME, p.top))
    return right, right.mirrored("x")


def _foot_places(p: OvenParams) -> list[tuple[float, float]]:
    x = p.body_half - 0.05
    return [(u, v) for u in (-x, x) for v in (0.07, p.depth - 0.06)]


def _feet(p: OvenParams) -> list[Solid]:
    foot = cylinder(0.018, p.sill + 0.002, segments=14)
    return [foot.at(u, v) for u, v in _foot_places(p)]


def _slits(p: OvenParams) -> list[Solid]:
    """Air slits in the frame, in the strip below the door."""
    low = p.door_low - 0.010
    return [
        slab((x - 0.022, -0.01, low - 0.003), (x + 0.022, 0.5 * FRAME, low + 0.001))
        for x in np.arange(-4, 5) * 0.052
    ]


def _seal(cavity: LinedCavity) -> Solid:
    """A ring around the mouth."""
    (x0, _, z0), (x1, _, z1) = cavity.low, cavity.high

    def outline(grown: float) -> Floats:
        return rounded_rectangle(
            z1 - z0 + 2 * grown, x1 - x0 + 2 * grown, cavity.corner + grown, segments=4
        )

    ring = upright(prism(outline(0.014), SEAL + 0.002, holes=[outline(0.007)]), "y")
    return ring.at((x0 + x1) / 2.0, -SEAL, (z0 + z1) / 2.0)


def _fittings(p: OvenParams) -> list[Body]:
    """Fan cover, lamp, grill element, and ribs in the floor."""
    _, (_, y1, z1) = p.cavity.low, p.cavity.high
    lens = cylinder(0.027, 0.010, axis="y", segments=20)
    side = 0.62 * p.cavity.high[0]
    bodies = [
        Body(solid=_grill(p), surface="heater", density=STEEL),
        Body(solid=lens.at(side, y1 - 0.007, z1 - 0.055), surface="lamp", density=GLASS,
             edge=0.002),
    ]  # fmt: skip
    if p.fan != "none":
        cover, dark = _fan(p)
        bodies += [
            Body(solid=dark, surface="works", density=STEEL * 0.2),
            Body(solid=cover, surface="liner", density=THIN),
        ]
    return bodies


def _fan(p: OvenParams) -> tuple[Solid, Solid]:
    """(cover with radial slots and screws, the dark behind it) at the middle of the rear wall."""
    _, y1, _ = p.cavity.high
    _, _, z = p.cavity.middle
    r = p.fan_radius
    if p.fan == "round":
        plate_ = cylinder(r, COVER, axis="y", segments=36)
    else:
        plate_ = upright(prism(rounded_rectangle(2 * r, 2.3 * r, 0.012, segments=3), COVER), "y")
    slots = []
    for k in range(p.fan_holes):
        slot = slab((0.32 * r, -0.01, -0.0035), (0.78 * r, 0.005, 0.0035))
        slots.append(slot.turned("y", 2.0 * math.pi * k / p.fan_holes))
    screws = [
        cylinder(0.0045, 0.002, axis="y", segments=8).at(s * 0.66 * r, -0.0012, t * 0.66 * r)
        for s in (-1, 1)
        for t in (-1, 1)
        if p.fan == "square"
    ]
    hub = cylinder(0.006, 0.003, axis="y", segments=10).at(y=-0.002)
    cover = union([plate_ - union(slots), hub, *screws])
    dark = cylinder(0.86 * r, 0.010, axis="y", segments=24).at(y=0.004)
    return cover.at(0.0, y1 - COVER, z), dark.at(0.0, y1 - COVER, z)


def _grill(p: OvenParams) -> Solid:
    """A tubular element in loops below the ceiling, both ends in the rear wall."""
    (x0, _, _), (x1, y1, z1) = p.cavity.low, p.cavity.high
    z, reach = z1 - 0.024, 0.40 * (x1 - x0)
    xs = np.linspace(-reach, reach, 2 * p.grill_loops)
    front, back = 0.10, y1 - 0.075
    path = [(float(xs[0]), y1 + 0.001, z)]
    for k, x in enumerate(xs):
        ends = (back, front) if k % 2 == 0 else (front, back)
        path += [(float(x), y, z) for y in (ends if k else ends[1:])]
    path[-1] = (float(xs[-1]), y1 + 0.001, z)
    return wire(bent(path, 0.4 * float(xs[1] - xs[0])), 0.0034, sides=6)


def _runners(p: OvenParams) -> Body:
    """Two strips on the floor of the drawer's compartment."""
    (x0, y0, z0), (_, y1, _) = drawer_room(p).low, drawer_room(p).high
    left = slab((x0 + 0.010, y0, z0 - 0.001), (x0 + 0.022, y1 - 0.02, z0 + 0.005))
    return Body(solid=union([left, left.mirrored("x")]), surface="metal", density=STEEL)
