"""The base of a printer: case with bays, print works inside, rear feed, feet and vents."""

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import RUBBER, STEEL
from artgen.generators.kit.lofted_shell import plan
from artgen.generators.kit.printer_design import DECK, FRONT, GAP, PrinterParams
from artgen.generators.kit.round_contact import square_box
from artgen.geometry.solid import Solid, cylinder, prism, slab, union

CASE = 320.0
"""kg/m3; walls of 2.5 mm polystyrene with ribs, motors and boards in thick ones."""
ROD = 0.0045
"""m; radius of the carriage's rail."""


def case_stock(surface: str = "case", edge: float = 0.0008) -> Stock:
    """What the case is molded from."""
    return Stock(surface=surface, density=CASE, edge=edge)


def base_bodies(p: PrinterParams, cuts: list[Solid]) -> tuple[Body, ...]:
    """All that is fixed; `cuts` are the panel's recess and wells."""
    outline = plan(p.side, p.front, p.back, (p.corner, p.corner))
    shell = prism(outline, p.top - p.foot).at(z=p.foot)
    room = union([*_bays(p), *_vents(p), *cuts])
    tone = "trim" if p.two_tone else "case"
    split = p.output_bay[0] - 0.5 * DECK
    whole = slab((-1.0, -1.0, split), (1.0, 1.0, 1.0))
    upper = (shell & whole) - room
    lower = (shell - whole) - room
    touch = _panels(p)
    return (
        case_stock(tone).piece(lower, contact=touch),
        case_stock().piece(upper),
        *_works(p),
        *_rollers(p),
        *_feet(p),
        _usb_slot(p),
    )


def _bays(p: PrinterParams) -> list[Solid]:
    """Rooms for cassette, output, print works and rear feed."""
    f = p.front - 0.01
    (o0, o1), (w0, _) = p.output_bay, p.works
    y0, y1 = p.works_span
    rooms = [
        slab((-p.bay_half, f, o0), (p.bay_half, p.bay_rear, o1)),
        slab((-p.works_half, y0, w0), (p.works_half, y1, p.top + 0.01)),
    ]
    if p.feed == "cassette":
        c0, c1 = p.cassette
        rooms.append(slab((-p.cassette_half, f, c0), (p.cassette_half, p.cassette_rear, c1)))
    else:
        a, b = p.rear + 0.012, p.back - 0.012
        rooms.append(slab((-p.bay_half, a, w0), (p.bay_half, b, p.top + 0.01)))
    return rooms


def _panels(p: PrinterParams) -> tuple[Solid, ...]:
    """Boxes of the case around its bays; corners left out as far as they are round."""
    s, f, b, inset = p.side, p.front, p.back, 0.3 * p.corner
    (c0, c1), (o0, o1), (w0, top) = p.cassette, p.output_bay, p.works
    y1 = p.works_span[1]
    ends = [
        slab((-s, f + p.corner, p.foot), (-p.works_half, b - p.corner, top)),
        slab((p.works_half, f + p.corner, p.foot), (s, b - p.corner, top)),
    ]
    wide = s - inset
    decks = [
        slab((-p.works_half, f + inset, p.foot), (p.works_half, b - inset, c0)),
        slab((-p.works_half, f + inset, c1), (p.works_half, b - inset, o0)),
        slab((-p.works_half, f + inset, o1), (p.works_half, b - inset, w0)),
    ]
    walls = [
        *_beside(p.bay_half, wide, (f + inset, p.bay_rear), (o0, o1)),
        slab((-wide, p.bay_rear, o0), (wide, y1, o1)),
        slab((-wide, y1, o0), (wide, p.rear, top)),
    ]
    if p.feed == "cassette":
        walls += _beside(p.cassette_half, wide, (f + inset, p.cassette_rear), (c0, c1))
        walls.append(slab((-wide, p.cassette_rear, c0), (wide, b - inset, c1)))
    else:
        walls += [
            slab((-wide, p.rear, o0), (wide, p.rear + 0.012, top)),
            slab((-wide, b - 0.012, o0), (wide, b, top)),
            *_beside(p.bay_half, wide, (p.rear + 0.012, b - 0.012), (w0, top)),
        ]
    return tuple([*ends, *decks, *walls, *_front_boxes(p, inset)])


def _beside(
    inner: float, outer: float, y: tuple[float, float], z: tuple[float, float]
) -> list[Solid]:
    """Two boxes left and right of a bay."""
    return [
        slab((-outer, y[0], z[0]), (-inner, y[1], z[1])),
        slab((inner, y[0], z[0]), (outer, y[1], z[1])),
    ]


def _front_boxes(p: PrinterParams, inset: float) -> list[Solid]:
    """The front above the output bay, thinner behind a panel."""
    half, f = p.panel_size[0] / 2.0 + GAP, p.front
    (w0, top), back = p.works, p.front + FRONT
    wide = p.side - inset
    deep = recess_depth(p)
    low = top - p.panel_size[1] - 0.003 - 2.0 * GAP
    return [
        slab((-half, f + deep, low), (half, back, top)),
        slab((-half, f, w0), (half, back, low)),
        *_beside(half, wide, (f + inset, back), (w0, top)),
    ]


