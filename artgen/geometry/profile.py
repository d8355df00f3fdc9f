"""Plane outlines: counter-clockwise (N, 2) float64 point arrays, m."""

import math
from collections.abc import Sequence

import numpy as np

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats

CHORD_ERROR = 1.5e-4
"""m; the largest distance between an arc and its chords, well under a pixel in our renders."""


def arc_segments(
    radius: float, angle: float = 2.0 * math.pi, chord_error: float = CHORD_ERROR
) -> int:
    """Chords for an arc whose sagitta r (1 - cos(step / 2)) stays under `chord_error`; 2 to 64."""
    step = 2.0 * math.acos(max(0.0, 1.0 - chord_error / max(radius, 2.0 * chord_error)))
    return max(2, min(64, math.ceil(abs(angle) / step)))


def arc(center: Sequence[float], radius: float, start: float, stop: float, segments: int) -> Floats:
    """(segments + 1, 2) points from angle `start` to `stop`, rad."""
    angles = np.linspace(start, stop, segments + 1)
    return np.asarray(center, float) + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def rectangle(width: float, height: float) -> Floats:
    """Centred on zero."""
    x, y = width / 2.0, height / 2.0
    return np.array([(-x, -y), (x, -y), (x, y), (-x, y)])


def rounded_rectangle(
    width: float, height: float, radius: float | Sequence[float], *, segments: int | None = None
) -> Floats:
    """Centred on zero; `radius` for all corners or for (lower left, lower right, upper right, upper
    left)."""
    radii = [float(radius)] * 4 if isinstance(radius, int | float) else [float(r) for r in radius]
    if max(radii) > min(width, height) / 2.0 + 1e-12:
        raise GeometryError(
            f"corner radius {max(radii)} m exceeds half of the {width} x {height} m rectangle"
        )
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    pieces = []
    for quarter, (r, (sx, sy)) in enumerate(zip(radii, signs, strict=True)):
        corner = np.array([sx * width / 2.0, sy * height / 2.0])
        if r <= 0.0:
            pieces.append(corner[None])
            continue
        start = math.pi + quarter * math.pi / 2.0
        count = segments or max(2, arc_segments(r, math.pi / 2.0))
        center = corner - r * np.array([sx, sy])
        pieces.append(arc(center, r, start, start + math.pi / 2.0, count))
    return np.concatenate(pieces)


def circle(radius: float, *, segments: int | None = None) -> Floats:
    """Centred on zero; at least 8 sides."""
    count = segments or max(8, arc_segments(radius))
    angles = 2.0 * math.pi * np.arange(count) / count
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def regular_polygon(sides: int, radius: float) -> Floats:
    """Centred on zero with a flat side down."""
    angles = 2.0 * math.pi * np.arange(sides) / sides - math.pi / 2.0 + math.pi / sides
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
