"""Moving parts in each other's way: one waits for the other where that helps, or its way ends.

A drawer behind a door meets the closed door and is no mistake of the prediction.
"""

import dataclasses
from collections.abc import Mapping

import numpy as np

from artgen.articulation.states import travel
from artgen.articulation.types import Joint, Precondition
from artgen.geometry.clearance import Mover, overlaps, shape_of_solids
from artgen.validate.sweep import Sweep, sweep_poses
from model.reconstruct.apart import POSES, WORTH, Scene, ended

SHARES = (0.5, 0.75, 1.0)
"""Shares of one joint's way at which it is looked whether another is free."""


def bar_ways(scene: Scene) -> Scene:
    """Every joint's way free of the other moving parts, or told why it is not."""
    for name in [joint.name for joint in scene.joints]:
        for met in _met_on(scene, way_of(scene.joint(name)), scene.joint(name)):
            scene = _barred(scene, name, met)
    return scene


def way_of(joint: Joint, others: Mapping[str, float] | None = None) -> Sweep:
    """A joint through its whole way while others are held."""
    path = np.linspace(*travel(joint), POSES).tolist()
    return Sweep(joint=joint.name, states=tuple({**(others or {}), joint.name: q} for q in path))


def _barred(scene: Scene, name: str, met: str) -> Scene:
    joint = scene.joint(name)
    other = next(own for own in scene.joints if own.child == met)
    circle = any(rule.joint == other.name and rule.requires == name for rule in scene.rules)
    for share in () if circle else SHARES:
        upper = travel(other)[1]
        held = ({other.name: share * upper}, {other.name: upper})
        if not any(met in _met_on(scene, way_of(joint, others), joint) for others in held):
            rule = Precondition(joint=name, requires=other.name, at_least=share * upper)
            scene = dataclasses.replace(scene, rules=(*scene.rules, rule))
            return scene.told(f"{name} waits until {other.name} is at {share * upper:.3g}")
    sweep = way_of(joint)
    poses = [pose for pair, at in meetings(scene, sweep).items() if met in pair for pose in at]
    return ended(scene, sweep, poses, met)


def _met_on(scene: Scene, sweep: Sweep, joint: Joint) -> list[str]:
    """Moving parts that a joint's part, or what it carries, meets on its way."""
    ours = {n for n in scene.solids if n == joint.child or joint.child in scene.carriers(n)}
    met = {n for pair in meetings(scene, sweep) if len(ours & set(pair)) == 1 for n in pair}
    return sorted(met - ours - scene.carriers(joint.child))


def meetings(scene: Scene, sweep: Sweep) -> dict[tuple[str, str], list[int]]:
    """Pairs of moving parts that share volume, with the poses of the sweep at which they do."""
    poses = sweep_poses(scene.base, scene.joints, sweep)
    movers = [
        Mover(name=name, shape=shape_of_solids([solid]), poses=poses[name])
        for name, solid in scene.solids.items()
        if name != scene.base
    ]
    found: dict[tuple[str, str], list[int]] = {}
    for overlap in overlaps(movers) if len(movers) > 1 else ():
        if overlap.volume > WORTH:
            found.setdefault((overlap.first, overlap.second), []).append(overlap.pose)
    return found
