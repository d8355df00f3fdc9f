"""Weights and forces by a guess: nobody sees them in an image.

A part weighs its volume at one effective density; friction holds what gravity pulls at, anywhere on
a joint's way; the effort moves it against both.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.states import travel
from artgen.articulation.types import Joint
from artgen.core.conventions import GRAVITY
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.geometry.measure import inertia, moments
from artgen.geometry.solid import Solid
from artgen.validate.sweep import Sweep, sweep_poses

DENSITY = 300.0
"""kg/m3; furniture of chipboard with air in it, appliances of sheet and foam."""
HOLD = 1.3
"""Friction as a multiple of the largest pull of gravity along a joint."""
RUB = 0.1
"""Friction without such a pull, as a share of the weight (times the reach, where it turns)."""
EFFORT = 6.0
"""Effort as a multiple of friction."""
DAMPING = 0.3
"""Damping per friction, s/m or s/rad."""
QUICKEST = 300.0
"""1/s; damping over inertia. A dial of 5 g that is damped thirty times as much is not held by the
stops of MuJoCo, whose softness knows nothing of dampers."""
LEAST = 0.02
"""N or N m."""


@dataclass(frozen=True, kw_only=True)
class Forces:
    """Friction and effort in N or N m, damping per m/s or rad/s."""

    friction: float
    damping: float
    effort: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Weight:
    """Mass in kg, its center at rest, m, and its inertia about that, (3, 3) kg m2."""

    mass: float
    center: Floats
    inertia: Floats


def weights(solids: Mapping[str, Solid], density: float) -> dict[str, Weight]:
    """Part name to its weight."""
    found = {}
    for name, solid in solids.items():
        integral = moments(solid.trimesh().triangles)
        found[name] = Weight(
            mass=density * integral.volume,
            center=integral.center,
            inertia=density * inertia(integral.second),
        )
    return found


def forces(joint: Joint, joints: Sequence[Joint], heavy: Mapping[str, Weight], base: str) -> Forces:
    """What one joint takes to be held and to be moved; all that it carries counts."""
    carried = _carried(joint, joints)
    path = np.linspace(*travel(joint), 21)
    sweep = Sweep(joint=joint.name, states=tuple({joint.name: q} for q in path.tolist()))
    poses = sweep_poses(base, joints, sweep)
    axis = np.array(joint.axis)
    pull, weight, reach, lazy = np.zeros(len(path)), 0.0, 0.0, 0.0
    for name in carried:
        force = GRAVITY * heavy[name].mass
        centers = np.array([apply(pose, heavy[name].center) for pose in poses[name]])
        arms = centers - np.array(joint.origin)
        if joint.type == "prismatic":
            pull += -force * joint.axis[2]
            lazy += heavy[name].mass
        else:
            pull += force * (joint.axis[1] * arms[:, 0] - joint.axis[0] * arms[:, 1])
            across = float(np.linalg.norm(arms[0] - (arms[0] @ axis) * axis))
            reach = max(reach, across)
            lazy += float(axis @ heavy[name].inertia @ axis) + heavy[name].mass * across**2
        weight += force
    rub = RUB * weight * (reach if joint.type != "prismatic" else 1.0)
    friction = max(HOLD * float(np.abs(pull).max()), rub, LEAST)
    damping = min(DAMPING * friction, QUICKEST * lazy)
    return Forces(friction=friction, damping=damping, effort=EFFORT * friction)


def _carried(joint: Joint, joints: Sequence[Joint]) -> list[str]:
    names = [joint.child]
    for other in joints:
        if other.parent in names and other.child not in names:
            names.append(other.child)
    return names
