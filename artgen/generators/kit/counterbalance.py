"""Springs that hold a door that falls open."""

import math
from collections.abc import Iterable

import numpy as np

from artgen.articulation.types import Body, Spring, Vector
from artgen.core.conventions import GRAVITY
from artgen.core.mesh import Floats
from artgen.geometry.measure import combined, moments


def weighed(bodies: Iterable[Body]) -> tuple[float, Floats]:
    """Mass (kg) and center (3,) of bodies that share no volume, before their edges are rounded."""
    pieces = [(b.density, moments(b.solid.trimesh().triangles)) for b in bodies]
    mass, center, _ = combined(pieces)
    return mass, center


def counterbalance(bodies: Iterable[Body], *, pivot: Vector, upper: float) -> tuple[Spring, float]:
    """The spring of a door that turns by +q about +x from upright, and the torque that is left.

    Gravity opens with f(q) = a sin(q + p), which is concave; among all lines the one parallel to
    its chord, half its greatest height above it, is nearest to it (Chebyshev). The door's friction
    must exceed the torque that is left (N m) for it to stay wherever it is put.
    """
    mass, center = weighed(bodies)
    behind, above = center[1] - pivot[1], center[2] - pivot[2]
    amplitude = mass * GRAVITY * math.hypot(behind, above)
    phase = math.atan2(-behind, above)
    closed, opened = (amplitude * math.sin(q + phase) for q in (0.0, upper))
    stiffness = (opened - closed) / upper
    steepest = math.acos(stiffness / amplitude) - phase
    height = amplitude * math.sin(steepest + phase) - (closed + stiffness * steepest)
    left = height / 2.0
    return Spring(stiffness=stiffness, reference=-(closed + left) / stiffness), left


def net_torque(bodies: Iterable[Body], *, pivot: Vector, spring: Spring, q: Floats) -> Floats:
    """Torque about +x of gravity and spring at each q (N,), N m; positive opens."""
    mass, center = weighed(bodies)
    behind, above = center[1] - pivot[1], center[2] - pivot[2]
    gravity = mass * GRAVITY * (above * np.sin(q) - behind * np.cos(q))
    return np.asarray(gravity + spring.stiffness * (spring.reference - q))
