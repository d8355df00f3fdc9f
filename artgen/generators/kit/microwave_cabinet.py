"""The standing part of a microwave oven: cover, works, lined cavity, flange, vents, lamp."""

import math

import numpy as np

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.cord import cord_stub
from artgen.generators.kit.density import ABS, GLASS, POLYPROPYLENE, RUBBER, STEEL
from artgen.generators.kit.microwave_design import FLANGE, LINER, SCOOP, MicrowaveParams
from artgen.generators.kit.printed import disc, plate, printed, words
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, hull, prism, slab, union

SHEET = 0.003
"""m; cover as drawn; its density is scaled to 0.6 mm of steel."""
THIN = STEEL * 0.0006
HOOK = 0.011
"""m; how far the door's hooks reach into the flange."""
LAMP = (0.048, 0.048)
LABEL = (0.080, 0.050)


def base_bodies(p: MicrowaveParams) -> tuple[Body, ...]:
    """Everything that stands still but the panel."""
    (x0, _, z0), (x1, y1, z1) = p.cavity
    outer = slab((-p.half, FLANGE, p.foot), (p.half, p.depth, p.height))
    inner = slab(
        (-p.half + SHEET, FLANGE, p.foot + SHEET),
        (p.half - SHEET, p.depth - SHEET, p.height - SHEET),
    )
    lined, room = p.lined.outside(), p.lined.room()
    slots = p.leaf.placed(hooks(p, play=0.0035))
    flange = slab(
        (-p.half + 0.001, 0.0, p.foot + 0.001), (p.half - 0.001, FLANGE, p.height - 0.001)
    )
    works = inner - lined - slots
    mass = p.heft * p.width * p.depth * p.height * 1e3
    grilles, holes = _grilles(p)
    return (
        Body(solid=outer - inner - union(holes), surface="cover", density=THIN / SHEET,
             edge=0.0025, collision=_walls(p)),
        Body(solid=works - union(holes), surface="works", density=0.55 * mass / works.volume),
        *(Body(solid=grille, surface="cover", density=THIN / SHEET) for grille in grilles),
        Body(solid=(lined - room) | _ribs(p), surface="liner", density=THIN / LINER),
        Body(solid=flange - room - slots, surface="liner", density=THIN / FLANGE, edge=0.0006),
        Body(solid=p.leaf.placed(p.leaf.ear_solids()), surface="metal", density=STEEL),
        Body(solid=union(_feet(p)), surface="rubber", density=RUBBER),
        cord_stub((p.half - 0.070, p.depth - 0.002, p.foot + 0.050), out=(0.0, 1.0, 0.0),
                  surface="rubber", run=0.012),
        plate(_label_plane(p), "rating_label", density=ABS, thickness=0.0005, sunk=0.0002),
        *_fittings(p, (x0, z0), (x1, y1, z1)),
    )  # fmt: skip


def panel_housing(p: MicrowaveParams) -> Body:
    """The block behind the panel's foil, with a finger scoop beside the door."""
    low, high = p.panel_block
    block = p.panel.cut(slab(low, high))
    if p.opening == "scoop":
        block = block - _scoop(p)
    return Body(
        solid=block, surface="panel", density=0.30 * ABS, edge=0.0025, collision=(slab(low, high),)
    )


def hooks(p: MicrowaveParams, *, play: float = 0.0) -> Solid:
    """The door's two latch hooks, or with play the room for them, in the door's drawing."""
    d = p.leaf
    made = []
    for share in (0.24, 0.76):
        z = share * d.length
        arm = slab(
            (d.width - 0.0125 - play, d.back - 0.004, z - 0.004 - play),
            (d.width - 0.0085 + play, HOOK + play, z + 0.004 + play),
        )
        nose = slab(
            (d.width - 0.0125 - play, HOOK - 0.006 - play, z - 0.007 - play),
            (d.width - 0.0085 + play, HOOK + play, z + 0.004 + play),
        )
        made += [arm, nose]
    return union(made)


def _walls(p: MicrowaveParams) -> tuple[Solid, ...]:
    """Boxes around the cavity, and the feet."""
    around = p.lined.walls((-p.half, 0.0, p.foot), (p.half, p.depth, p.height))
    return (
        *around,
        *(box((0.026, 0.026, p.foot + 0.001), at=(x, y, 0.0)) for x, y in _foot_places(p)),
    )


def _foot_places(p: MicrowaveParams) -> list[tuple[float, float]]:
    return [(x, y) for x in (-p.half + 0.04, p.half - 0.04) for y in (0.045, p.depth - 0.045)]


def _feet(p: MicrowaveParams) -> list[Solid]:
    foot = cylinder(0.015, p.foot + 0.001, segments=14)
    return [foot.at(x, y) for x, y in _foot_places(p)]


def _ribs(p: MicrowaveParams) -> Solid:
    """Beads pressed into side walls and rear wall."""
    (x0, _, z0), (x1, y1, z1) = p.cavity
    made = [slab((x0 - 0.002, y1 - 0.001, z0 + 0.02), (x0 + 0.0004, y1 + 0.002, z1 - 0.02))]
    for z in np.linspace(z0, z1, p.ribs + 2)[1:-1]:
        bead = hull([(u, y, z + w) for y in (0.035, y1 - 0.030)
                     for u, w in ((0.0, -0.006), (0.003, -0.003), (0.003, 0.003), (0.0, 0.006))]
                    + [(-0.001, y, z) for y in (0.035, y1 - 0.030)])  # fmt: skip
        made += [bead.at(x0), bead.mirrored("x").at(x1)]
    return union(made)


