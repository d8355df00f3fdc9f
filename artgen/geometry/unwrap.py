"""Two UV sets: metres on the surface for tileable materials, and one atlas per object for baking."""

from collections.abc import Sequence

import numpy as np
import xatlas

from artgen.core.conventions import UV_DECIMALS
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints

GOLDEN = 0.6180339887498949
"""Boards are cut from one veneer at places k * GOLDEN m apart, so that neighbours do not repeat."""


def metric_uv(vertices: Floats, faces: Ints, *, grain: int | None, place: int) -> Floats:
    """(F, 3, 2) box projection in metres; u runs along the grain (the longest side unless given).

    Each triangle is seen along the axis its normal is nearest to, so lengths are right on axis-
    aligned
    faces and at most sqrt(3) short on oblique ones. (u, v, normal) is right-handed: nothing is
    mirrored.
    """
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
    end.
    """
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
    """(F, 3, 2) metres along `right` and `up` from `origin`, for a decal."""
    plane = np.stack([np.asarray(right, float), np.asarray(up, float)], axis=1)
    return np.round((vertices[faces] - np.asarray(origin, float)) @ plane, UV_DECIMALS)


def atlas_uv(parts: Sequence[tuple[Floats, Ints]], *, resolution: int) -> list[Floats]:
    """(F, 3, 2) per part: one xatlas packing of all parts inside the unit square, without overlap.

    Args:
        parts: vertices (V, 3) and faces (F, 3) of each.
        resolution: texels along a side; charts keep two texels apart.

    Raises:
        GeometryError: xatlas lost or added a triangle.
    """
    packer = xatlas.Atlas()
    for vertices, faces in parts:
        packer.add_mesh(vertices.astype(np.float32), faces.astype(np.uint32))
    charts, packing = xatlas.ChartOptions(), xatlas.PackOptions()
    charts.max_iterations = 1
    packing.resolution, packing.padding, packing.bilinear = resolution, 2, True
    packing.create_image = False
    packer.generate(charts, packing)
    placed = []
    for index, (_, faces) in enumerate(parts):
        _, indices, uv = packer[index]
        if len(indices) != len(faces):
            raise GeometryError(
                f"xatlas returned {len(indices)} of {len(faces)} triangles of part {index}; "
                "remove degenerate triangles first"
            )
        placed.append(np.round(np.clip(uv[indices].astype(np.float64), 0.0, 1.0), UV_DECIMALS))
    return placed


def texel_density(corners: Floats, uv: Floats) -> Floats:
    """(F,) square root of UV area over surface area, 1 where lengths are kept."""
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    flat = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return np.asarray(np.sqrt(flat / np.where(area > 0.0, area, 1.0)))
