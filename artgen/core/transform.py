"""Rigid (4, 4) matrices named `a_from_b`: they map b coordinates to a."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from artgen.core.mesh import Floats


def rigid(rotation: ArrayLike, translation: ArrayLike) -> Floats:
    """(4, 4) from a (3, 3) rotation and a (3,) translation."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = translation
    return matrix


def inverted(a_from_b: Floats) -> Floats:
    """`b_from_a` of a rigid matrix, by transposition."""
    rotation = a_from_b[:3, :3].T
    return rigid(rotation, -rotation @ a_from_b[:3, 3])


def apply(a_from_b: Floats, points: ArrayLike) -> Floats:
    """(..., 3) points of b in a."""
    moved: Floats = np.asarray(points, float) @ a_from_b[:3, :3].T + a_from_b[:3, 3]
    return moved


POLE = 1e-9
"""Sine of the angle from the vertical below which a view has no azimuth of its own."""


def look_at(eye: Sequence[float] | Floats, target: Sequence[float] | Floats) -> Floats:
    """`world_from_camera` of an OpenCV camera at `eye`, upright, facing `target`.

    A vertical view has no upright; it is turned as the view from the front (-y) that was raised or
    lowered until it was vertical: +x is to the right.
    """
    forward = np.asarray(target, float) - np.asarray(eye, float)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    if np.linalg.norm(right) < POLE:
        right = np.array([1.0, 0.0, 0.0]) - forward[0] * forward
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    return rigid(np.stack([right, down, forward], axis=1), eye)
