"""What is left to go wrong is looked for where validators look, and taken away: ways end before
parts meet, and a part that cannot move becomes a piece of what carries it.

Every round shortens a way or takes a joint away, so there is an end, and at the end nothing meets.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.clearance import Mover, Shape, overlaps, shape_of_solids
from artgen.validate.sweep import Sweep, joints_between, sweep_poses, sweeps
from model.reconstruct.joints import LEAST_SLIDE, LEAST_TURN
from model.reconstruct.scene import Scene

WORTH = 2e-10
"""m3; a fifth of what validators call an overlap."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Meeting:
    """Two parts that share a volume at some poses of a sweep."""

    sweep: Sweep
    pair: tuple[str, str]
    poses: tuple[int, ...]


def proven(scene: Scene) -> Scene:
    """The scene in which no two parts meet where validators look."""
    while found := first_meetings(scene):
        for meeting in found:
            scene = _without(scene, meeting)
    return scene


def first_meetings(scene: Scene) -> list[Meeting]:
    """The worst meeting of every joint; those at rest alone where there are any."""
    shapes = {name: shape_of_solids([solid]) for name, solid in scene.solids.items()}
    listed = list(sweeps(scene.joints, scene.rules))
    still = list(meetings(scene, shapes, listed[0]))
    if still:
        return still[:1]
    found: dict[str, Meeting] = {}
    for sweep in listed[1:]:
        for meeting in meetings(scene, shapes, sweep):
            known = found.get(sweep.joint)
            if known is None or nearest(meeting) < nearest(known):
                found[sweep.joint] = meeting
    return list(found.values())


def meetings(scene: Scene, shapes: Mapping[str, Shape], sweep: Sweep) -> Iterator[Meeting]:
    """Pairs that meet while a joint moves, of those whose relative place it changes."""
    names = list(scene.solids)
    poses = sweep_poses(scene.base, scene.joints, sweep)
    movers = [Mover(name=name, shape=shapes[name], poses=poses[name]) for name in names]
    places = [scene.base, *(joint.child for joint in scene.joints)]
    pairs = [
        (names.index(places[i]), names.index(places[j]))
        for (i, j), between in joints_between(scene.base, scene.joints).items()
        if not sweep.joint or sweep.joint in between
    ]
    met: dict[tuple[str, str], list[int]] = {}
    for overlap in overlaps(movers, [(min(pair), max(pair)) for pair in pairs]):
        if overlap.volume > WORTH:
            met.setdefault((overlap.first, overlap.second), []).append(overlap.pose)
    for pair, at in met.items():
        yield Meeting(sweep=sweep, pair=pair, poses=tuple(at))


def nearest(meeting: Meeting) -> float:
    """How far from rest two parts meet first, rad or m."""
    path = path_of(meeting.sweep)
    return float(np.abs(path[list(meeting.poses)]).min())


def path_of(sweep: Sweep) -> Floats:
    """q of the swept joint at every pose."""
    return np.array([state[sweep.joint] for state in sweep.states])


def _without(scene: Scene, meeting: Meeting) -> Scene:
    """The scene without one meeting."""
    pair, name = meeting.pair, meeting.sweep.joint
    if not name:
        return _still(scene, pair)
    if name not in {joint.name for joint in scene.joints}:
        return scene  # It was taken away for another meeting of this round.
    moved = scene.moved_by(name)
    what = next(part for part in pair if part not in moved)
    ended = scene.ended(meeting.sweep, meeting.poses, what)
    if ended.joints == scene.joints or too_short(ended, name):
        return scene.fixed(name, f"it meets {what} where it leaves rest")
    return ended


def _still(scene: Scene, pair: Sequence[str]) -> Scene:
    """Parts that meet at rest become one, or pieces of what carries them."""
    one, other = pair
    if other == scene.base or other in scene.carriers(one):
        one, other = other, one
    return scene.fixed(scene.joint_of(other).name, f"it cannot be parted from {one}")


def too_short(scene: Scene, name: str) -> bool:
    """Whether a joint's way is no way any more."""
    least = LEAST_SLIDE if scene.joint(name).type == "prismatic" else LEAST_TURN
    return scene.span(name) < least * (1.0 - 1e-9)
