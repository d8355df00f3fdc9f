"""Periodic noise fields that come out alike on every machine.

Only integers from PCG64 and the operations + - * / of float64 are used, which IEEE 754 fixes to
the last bit; no sine, exponential or Fourier transform enters a field.
"""

import numpy as np

from artgen.core.mesh import Floats

UNIT = 12.0**0.5
"""Scales an even draw from [-1/2, 1/2) to variance 1."""
SPLINE_POWER = 151.0 / 315.0
"""Mean over a cell of the sum of squared cubic B-spline weights: what interpolation keeps of the
variance, per direction."""


def white(rng: np.random.Generator, shape: tuple[int, int]) -> Floats:
    """(H, W) independent values of mean 0 and variance 1, evenly distributed."""
    return np.asarray((rng.random(shape) - 0.5) * UNIT)


def smooth(rng: np.random.Generator, cells: tuple[int, int], shape: tuple[int, int]) -> Floats:
    """(H, W) noise of mean 0 and variance 1 that varies over (H / rows, W / columns) texels.

    It wraps around in both directions. Where a count of cells equals the count of texels, every
    texel of that direction has its own value.
    """
    field = white(rng, cells)
    for axis in (0, 1):
        if cells[axis] != shape[axis]:
            field = _spline(field, shape[axis], axis) / SPLINE_POWER**0.5
    return field


def fractal(
    rng: np.random.Generator,
    cells: tuple[int, int],
    shape: tuple[int, int],
    *,
    octaves: int,
    gain: float = 0.5,
) -> Floats:
    """(H, W) sum of `octaves` smooth fields, each twice as fine and `gain` times as strong.

    The variance is 1.
    """
    total, power, strength = np.zeros(shape), 0.0, 1.0
    for octave in range(octaves):
        finer = tuple(min(c << octave, s) for c, s in zip(cells, shape, strict=True))
        total += strength * smooth(rng, (finer[0], finer[1]), shape)
        power += strength * strength
        strength *= gain
    return total / power**0.5


def _spline(lattice: Floats, count: int, axis: int) -> Floats:
    """`count` samples along `axis` of the periodic cubic B-spline with these control values."""
    cells = lattice.shape[axis]
    place = (np.arange(count) + 0.5) * (cells / count)
    cell = place.astype(np.int64)
    t = place - cell
    s = 1.0 - t
    weights = (
        s * s * s,
        4.0 - 6.0 * t * t + 3.0 * t * t * t,
        4.0 - 6.0 * s * s + 3.0 * s * s * s,
        t * t * t,
    )
    side = (-1, 1) if axis == 0 else (1, -1)
    total: Floats = sum(
        np.take(lattice, (cell + k - 1) % cells, axis=axis) * (weight / 6.0).reshape(side)
        for k, weight in enumerate(weights)
    )
    return total


def smoothstep(lower: float | Floats, upper: float | Floats, x: Floats) -> Floats:
    """0 below `lower`, 1 above `upper`, a cubic with level ends between."""
    t = np.clip((x - lower) / (upper - lower), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))
