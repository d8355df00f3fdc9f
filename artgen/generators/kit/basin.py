"""A vessel basin that stands on a vanity, with its waste and a tall tap behind it."""

import math

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union, wire

WALL = 0.012
"""Thickness of the ceramic, m."""


def basin(
    size: tuple[float, float, float], at: tuple[float, float, float], ceramic: Stock, metal: Stock
) -> tuple[Body, ...]:
    """An open rounded box of (width, depth, height) m that stands centered on `at`."""
    width, depth, height = size
    x, y, z = at
    outer = prism(rounded_rectangle(width, depth, 0.06, segments=5), height)
    inner = prism(
        rounded_rectangle(width - 2.0 * WALL, depth - 2.0 * WALL, 0.06 - WALL, segments=5), height
    )
    bowl = (outer - inner.at(0.0, 0.0, 1.4 * WALL)).at(x, y, z)
    waste = cylinder(0.024, 0.004, segments=20).at(x, y, z + 1.4 * WALL)
    walls = tuple(piece.at(x, y, z) for piece in _walls(width, depth, height))
    return (ceramic.piece(bowl, contact=walls), metal.piece(waste))


def _walls(width: float, depth: float, height: float) -> tuple[Solid, ...]:
    """Bottom and four sides, short of the round corners."""
    a, b, straight = width / 2.0, depth / 2.0, 0.03
    return (
        slab((-a + WALL, -b + WALL, 0.0), (a - WALL, b - WALL, 1.4 * WALL)),
        slab((-a, -b + straight, 0.0), (-a + WALL, b - straight, height)),
        slab((a - WALL, -b + straight, 0.0), (a, b - straight, height)),
        slab((-a + straight, -b, 0.0), (a - straight, -b + WALL, height)),
        slab((-a + straight, b - WALL, 0.0), (a - straight, b, height)),
    )


def tap(at: tuple[float, float, float], *, rise: float, reach: float, metal: Stock) -> Body:
    """A standing pipe that bends over to -y, its foot at `at`, with a lever at its side."""
    x, y, z = at
    pipe, bend = 0.012, 0.05
    angles = np.linspace(0.0, 0.5 * math.pi, 6)
    arch = np.stack(
        [0.0 * angles, -bend * (1.0 - np.cos(angles)), rise - bend * (1.0 - np.sin(angles))], axis=1
    )
    path = np.concatenate([[(0.0, 0.0, 0.001)], arch, [(0.0, -reach, rise - 0.012)]])
    foot = cylinder(0.024, 0.008, segments=20)
    lever = wire([(0.0, 0.0, 0.07), (0.05, 0.0, 0.085)], 0.005, sides=8)
    solid = union(
        [wire(path, pipe, sides=12) & slab((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0)), foot, lever]
    )
    contact = (
        slab((-pipe, -pipe, 0.0), (pipe, pipe, rise)),
        slab((-pipe, -reach, rise - 0.024), (pipe, -pipe, rise)),
    )
    return metal.piece(solid.at(x, y, z), contact=tuple(c.at(x, y, z) for c in contact))
