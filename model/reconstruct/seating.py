"""Joints seated in the parts they move: an axis runs through what it turns, and a slide goes less
far than its part is long.
"""

import dataclasses

import numpy as np

from artgen.articulation.types import Joint, Limit
from artgen.core.mesh import Floats
from model.reconstruct.scene import Scene

POINTS = 129
"""Points of an axis at which its distance from a box is taken."""
NEAR = 0.02
"""Share of a part's diagonal by which its axis may pass outside: barrels of hinges stand out."""
HELD = 1e-3
"""Share of its part's length that a slide keeps on its rails: more than rounding of vertices takes.
"""
HARDLY = 0.01
"""Share of its way that a slide may lose without a word, as its part is cut a little."""


def seated(scene: Scene) -> Scene:
    """Every joint in its part."""
    for joint in scene.joints:
        bounds = scene.solids[joint.child].bounds
        if joint.type == "prismatic":
            scene = _on_rails(scene, joint, bounds)
        else:
            scene = _through(scene, joint, bounds)
    return scene


def _through(scene: Scene, joint: Joint, bounds: Floats) -> Scene:
    """The scene with an axis moved, without turning it, to where it touches the part's box."""
    shift = way_to_box(np.array(joint.origin), np.array(joint.axis), bounds)
    length = float(np.linalg.norm(shift))
    if length <= NEAR * float(np.linalg.norm(bounds[1] - bounds[0])):
        return scene
    x, y, z = (np.array(joint.origin) + shift).tolist()
    scene = scene.with_joint(dataclasses.replace(joint, origin=(x, y, z)))
    return scene.told(f"{joint.name} passed {joint.child} by {length:.3g} m and was moved to it")


def way_to_box(origin: Floats, axis: Floats, bounds: Floats) -> Floats:
    """(3,) m from the point of a line that is nearest to a box to the box; zero where they meet."""
    reach = float(np.linalg.norm(bounds[1] - bounds[0])) / 2.0
    middle = float((bounds.mean(axis=0) - origin) @ axis)
    points = origin + np.linspace(middle - reach, middle + reach, POINTS)[:, None] * axis
    ways = points.clip(bounds[0], bounds[1]) - points
    way = ways[int(np.argmin(np.linalg.norm(ways, axis=1)))]
    return np.asarray(way - (way @ axis) * axis)


def _on_rails(scene: Scene, joint: Joint, bounds: Floats) -> Scene:
    """The scene with a slide's way a little shorter than its part, if it was longer."""
    most = (1.0 - HELD) * float(np.abs(joint.axis) @ (bounds[1] - bounds[0]))
    limit = joint.limit
    if limit is None or limit.upper - limit.lower <= most * (1.0 + 1e-9):
        return scene
    share = most / (limit.upper - limit.lower)
    ends = Limit(lower=share * limit.lower + 0.0, upper=share * limit.upper)
    told = (
        f"{joint.name}'s way of {limit.upper:.3g} m was cut to {ends.upper:.3g}, {HELD:.1%} "
        f"shorter than {joint.child} is"
    )
    cut = scene.with_joint(dataclasses.replace(joint, limit=ends))
    return cut.told(told) if share < 1.0 - HARDLY else cut
