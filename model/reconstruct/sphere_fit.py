"""Where the object is and how large, if the camera file does not say: the sphere around the visual
hull, moved a step at a time to where what the network says about it is best.

A hull is wider than its object where no camera looks along its sides, and open parts push its
middle aside; networks divide positions by the sphere, and a middle that is off by a fifth of its
radius costs them most of what they know.
"""

import dataclasses
from collections.abc import Callable

import numpy as np

from model.reconstruct.sight import Sphere

FIRST_STEP = 0.16
"""Radii by which the middle moves, and share by which the radius changes; halved where no step of
that length is better."""
ROUNDS = 7
"""Each tries every change once."""
FARTHEST = 0.4
"""Radii that the middle may leave its first place by."""
SIZES = (0.6, 1.5)
"""Range of the radius as a multiple of the first one."""


def fitted(first: Sphere, merit: Callable[[Sphere], float]) -> Sphere:
    """The sphere of most merit on the way from the first one; what the camera file states stays."""
    found, most, step = first, merit(first), FIRST_STEP
    for _ in range(ROUNDS):
        tried = [change(found, sign * step) for change in changes(first) for sign in (1.0, -1.0)]
        merits = [(merit(sphere), sphere) for sphere in tried if near(sphere, first)]
        value, sphere = max(merits, key=lambda own: own[0], default=(most, found))
        if value > most:
            most, found = value, sphere
        else:
            step /= 2.0
    return found


Change = Callable[[Sphere, float], Sphere]


def changes(sphere: Sphere) -> list[Change]:
    """What may be changed about a sphere, each by a signed step."""
    found: list[Change] = []
    if not sphere.center_stated:
        found += [_moving(axis) for axis in range(3)]
    if not sphere.radius_stated:
        found.append(resized)
    return found


def _moving(axis: int) -> Change:
    def moved(sphere: Sphere, step: float) -> Sphere:
        return dataclasses.replace(
            sphere, center=sphere.center + step * sphere.radius * np.eye(3)[axis]
        )

    return moved


def resized(sphere: Sphere, step: float) -> Sphere:
    """Larger by a share, or smaller so that the same share leads back."""
    factor = 1.0 + step if step > 0.0 else 1.0 / (1.0 - step)
    return dataclasses.replace(sphere, radius=sphere.radius * factor)


def near(sphere: Sphere, first: Sphere) -> bool:
    """Whether a sphere is one that the hull leaves possible."""
    off = float(np.linalg.norm(sphere.center - first.center))
    low, high = (share * first.radius for share in SIZES)
    return off <= FARTHEST * first.radius and low <= sphere.radius <= high


def told_sphere(found: Sphere, first: Sphere) -> str:
    """What a user should know of a sphere that was not stated."""
    missing = [
        word
        for word, stated in (("center", first.center_stated), ("radius", first.radius_stated))
        if not stated
    ]
    off = float(np.linalg.norm(found.center - first.center)) / first.radius
    center = ", ".join(f"{value:.4g}" for value in found.center)
    return (
        f"the camera file states no {' and no '.join(missing)}: the sphere around the visual hull "
        f"was moved by {off:.2f} of its radius and made {found.radius / first.radius:.2f} times as "
        "large, to where predictions agree best with the silhouettes and with each other: center "
        f"{center}, radius {found.radius:.4g}; state {' and '.join(missing)}, if known, for a "
        "better result"
    )
