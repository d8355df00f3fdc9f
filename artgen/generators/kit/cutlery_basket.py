"""Baskets and trays for cutlery."""

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import rectangle
from artgen.geometry.solid import Solid, prism, slab, union, upright


def shifted(outline: Floats, x: float, y: float) -> Floats:
    """An (N, 2) outline moved."""
    return outline + np.array([x, y])


def cutlery_basket(*, length: float, width: float, height: float, cells: int) -> Solid:
    """A slotted plastic basket standing on z = 0, long along y, divided into cells, with a bail."""
    t = 0.0022
    half, side = length / 2.0, width / 2.0
    bars = max(3, 2 * cells)
    pitch = (length - 2 * t) / bars
    slot = rectangle(pitch - 0.005, height - 0.022)
    holes = [shifted(slot, (k - (bars - 1) / 2.0) * pitch, height / 2.0) for k in range(bars)]
    outline = shifted(rectangle(length, height), 0.0, height / 2.0)
    wall = upright(prism(outline, t, holes=holes), "x")
    ends = [slab((-side + t, y, 0.0), (side - t, y + t, 0.75 * height)) for y in (-half, half - t)]
    inner = [
        slab((-side + t, y - t / 2.0, t), (side - t, y + t / 2.0, 0.8 * height))
        for y in ((k + 1) * length / cells - half for k in range(cells - 1))
    ]
    floor = slab((-side + t, -half + t, 0.0), (side - t, half - t, t))
    posts = [
        slab((-0.006, y - t, 0.75 * height), (0.006, y + t, 1.28 * height))
        for y in (-0.3 * length, 0.3 * length)
    ]
    feet = [
        slab((-side + t, y - t, t), (side - t, y + t, 0.76 * height))
        for y in (-0.3 * length, 0.3 * length)
    ]
    bail = slab(
        (-0.008, -0.3 * length - t, 1.28 * height), (0.008, 0.3 * length + t, 1.28 * height + 0.009)
    )
    return union([wall.at(x=-side), wall.at(x=side - t), *ends, *inner, floor, *feet, *posts, bail])


def cup_shelf(*, length: float, width: float, thickness: float, bars: int) -> Solid:
    """A slotted shelf, long along y, from x = 0 to `width`, its underside at z = 0."""
    pitch = (length - 0.012) / bars
    slot = rectangle(0.72 * width, pitch - 0.006)
    holes = [shifted(slot, 0.48 * width, (k - (bars - 1) / 2.0) * pitch) for k in range(bars)]
    outline = shifted(rectangle(width, length), width / 2.0, 0.0)
    return prism(outline, thickness, holes=holes)


def cutlery_comb(*, length: float, width: float, height: float, teeth: int) -> Solid:
    """A toothed rail along x with `teeth` gaps that hold cutlery flat; stands on z = 0."""
    pitch = width / teeth
    foot = slab((-width / 2.0, -length / 2.0, 0.0), (width / 2.0, length / 2.0, 0.003))
    pegs = [
        slab((x - 0.0018, -length / 2.0, 0.003), (x + 0.0018, length / 2.0, height))
        for x in ((k - (teeth - 1) / 2.0) * pitch for k in range(teeth))
    ]
    return union([foot, *pegs])