def recess_depth(p: PrinterParams) -> float:
    """m; of the room that the control panel lies in."""
    return 0.0155 if p.tilts else 0.0


def _works(p: PrinterParams) -> list[Body]:
    """Platen with ribs, the carriage's rod, belt and coded strip, the parking station."""
    w0, top = p.works
    y0, y1 = p.works_span
    half, y = p.works_half, rod_place(p)[0]
    z = rod_place(p)[1]
    platen = slab((-half + 0.012, y0 + 0.020, w0 - 0.001), (half - 0.07, y0 + 0.075, w0 + 0.006))
    ribs = [
        slab((x - 0.0008, y0 + 0.020, w0 + 0.006), (x + 0.0008, y0 + 0.075, w0 + 0.0075))
        for x in np.linspace(-half + 0.03, half - 0.09, 9).tolist()
    ]
    rod = cylinder(ROD, 2.0 * half + 0.004, axis="x", segments=14).at(-half - 0.002, y, z)
    frame = slab((-half, y1 - 0.006, w0 - 0.001), (half, y1 + 0.001, top - 0.012))
    belt = slab((-half + 0.01, y1 - 0.0085, z + 0.004), (half - 0.01, y1 - 0.0070, z + 0.010))
    strip = slab((-half, y1 - 0.0100, z + 0.013), (half, y1 - 0.0094, z + 0.020))
    station = slab((half - 0.066, y0 + 0.012, w0 - 0.001), (half + 0.001, y0 + 0.088, w0 + 0.006))
    rod_box = slab((-half, y - 0.003, z - 0.003), (half, y + 0.003, z + 0.003))
    dark = Stock(surface="inside", density=900.0, edge=0.0)
    metal = Stock(surface="metal", density=STEEL, edge=0.0)
    return [
        dark.piece(union([platen, *ribs]), contact=(platen,)),
        dark.piece(station, contact=(station,)),
        Stock(surface="metal", density=1600.0, edge=0.0).piece(frame, contact=(frame,)),
        metal.piece(rod, contact=(rod_box,)),
        Body(solid=belt, surface="rubber", density=RUBBER),
        Body(solid=strip, surface="strip", density=1200.0),
    ]


def rod_place(p: PrinterParams) -> tuple[float, float]:
    """(y, z) of the carriage's rod."""
    return p.works_span[1] - 0.024, p.works[0] + 0.024


def _rollers(p: PrinterParams) -> list[Body]:
    """The output rollers that show at the rear of the output bay."""
    z, y = p.output_bay[1] - 0.010, p.bay_rear - 0.009
    shaft = cylinder(0.003, 2.0 * p.bay_half, axis="x", segments=10).at(-p.bay_half, y, z)
    rings = [
        cylinder(0.0075, 0.012, axis="x", segments=16).at(x - 0.006, y, z)
        for x in np.linspace(-p.bay_half + 0.03, p.bay_half - 0.03, 4).tolist()
    ]
    box = slab((-p.bay_half, y - 0.005, z - 0.005), (p.bay_half, y + 0.005, z + 0.005))
    return [
        Stock(surface="metal", density=STEEL, edge=0.0).piece(shaft, contact=(box,)),
        Body(solid=union(rings), surface="rubber", density=RUBBER),
    ]


def _feet(p: PrinterParams) -> list[Body]:
    feet = []
    for x in (-p.side + 0.05, p.side - 0.05):
        for y in (p.front + 0.045, p.back - 0.045):
            solid = cylinder(0.011, p.foot + 0.001, segments=16).at(x, y)
            box = square_box(0.011, 0.0, p.foot, at=(x, y))
            feet.append(
                Stock(surface="rubber", density=RUBBER, edge=0.001).piece(solid, contact=(box,))
            )
    return feet


def _vents(p: PrinterParams) -> list[Solid]:
    """Slots in both sides."""
    z0, z1 = p.works[0] + 0.012, p.top - 0.014
    return [
        slab((s * p.side - 0.0022, y, z0), (s * p.side + 0.0022, y + 0.0028, z1))
        for s in (-1.0, 1.0)
        for y in (p.rear - 0.07 - 0.007 * np.arange(p.vents)).tolist()
    ]


def _usb_slot(p: PrinterParams) -> Body:
    """A socket for sticks in the front, left of the output bay."""
    x = -0.5 * (p.bay_half + p.side - p.corner)
    z = p.output_bay[1] - 0.016
    frame = slab((x - 0.010, p.front - 0.0006, z), (x + 0.010, p.front + 0.006, z + 0.0105))
    mouth = slab(
        (x - 0.0068, p.front - 0.01, z + 0.0028), (x + 0.0068, p.front + 0.005, z + 0.0077)
    )
    return Stock(surface="inside", density=1000.0, edge=0.0004).piece(frame - mouth)
