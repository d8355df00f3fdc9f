"""Parts made disjoint, at rest and along their ways: the base gives way, then what is larger.

Predicted parts overlap by about a step of the grid they were extracted from. A part grown by the
clearance is cut out of its neighbor (exact booleans). Where that would eat too much, the joint's
way ends there; and a drawer behind a door waits for the door (`model.reconstruct.barred`).
"""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Joint, Limit, Precondition
from artgen.core.mesh import Floats
from artgen.geometry.clearance import Mover, inverted_poses, overlaps, shape_of_solids
from artgen.geometry.solid import Solid, union
from artgen.validate.sweep import Sweep, sweep_poses, sweeps
from model.reconstruct.shapes import without_slivers

POSES = 41
"""Places along a joint's way at which parts are cut; validators look at every second one."""
MOST_INSIDE = 0.08
"""Share of a moving part that may lie inside another on its way and be taken for noise."""
MOST_EATEN = 0.25
"""Share of its volume that a part may lose to another's way."""
WORTH = 1e-10
"""m3; a tenth of what validators call an overlap."""
OCTANTS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """Parts and joints between them; the base is the first part, parents come before children.

    Attributes:
        changes: what was done to them so far, a sentence each.
    """

    solids: Mapping[str, Solid]
    joints: tuple[Joint, ...]
    rules: tuple[Precondition, ...] = ()
    changes: tuple[str, ...] = ()

    @property
    def base(self) -> str:
        """The fixed part."""
        return next(iter(self.solids))

    def joint(self, name: str) -> Joint:
        """The joint of that name."""
        return next(joint for joint in self.joints if joint.name == name)

    def carriers(self, name: str) -> set[str]:
        """All parts that a part hangs on, directly or not."""
        parents = {joint.child: joint.parent for joint in self.joints}
        found = set()
        while name in parents:
            name = parents[name]
            found.add(name)
        return found

    def told(self, *changes: str) -> "Scene":
        """The same with more to tell."""
        return dataclasses.replace(self, changes=(*self.changes, *changes))

    def with_solid(self, name: str, solid: Solid) -> "Scene":
        """The same with another shape of one part."""
        return dataclasses.replace(self, solids={**self.solids, name: solid})

    def with_way(self, joint: Joint, lower: float, upper: float) -> "Scene":
        """The same with other ends of one joint."""
        ended = dataclasses.replace(joint, limit=Limit(lower=lower, upper=upper))
        joints = tuple(ended if own.name == joint.name else own for own in self.joints)
        return dataclasses.replace(self, joints=joints)


def grown(solid: Solid, gap: float) -> Solid:
    """Every point of the solid moved by up to `gap` m along each axis: the union of eight shifted
    copies, which is all of it where the solid is thicker than twice the gap."""
    return union([solid.at(*(gap * octant)) for octant in OCTANTS])


def apart_at_rest(scene: Scene, *, clearance: float) -> Scene:
    """No two parts nearer than `clearance` m at rest; small winners are cut out first.

    Raises:
        GeometryError: a part lies wholly inside another that it gives way to.
    """
    names = sorted(scene.solids, key=lambda name: scene.solids[name].volume)
    for place, one in enumerate(names):
        for other in names[place + 1 :]:
            loses, wins = _ranked(scene, one, other)
            tool, whole = grown(scene.solids[wins], clearance), scene.solids[loses]
            if (whole & tool).volume <= WORTH:
                continue
            left = without_slivers(whole - tool)
            share = 1.0 - left.volume / whole.volume
            scene = scene.with_solid(loses, left)
            scene = scene.told(f"{loses} gave way to {wins} at rest, by {share:.1%} of its volume")
    return scene


def _ranked(scene: Scene, one: str, other: str) -> tuple[str, str]:
    """Who gives way, then who does not: the base, else what carries the other, else the larger."""
    for first, second in ((one, other), (other, one)):
        if first == scene.base or first in scene.carriers(second):
            return first, second
    return (other, one)


def clear_ways(scene: Scene, *, clearance: float) -> Scene:
    """What carries a part is cut out of the part's way, or the way ends before it."""
    for joint in scene.joints:
        for sweep in _sweeps_of(scene, joint.name):
            poses = sweep_poses(scene.base, scene.joints, sweep)
            for loses, wins in _pairs(scene, poses):
                tool = grown(scene.solids[wins], clearance)
                course = inverted_poses(poses[loses]) @ poses[wins]
                scene = _cleared(scene, sweep, (loses, wins), tool, course)
    return scene


def _sweeps_of(scene: Scene, name: str) -> list[Sweep]:
    return [s for s in sweeps(scene.joints, scene.rules, POSES) if s.joint == name]


def _pairs(scene: Scene, poses: Mapping[str, Floats]) -> Iterator[tuple[str, str]]:
    """Carrier and part, where the part moves relative to it."""
    for wins in scene.solids:
        for loses in sorted(scene.carriers(wins)):
            course = inverted_poses(poses[loses]) @ poses[wins]
            if np.abs(course - course[0]).max() > 1e-9:
                yield loses, wins


def _cleared(
    scene: Scene, sweep: Sweep, pair: tuple[str, str], tool: Solid, course: Floats
) -> Scene:
    """One carrier out of the way of one part, which goes (K, 4, 4) `course` in its frame."""
    loses, wins = pair
    whole = scene.solids[loses]
    shared = shared_volumes(tool, whole, course)
    met = np.flatnonzero(shared > WORTH)
    if not len(met):
        return scene
    deep = np.flatnonzero(shared > MOST_INSIDE * tool.volume)
    if not len(deep):
        left = whole - union([tool.transformed(course[pose]) for pose in met])
        share = 1.0 - left.volume / whole.volume
        if share <= MOST_EATEN:
            scene = scene.with_solid(loses, without_slivers(left))
            return scene.told(f"{loses} gave way to {wins} along {sweep.joint}, by {share:.1%}")
        deep = met
    return ended(scene, sweep, deep.tolist(), loses, clear=met.tolist())


def shared_volumes(mover: Solid, still: Solid, course: Floats) -> Floats:
    """(K,) m3 that a solid shares with another as it goes through (K, 4, 4) poses."""
    place = np.tile(np.eye(4), (len(course), 1, 1))
    movers = [
        Mover(name="mover", shape=shape_of_solids([mover]), poses=course),
        Mover(name="still", shape=shape_of_solids([still]), poses=place),
    ]
    shared = np.zeros(len(course))
    for overlap in overlaps(movers):
        shared[overlap.pose] = overlap.volume
    return shared


def ended(
    scene: Scene, sweep: Sweep, met: Sequence[int], what: str, *, clear: Sequence[int] = ()
) -> Scene:
    """The swept joint's way ended a step before the poses at which it meets something.

    Args:
        clear: poses at which it also meets a little; the carrier is cut there in a second round.
    """
    joint = scene.joint(sweep.joint)
    path = np.array([state[joint.name] for state in sweep.states])
    rest = int(np.argmin(np.abs(path)))
    upper = path[max(min([p for p in met if p >= rest], default=len(path)) - 1, rest)]
    lower = path[min(max([p for p in met if p <= rest], default=-1) + 1, rest)]
    if not lower < upper:
        return scene.told(f"{joint.name} cannot leave rest for {what}; its way was left as it was")
    scene = scene.with_way(joint, float(lower), float(upper))
    return scene.told(f"{joint.name} ends at {lower:.3g} to {upper:.3g}, where it meets {what}")