def _grilles(p: MicrowaveParams) -> tuple[list[Solid], list[Solid]]:
    """Louvered plates in the right side and in the rear, and the openings for them."""
    long, high = 0.014 * p.vents, p.vent_height
    room = slab((-long / 2.0, -high / 2.0, -0.006), (long / 2.0, high / 2.0, 0.001))
    sheet = slab((-long / 2.0, -high / 2.0, -0.0022), (long / 2.0, high / 2.0, -0.0005))
    slots = [
        box((0.006, high - 0.008, 0.02), at=((k - (p.vents - 1) / 2.0) * 0.014, 0.0, -0.01))
        for k in range(p.vents)
    ]
    z = p.height - 0.055 - high / 2.0
    side = PanelPlane(
        origin=(p.half, p.depth * 0.62, z), right=(0.0, 1.0, 0.0), up=(0.0, 0.0, 1.0),
        size=(1.0, 1.0),
    )  # fmt: skip
    rear = PanelPlane(
        origin=(-p.half * 0.4, p.depth, z), right=(-1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0),
        size=(1.0, 1.0),
    )  # fmt: skip
    grille = sheet - union(slots)
    return [side.placed(grille), rear.placed(grille)], [side.placed(room), rear.placed(room)]


def _fittings(
    p: MicrowaveParams, low: tuple[float, float], high: tuple[float, float, float]
) -> list[Body]:
    """Lamp behind its perforated patch, wave guide cover, and what food stands on."""
    (x0, z0), (x1, y1, z1) = low, high
    lamp = plate(_lamp_plane(p), "lamp", density=GLASS, thickness=0.0010, radius=0.012, sunk=0.0004)
    guide = slab(
        (x1 - 0.0012, 0.55 * y1 - 0.045, z0 + 0.34 * (z1 - z0)),
        (x1 + 0.001, 0.55 * y1 + 0.045, z0 + 0.34 * (z1 - z0) + 0.055),
    )
    bodies = [lamp, Body(solid=guide, surface="mica", density=2600.0)]
    if p.platform == "turntable":
        bodies.append(
            Body(solid=p.turntable.coupling(), surface="ring", density=POLYPROPYLENE, edge=0.0008)
        )
    else:
        outline = rounded_rectangle(x1 - x0 - 0.016, y1 - 0.020, 0.018, segments=4)
        tile = prism(outline, 0.005).at((x0 + x1) / 2.0, y1 / 2.0, z0 - 0.001)
        bodies.append(Body(solid=tile, surface="tile", density=GLASS, edge=0.001))
    return bodies


def _lamp_plane(p: MicrowaveParams) -> PanelPlane:
    """On the cavity's right wall, near the top, facing the food."""
    _, (x1, y1, z1) = p.cavity
    return PanelPlane(
        origin=(x1, 0.35 * y1 + LAMP[0] / 2.0, z1 - 0.026 - LAMP[1]),
        right=(0.0, -1.0, 0.0), up=(0.0, 0.0, 1.0), size=LAMP,
    )  # fmt: skip


def _label_plane(p: MicrowaveParams) -> PanelPlane:
    return PanelPlane(
        origin=(p.half - 0.16, p.depth, p.foot + 0.10),
        right=(-1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=LABEL,
    )  # fmt: skip


def _scoop(p: MicrowaveParams) -> Solid:
    """Room for two fingers behind the door's free edge, half way along it."""
    d = p.leaf
    half = 0.055
    low, high = (d.width - 0.001, d.front - 0.01), (d.width + SCOOP, d.front + 0.020)
    middle = d.length / 2.0
    return d.placed(slab((*low, middle - half), (*high, middle + half)))


def lamp_print(p: MicrowaveParams, liner: SurfaceSpec) -> SurfaceSpec:
    """Holes in the patch before the lamp, lit from behind."""
    pitch, (w, h) = 0.0048, LAMP
    spots = [
        ((i + 0.5 * (j % 2)) * pitch + 0.006, j * 0.866 * pitch + 0.006)
        for i in range(int((w - 0.010) / pitch))
        for j in range(int((h - 0.010) / (0.866 * pitch)))
    ]
    holes = [disc(spot, 0.0015, ink="#fff0d0") for spot in spots]
    return printed(
        "lamp", LAMP, background=srgb_hex(liner.color), marks=holes, lit=holes, emission=p.lamp
    )


def rating_print(p: MicrowaveParams) -> SurfaceSpec:
    """The label on the rear."""
    low, high = p.cavity
    liters = 1e3 * math.prod(b - a for a, b in zip(low, high, strict=True))
    lines = ("MICROWAVE OVEN", "230 V~ 50 Hz 1250 W", "2450 MHz 800 W", f"{liters:.0f} L IEC 60705")
    marks = [
        words((0.006, 0.042 - 0.010 * k), line, cap=0.0038, ink="#202224", anchor="left")
        for k, line in enumerate(lines)
    ]
    return printed("rating_label", LABEL, background="#d5d6d8", marks=marks)
