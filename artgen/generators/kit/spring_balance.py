"""Springs that carry what hangs on an arm, and the friction that holds the rest."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, Limit, Spring, Vector
from artgen.core.conventions import GRAVITY
from artgen.core.mesh import Floats
from artgen.generators.kit.counterbalance import weighed

SOFTEST = 0.02
"""N m/rad; where the load asks for a spring that weakens as it is stretched less."""
MARGIN = 1.8
"""How much more friction there is than what the spring leaves."""


@dataclass(frozen=True, kw_only=True)
class Balance:
    """A spring, the friction beside it, and the largest load that both meet, N m."""

    spring: Spring
    friction: float
    load: float


def balanced(
    bodies: Iterable[Body], *, pivot: Vector, sign: float, limit: Limit, least: float
) -> Balance:
    """The line nearest to the load of what turns about `sign` x through the pivot.

    Args:
        bodies: all that the joint carries, at rest.
        pivot: a point of the axis, m.
        sign: 1 or -1; the joint's axis is sign times +x.
        limit: of the joint, rad.
        least: least friction, N m.
    """
    q = np.linspace(limit.lower, limit.upper, 61)
    load = _load(bodies, pivot, sign, q)
    slope, rise = np.polyfit(q, -load, 1)
    stiffness = max(-float(slope), SOFTEST)
    preload = float(np.mean(-load + stiffness * q)) if stiffness == SOFTEST else float(rise)
    spring = Spring(stiffness=stiffness, reference=preload / stiffness)
    left = float(np.abs(load + stiffness * (spring.reference - q)).max())
    return Balance(
        spring=spring, friction=max(MARGIN * left, least), load=float(np.abs(load).max())
    )


def _load(bodies: Iterable[Body], pivot: Vector, sign: float, q: Floats) -> Floats:
    """Torque of gravity along the joint at each q, N m."""
    mass, center = weighed(bodies)
    y, z = center[1] - pivot[1], center[2] - pivot[2]
    return np.asarray(-sign * mass * GRAVITY * (y * np.cos(sign * q) - z * np.sin(sign * q)))


def leaning(angle: float) -> tuple[float, float]:
    """(y, z) of a unit vector that leans forward (-y) from upright by `angle` rad."""
    return -math.sin(angle), math.cos(angle)
