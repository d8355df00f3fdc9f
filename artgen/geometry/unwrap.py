"""Two UV sets: meters on the surface for tileable materials, and one atlas per object for
baking."""

from collections.abc import Sequence

import manifold3d as m3
import numpy as np
import xatlas
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from artgen.core.conventions import ATLAS_DECIMALS, UV_DECIMALS
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints

GOLDEN = 0.6180339887498949
"""Boards are cut from one veneer at places k * GOLDEN m apart, so that neighbours do not repeat."""

SIDE_AXES = np.array([[1, 2], [2, 0], [0, 1]])
"""The two axes that span the plane across x, y, z, right-handed."""

SMALLEST = 1e-4
"""m; thinner charts are packed as if they were this wide, so that none is lost."""
MILLIMETERS = 1e3
FOLD = 1e-3
"""Share of a chart's area that may lie double: rounding along its edges."""


def metric_uv(vertices: Floats, faces: Ints, *, grain: int | None, place: int) -> Floats:
    """(F, 3, 2) box projection in meters; u runs along the grain (the longest side unless given).

    Each triangle is seen along the axis its normal is nearest to, so lengths are right on axis-
    aligned faces and at most sqrt(3) short on oblique ones. (u, v, normal) is right-handed: nothing
    is mirrored."""
    extent = vertices.max(axis=0) - vertices.min(axis=0)
    along = int(np.argmax(extent)) if grain is None else grain
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    uv = np.zeros((len(faces), 3, 2))
    dominant = np.argmax(np.abs(normals), axis=1)
    for axis in range(3):
        for sign in (-1.0, 1.0):
            chosen = (dominant == axis) & (np.sign(normals[:, axis]) == sign)
            if chosen.any():
                u, v = _plane_axes(axis, sign, along, extent)
                uv[chosen] = corners[chosen] @ np.stack([u, v], axis=1)
    offset = np.array([place * GOLDEN % 1.0, place * GOLDEN * GOLDEN % 1.0])
    return np.round(uv + offset, UV_DECIMALS)


def _plane_axes(axis: int, sign: float, along: int, extent: Floats) -> tuple[Floats, Floats]:
    """Unit u and v in the plane across `axis`; u along the grain, or along the longer side of an
    end."""
    if axis == along:
        first, second = (k for k in range(3) if k != axis)
        along = first if extent[first] >= extent[second] else second
    u = np.eye(3)[along]
    return u, np.cross(sign * np.eye(3)[axis], u)


def flat_uv(
    vertices: Floats,
    faces: Ints,
    *,
    origin: Sequence[float],
    right: Sequence[float],
    up: Sequence[float],
) -> Floats:
    """(F, 3, 2) meters along `right` and `up` from `origin`, for a decal."""
    plane = np.stack([np.asarray(right, float), np.asarray(up, float)], axis=1)
    return np.round((vertices[faces] - np.asarray(origin, float)) @ plane, UV_DECIMALS)


def atlas_uv(parts: Sequence[tuple[Floats, Ints]], *, resolution: int) -> list[Floats]:
    """(F, 3, 2) per part: one atlas of all parts inside the unit square, without overlap.

    Charts are the connected pieces of surface that look along one of the six axis directions, laid
    flat along it, so seams fall on the edges of boxes; xatlas packs their rectangles. Its own
    charts take twelve times as long (3.7 against 0.3 CPU s for 11,000 triangles in 250 bodies).

    Args:
        parts: vertices (V, 3) and faces (F, 3) of each.
        resolution: texels along a side; charts keep two texels apart.

    Raises:
        GeometryError: xatlas lost a chart.
    """
    flat, charts = zip(*(_axis_charts(vertices, faces) for vertices, faces in parts), strict=True)
    charts = tuple(_unfolded(*part) for part in zip(parts, flat, charts, strict=True))
    starts = np.cumsum([0, *(int(chart.max()) + 1 for chart in charts)])
    chart = np.concatenate([own + start for own, start in zip(charts, starts, strict=False)])
    uv = np.concatenate(flat)
    lower = np.full((starts[-1], 2), np.inf)
    np.minimum.at(lower, chart, uv.min(axis=1))
    upper = np.full((starts[-1], 2), -np.inf)
    np.maximum.at(upper, chart, uv.max(axis=1))
    corner, right, up = _packed(upper - lower, resolution)
    share = (uv - lower[chart][:, None]) / np.maximum(upper - lower, SMALLEST)[chart][:, None]
    placed = corner[chart][:, None] + share[..., :1] * right[chart][:, None]
    placed = placed + share[..., 1:] * up[chart][:, None]
    placed = np.round(np.clip(placed, 0.0, 1.0), ATLAS_DECIMALS)
    return np.split(placed, np.cumsum([len(own) for own in flat])[:-1])


