"""What is in the way of light, on a coarse grid: soft shadows and dark insides at little cost.

Surfaces are strewn with points; the area of those in a cell says how opaque it is. For each of a
few directions one sweep over the grid finds, for every cell, the share of light that arrives from
outside. The sky's share is kept as a mean and a gradient over directions, a softbox's as a number.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from renders.fast.filtered import HEIGHT, directions, solid_angles
from renders.fast.light import Shine

Singles = NDArray[np.float32]
MARGIN = 1.5
"""Cells around the object, so that a surface's outer side lies within the grid."""
OPACITY = 3.0
"""A cell with surface area a, in faces of a cell, stops 1 - exp(-OPACITY a^2): 95 % for one sheet,
17 % for a wire that shows a quarter of a face."""
SKY = 4
"""Numbers a cell keeps of the sky: the mean and a gradient."""
SHADOWED = 4
"""Lights that cast shadows: as many as a texel has channels."""
FACES = [(s * (k == 0), s * (k == 1), s * (k == 2)) for k in range(3) for s in (-1.0, 1.0)]
CORNERS = [tuple(s / np.sqrt(3.0) for s in signs) for signs in itertools.product((-1, 1), repeat=3)]
AROUND: Floats = np.array([*FACES, *CORNERS])
"""(14, 3) directions of a quadrature of degree 5 on the sphere (Abramowitz and Stegun 25.4.65)."""
SHARE: Floats = np.array([1 / 15] * 6 + [3 / 40] * 8)
R2 = (0.7548776662466927, 0.5698402909980532)
"""Inverse powers of the plastic number: steps that fill the unit square evenly."""
SPREAD = 0.3
"""Where on a softbox its two sample points lie, in sides from its middle."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Cloud:
    """Points that stand for surfaces: (3, N) m, and the (N,) area of each, m2."""

    points: Floats
    areas: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Occlusion:
    """Light that arrives in the cells of a grid.

    Attributes:
        low: (3,) m, corner of the grid.
        cell: m.
        sky: (Z, Y, X, 4) float16: mean radiance of the sky that is seen, and its gradient.
        lights: (Z, Y, X, SHADOWED) float16: shares of the lights that are seen.
    """

    low: Floats
    cell: float
    sky: NDArray[np.float16]
    lights: NDArray[np.float16]


def strewn(corners: Floats, spacing: float) -> Cloud:
    """Points on triangles (F, 3, 3), one per `spacing`^2 m2 and at least one a triangle.

    Within a triangle they follow Roberts' R2 sequence, folded from the square to the triangle, so
    that slivers get their points along their length.
    """
    a, b, c = corners.transpose(1, 0, 2)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    counts = np.ceil(area / spacing**2).astype(np.intp) + (area == 0.0)
    owner = np.repeat(np.arange(len(corners)), counts)
    index = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    u, v = (0.5 + index * R2[0]) % 1.0, (0.5 + index * R2[1]) % 1.0
    over = u + v > 1.0
    u, v = np.where(over, 1.0 - u, u), np.where(over, 1.0 - v, v)
    points = a[owner] + u[:, None] * (b - a)[owner] + v[:, None] * (c - a)[owner]
    return Cloud(points=np.ascontiguousarray(points.T), areas=(area / counts)[owner])


def occlusion(clouds: Sequence[Cloud], light: Shine, *, cells: int) -> list[Occlusion]:
    """One grid a scene, all of one shape; `cells` is how many a grid has, about."""
    low = np.stack([cloud.points.min(axis=1) for cloud in clouds])
    extent = np.stack([np.ptp(cloud.points, axis=1) for cloud in clouds])
    size, shape = fitted(extent, cells)
    low = low - (shape * size[:, None] - extent) / 2.0
    opaque = np.stack(
        [
            _opacity(cloud, low[k], size[k], shape).transpose(2, 1, 0)
            for k, cloud in enumerate(clouds)
        ]
    )
    sky = np.zeros((SKY, *opaque.shape), np.float32)
    for direction, factors in zip(AROUND, sky_factors(light).astype(np.float32), strict=True):
        seen = swept(opaque, direction)
        for channel, factor in zip(sky, factors, strict=True):
            channel += factor * seen
    lights = np.ones((*opaque.shape, SHADOWED), np.float32)
    for k, (place, _) in enumerate(zip(light.corners, light.radiance, strict=True)):
        if k < SHADOWED:
            lights[..., k] = _lit(opaque, place, light.middle)
    return [
        Occlusion(
            low=low[k],
            cell=float(size[k]),
            sky=np.moveaxis(sky[:, k], 0, -1).astype(np.float16),
            lights=lights[k].astype(np.float16),
        )
        for k in range(len(clouds))
    ]


def sky_factors(light: Shine) -> Floats:
    """(14, 4) what the sky in each direction of AROUND adds to its mean and gradient; the mean of
    an open sky is 1. A black one counts as even: its mean still tells how open a place is."""
    towards = directions(HEIGHT)
    nearest = np.argmax(towards @ AROUND.T, axis=-1).ravel()
    weight = np.repeat(solid_angles(HEIGHT), 2 * HEIGHT)
    gray = np.bincount(nearest, weights=weight * light.around.mean(axis=-1).ravel())
    share = SHARE * np.maximum(gray / np.bincount(nearest, weights=weight), 1e-6)
    basis = np.concatenate([np.ones((len(AROUND), 1)), AROUND], axis=1)
    return np.asarray((share / share.sum())[:, None] * basis)


def fitted(extent: Floats, cells: int) -> tuple[Floats, NDArray[np.intp]]:
    """Cell sizes (S,) and the common shape (3,) of grids around boxes of `extent` (S, 3)."""
    longest = extent.max(axis=1)
    relative = (extent / np.where(longest > 0.0, longest, 1.0)[:, None]).max(axis=0)
    along = (cells / np.maximum(relative, 0.15).prod()) ** (1.0 / 3.0)
    shape = np.ceil(np.maximum(relative, 0.15) * along + 2.0 * MARGIN).astype(np.intp)
    return np.where(longest > 0.0, longest, 1.0) / along, shape


def _opacity(cloud: Cloud, low: Floats, size: float, shape: NDArray[np.intp]) -> Singles:
    """(X, Y, Z) share of light that a cell stops."""
    x, y, z = ((cloud.points - low[:, None]) / size).astype(np.intp)
    flat = (x * shape[1] + y) * shape[2] + z
    area = np.bincount(flat, weights=cloud.areas, minlength=int(shape.prod())) / size**2
    return (-np.expm1(-OPACITY * area**2)).reshape(shape).astype(np.float32)


def _lit(opaque: Singles, corners: Floats, middle: Floats) -> Singles:
    """Share of a softbox that is seen, by two of its points, far enough to be parallel light."""
    at = corners.mean(axis=0)
    points = at + 2.0 * SPREAD * (corners[::2] - at)
    toward = [(point - middle) / np.linalg.norm(point - middle) for point in points]
    return np.mean([swept(opaque, direction) for direction in toward], axis=0)


def swept(opaque: Singles, direction: Floats) -> Singles:
    """(S, Z, Y, X) share of light that arrives in each cell from `direction` (x, y, z).

    Layer after layer from where light enters; a layer reads the one before it between cells, where
    the ray through its own cells comes from. A cell does not shade itself.
    """
    main = int(np.argmax(np.abs(direction)))
    others = [axis for axis in range(3) if axis != main]
    order = (3 - main, 0, 3 - others[0], 3 - others[1])
    layers = np.ascontiguousarray(opaque.transpose(order))
    if direction[main] > 0.0:
        layers = layers[::-1]
    first, second = (float(direction[axis] / abs(direction[main])) for axis in others)
    arrived = np.ones_like(layers)
    _, scenes, rows, columns = layers.shape
    padded = np.ones((scenes, rows + 2, columns + 2), np.float32)
    clear = 1.0 - layers
    for k in range(1, len(layers)):
        np.multiply(arrived[k - 1], clear[k - 1], out=padded[:, 1:-1, 1:-1])
        _read_shifted(padded, first, second, out=arrived[k])
    if direction[main] > 0.0:
        arrived = arrived[::-1]
    return arrived.transpose(np.argsort(order))


def _read_shifted(padded: Singles, a: float, b: float, *, out: Singles) -> None:
    """Fill (S, A, B) from (S, A + 2, B + 2), which has a border, (a, b) cells further on, each
    within [-1, 1]."""
    _, rows, columns = out.shape
    i, j = 1 + int(np.floor(a)), 1 + int(np.floor(b))
    s, t = np.float32(a - np.floor(a)), np.float32(b - np.floor(b))
    mixed = padded[:, i : i + rows]
    if s:
        mixed = mixed + s * (padded[:, i + 1 : i + 1 + rows] - mixed)
    out[:] = mixed[:, :, j : j + columns]
    if t:
        out += t * (mixed[:, :, j + 1 : j + 1 + columns] - out)
