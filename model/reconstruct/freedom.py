"""Whether joints can leave rest at all, before anything is cut out of their ways."""

from collections.abc import Collection, Mapping

import numpy as np

from artgen.articulation.states import travel
from artgen.geometry.clearance import Mover, overlaps, shape_of_solids
from artgen.validate.sweep import Sweep, sweep_poses
from model.reconstruct.scene import Scene

POSES = 11
"""Places along a joint's way at which it is looked whether it is free."""
ENOUGH = 0.5
"""Share of its way that a joint has free to be left alone."""
NOISE = 0.04
"""Share of the smaller of two parts that may meet and be cut away later."""


def free_share(
    scene: Scene,
    name: str,
    *,
    against: Collection[str] | None = None,
    held: Mapping[str, float] | None = None,
) -> float:
    """Share of a joint's way, from rest to its nearer end, on which nothing meets deeply.

    Args:
        against: what it may meet; None for all parts that it does not move.
        held: q of other joints meanwhile.
    """
    joint = scene.joint(name)
    upper = np.pi if joint.limit is None else joint.limit.upper
    path = np.linspace(0.0, upper, POSES)[1:]
    states = tuple({**(held or {}), name: q} for q in path.tolist())
    poses = sweep_poses(scene.base, scene.joints, Sweep(joint=name, states=states))
    moved = scene.moved_by(name)
    names = list(scene.solids)
    still = set(names if against is None else against) - moved
    movers = [
        Mover(name=own, shape=shape_of_solids([scene.solids[own]]), poses=poses[own])
        for own in names
    ]
    pairs = [
        (min(a, b), max(a, b))
        for a, one in enumerate(names)
        for b, other in enumerate(names)
        if one in moved and other in still
    ]
    first = len(path)
    for overlap in overlaps(movers, pairs):
        room = NOISE * min(scene.solids[overlap.first].volume, scene.solids[overlap.second].volume)
        if overlap.volume > room:
            first = min(first, overlap.pose)
    return first / len(path)


def have_ways_out(scene: Scene, one: str, other: str) -> bool:
    """Whether each of two parts can leave rest for all that the other does, be it once the other
    is wide open."""
    return all(_leaves(scene, own, met) for own, met in ((one, other), (other, one)))


def _leaves(scene: Scene, part: str, met: str) -> bool:
    if part == scene.base or part in scene.carriers(met):
        return True
    name = scene.joint_of(part).name
    if free_share(scene, name, against=[met]) >= ENOUGH:
        return True
    if met == scene.base or met in scene.carriers(part):
        return False
    door = scene.joint_of(met)
    wide = {door.name: travel(door)[1]}
    return free_share(scene, name, against=[met], held=wide) >= ENOUGH
