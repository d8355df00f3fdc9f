"""Boxes that stand for something round: three crossing ones whose corners lie on the circle."""

import numpy as np

from artgen.geometry.solid import Axis, Solid, slab, upright

HALVES = ((0.92, 0.39), (0.39, 0.92), (0.70, 0.70))
"""Half sides in radii."""


def round_boxes(
    radius: float,
    low: float,
    high: float,
    *,
    axis: Axis = "z",
    at: tuple[float, float] = (0.0, 0.0),
) -> tuple[Solid, ...]:
    """For a bar of `radius` from `low` to `high` along `axis`.

    `at` is its middle in the two other axes, in the order of the drawing that `upright` reads:
    (x, y) for z, (y, z) for x, (z, x) for y.
    """
    u, v = at
    return tuple(
        upright(
            slab(
                (u - a * radius, v - b * radius, low),
                (u + a * radius, v + b * radius, high),
            ),
            axis,
        )
        for a, b in HALVES
    )


def square_box(
    radius: float, low: float, high: float, *, at: tuple[float, float] = (0.0, 0.0)
) -> Solid:
    """One upright box inside a round post: for small ones, and for what turns inside others."""
    half = float(np.sqrt(0.5)) * radius
    return slab((at[0] - half, at[1] - half, low), (at[0] + half, at[1] + half, high))
