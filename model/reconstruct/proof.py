"""What is left to go wrong is looked for where validators look, and taken away: ways end before
parts meet, joints wait for no two others that meet where they are waited for, and a part that
cannot move becomes a piece of what carries it.

Every round shortens a way, or takes a rule or a joint away, so there is an end, and at the end
nothing meets.
"""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from artgen.articulation.states import required_state
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
    """The worst meeting of every joint; those at rest alone where there are any, and those of what
    joints wait for only where there are no others."""
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
    if found:
        return list(found.values())
    held = (own for sweep in listed[1:] for own in held_meetings(scene, shapes, sweep))
    return list(islice(held, 1))


def meetings(scene: Scene, shapes: Mapping[str, Shape], sweep: Sweep) -> Iterator[Meeting]:
    """Pairs that meet while a joint moves, of those whose relative place it changes."""
    pairs = [pair for pair, between in _between(scene) if not sweep.joint or sweep.joint in between]
    return _met(scene, shapes, sweep, pairs)


def held_meetings(scene: Scene, shapes: Mapping[str, Shape], sweep: Sweep) -> Iterator[Meeting]:
    """Pairs that meet where the joints are that the swept one waits for, and that it leaves be."""
    waited = {name for name, q in sweep.states[0].items() if q != 0.0} - {sweep.joint}
    pairs = [
        pair
        for pair, between in _between(scene)
        if sweep.joint not in between and waited.intersection(between)
    ]
    at = dataclasses.replace(sweep, states=sweep.states[:1])
    return _met(scene, shapes, at, pairs) if pairs else iter(())


def _between(scene: Scene) -> Iterator[tuple[tuple[int, int], tuple[str, ...]]]:
    """Two parts by their places among the solids, the smaller first, and the joints between."""
    names = list(scene.solids)
    places = [names.index(part) for part in (scene.base, *(own.child for own in scene.joints))]
    for (i, j), between in joints_between(scene.base, scene.joints).items():
        yield (min(places[i], places[j]), max(places[i], places[j])), between


def _met(
    scene: Scene, shapes: Mapping[str, Shape], sweep: Sweep, pairs: Sequence[tuple[int, int]]
) -> Iterator[Meeting]:
    """Those of some pairs that share a volume at poses of a sweep."""
    poses = sweep_poses(scene.base, scene.joints, sweep)
    movers = [Mover(name=name, shape=shapes[name], poses=poses[name]) for name in scene.solids]
    met: dict[tuple[str, str], list[int]] = {}
    for overlap in overlaps(movers, pairs):
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
    if name not in {joint.name for joint in scene.joints} or not scene.solids.keys() >= set(pair):
        return scene  # It was taken away for another meeting of this round.
    moved = scene.moved_by(name)
    if (pair[0] in moved) == (pair[1] in moved):
        return _unruled(scene, meeting)
    what = next(part for part in pair if part not in moved)
    ended = scene.ended(meeting.sweep, meeting.poses, what)
    if ended.joints == scene.joints or too_short(ended, name):
        return scene.fixed(name, f"it meets {what} where it leaves rest")
    return ended


def _unruled(scene: Scene, meeting: Meeting) -> Scene:
    """The scene without the last of a joint's rules that bring two others together: it would wait
    for what cannot be."""
    name, (one, other) = meeting.sweep.joint, meeting.pair
    chains = [{part} | scene.carriers(part) for part in meeting.pair]
    apart = {scene.joint_of(part).name for part in chains[0] ^ chains[1]}
    asked = [
        rule
        for rule in scene.rules
        if rule.joint == name
        and apart.intersection({rule.requires, *required_state(rule.requires, scene.rules)})
    ]
    rules = tuple(rule for rule in scene.rules if rule != asked[-1])
    told = f"{name} waits no more for {asked[-1].requires}: {one} and {other} would meet there"
    return dataclasses.replace(scene, rules=rules).told(told)


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