def _axis_charts(vertices: Floats, faces: Ints) -> tuple[Floats, NDArray[np.int64]]:
    """Flat UV (F, 3, 2) in m and chart number (F,) of each face."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    axis = np.argmax(np.abs(normals), axis=1)
    positive = np.take_along_axis(normals, axis[:, None], axis=1)[:, 0] > 0.0
    uv = np.take_along_axis(corners, np.repeat(SIDE_AXES[axis][:, None, :], 3, axis=1), axis=2)
    uv[~positive, :, 0] *= -1.0
    side = 2 * axis + positive
    keys, index = np.unique(faces.astype(np.int64) * 6 + side[:, None], return_inverse=True)
    index = index.reshape(-1, 3)
    links = coo_array(
        (np.ones(2 * len(index)), (np.repeat(index[:, 0], 2), index[:, 1:].ravel())),
        shape=(len(keys), len(keys)),
    )
    _, chart = connected_components(links, directed=False)
    _, chart = np.unique(chart[index[:, 0]], return_inverse=True)
    return uv, chart.reshape(-1)


def _unfolded(part: tuple[Floats, Ints], uv: Floats, chart: NDArray[np.int64]) -> NDArray[np.int64]:
    """Chart numbers (F,) such that no chart lies over itself: a helix, seen along its axis, does.

    A chart that does is cut in two by height along its axis, as often as it takes.
    """
    order = np.argsort(chart, kind="stable")
    cuts = np.flatnonzero(np.diff(chart[order])) + 1
    vertices, faces = part
    corners = vertices[faces]
    middles = corners.mean(axis=1)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    apart = np.zeros(len(chart), np.int64)
    waiting = [own for own in np.split(order, cuts) if len(own) > 1 and _folded(uv[own])]
    count = int(chart.max()) + 1
    while waiting:
        own = waiting.pop()
        axis = int(np.argmax(np.abs(normals[own[0]])))
        ranked = own[np.argsort(middles[own, axis], kind="stable")]
        for half in np.array_split(ranked, 2):
            if len(half) > 1 and _folded(uv[half]):
                waiting.append(half)
            else:
                apart[half] = count = count + 1
    split = np.where(apart > 0, apart, chart)
    return np.asarray(np.unique(split, return_inverse=True)[1].reshape(-1), np.int64)


def _folded(uv: Floats) -> bool:
    """Whether (F, 3, 2) triangles of one turn cover less than the sum of their areas."""
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0
    total = float(np.abs(areas).sum())
    upright = np.where((areas < 0.0)[:, None, None], uv[:, ::-1], uv) * MILLIMETERS
    union = m3.CrossSection(list(upright[areas != 0.0]), m3.FillRule.Positive)
    return bool(union.area() / MILLIMETERS**2 < (1.0 - FOLD) * total)


def _packed(sizes: Floats, resolution: int) -> tuple[Floats, Floats, Floats]:
    """Corner, right edge and up edge (N, 2) in the unit square for rectangles of `sizes` (N, 2)
    m."""
    count = len(sizes)
    width, height = MILLIMETERS * np.maximum(sizes, SMALLEST).T  # xatlas drops areas of 1e-8
    zero = np.zeros(count)
    quads = np.stack(
        [
            np.stack(pair, axis=1)
            for pair in ((zero, zero), (width, zero), (width, height), (zero, height))
        ],
        axis=1,
    )
    index = 4 * np.arange(count)[:, None] + np.array([[0, 1, 2], [0, 2, 3]]).reshape(1, 6)
    packer = xatlas.Atlas()
    packer.add_uv_mesh(
        quads.reshape(-1, 2).astype(np.float32),
        index.reshape(-1, 3).astype(np.uint32),
        np.repeat(np.arange(count, dtype=np.uint32), 2)[:, None],
    )
    packing = xatlas.PackOptions()
    packing.resolution, packing.padding, packing.bilinear = resolution, 2, True
    packing.create_image = False
    packer.generate(xatlas.ChartOptions(), packing)
    _, indices, uv = packer[0]
    if packer.chart_count != count or len(indices) != 2 * count:
        raise GeometryError(
            f"xatlas placed {packer.chart_count} of {count} charts; the mesh has slivers below "
            f"{SMALLEST} m"
        )
    corners = uv[indices].astype(np.float64).reshape(count, 6, 2)
    origin = corners[:, 0]
    return origin, corners[:, 1] - origin, corners[:, 5] - origin


def texel_density(corners: Floats, uv: Floats) -> Floats:
    """(F,) square root of UV area over surface area, 1 where lengths are kept."""
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    flat = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return np.asarray(np.sqrt(flat / np.where(area > 0.0, area, 1.0)))
