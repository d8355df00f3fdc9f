"""Parts made disjoint, at rest and along their ways: the base gives way, then what carries another,
then what is larger.

Predicted parts overlap by about a step of the grid they were extracted from. The cover of a part,
grown by the clearance, is cut out of its neighbor by exact booleans; parts that are sunk deep into
each other are parted by a plane. Where a way would eat too much, two moving parts wait for each
other (a drawer behind a door), or the joint's way ends there.
"""

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.states import travel
from artgen.core.mesh import Floats
from artgen.geometry.clearance import Mover, inverted_poses, overlaps, shape_of_solids
from artgen.geometry.solid import Solid, union
from artgen.validate.sweep import Sweep, sweep_poses
from model.reconstruct.cover import Convex, convex_cover, grown, swept
from model.reconstruct.freedom import have_ways_out
from model.reconstruct.planes import Parting, partings
from model.reconstruct.scene import Scene, sweeps_of
from model.reconstruct.shapes import mended, sound

MOST_INSIDE = 0.08
"""Share of a moving part that may lie inside another on its way and be taken for noise."""
MOST_EATEN = 0.2
"""Share of its volume that a part may lose to another's way."""
MOST_SWALLOWED = 0.6
"""The same at rest; beyond, a plane parts the two."""
DEEP = 0.15
"""Share of the smaller of two parts, neither of which carries the other, that may lie in the other
and be cut out of it; beyond, a plane parts the two."""
WIDE = 2.5
"""Clearances between parts that a plane parts, so that their covers, too, keep apart."""
MOST_PARTED = 0.8
"""Share of its volume that a plane may take; beyond, the part that hangs on the other becomes a
piece of what carries it."""
MOST_ASIDE = 0.5
"""The same of a plane that takes more than another, which would leave a part no way out."""
MOST_GIVEN = 0.5
"""The same where its way would else be all but lost."""
LEAST_LEFT = 0.4
"""Share of its way that a joint keeps at least, if cutting can help it."""
HARDLY = 0.002
"""Share of its volume that a part may lose without a word."""
KEPT = 0.95
"""Share of its volume that a part has kept where its cover still serves."""
SLACK = 0.1
"""Share of the clearance by which merging triangles may move a cut surface."""
WORTH = 1e-10
"""m3; a tenth of what validators call an overlap."""


class Cutter:
    """Covers of parts, made when first needed; a part that shrinks a little keeps its cover.

    Args:
        clearance: m of air between parts at rest.
    """

    def __init__(self, clearance: float) -> None:
        self.clearance = clearance
        self._covers: dict[str, tuple[float, Convex]] = {}

    def tool(self, scene: Scene, name: str) -> Convex:
        """What is cut out for a part."""
        volume = scene.solids[name].volume
        known, cover = self._covers.get(name, (0.0, ()))
        if not KEPT * known <= volume <= known:
            plain = convex_cover(scene.solids[name], tolerance=0.5 * self.clearance)
            cover = grown(plain, 1.5 * self.clearance)
            self._covers[name] = volume, cover
        return cover

    def mended(self, solid: Solid) -> Solid:
        """A cut solid without slivers."""
        return mended(solid, SLACK * self.clearance)


def apart_at_rest(scene: Scene, cutter: Cutter) -> Scene:
    """No two parts nearer than the clearance at rest; small winners are cut out first.

    Raises:
        GeometryError: a part lies wholly inside another that it gives way to.
    """
    names = sorted(scene.solids, key=lambda name: scene.solids[name].volume)
    for place, one in enumerate(names):
        for other in names[place + 1 :]:
            if one in scene.solids and other in scene.solids:
                scene = _apart(scene, cutter, *ranked(scene, one, other))
    return scene


def _apart(scene: Scene, cutter: Cutter, loses: str, wins: str) -> Scene:
    """Two parts apart at rest, by the cover of one or by a plane."""
    eaten = _eaten(scene, cutter, loses, wins)
    if eaten == 0.0:
        return scene
    if eaten > MOST_SWALLOWED or (
        loses != scene.base and loses not in scene.carriers(wins) and _deep(scene, loses, wins)
    ):
        return _parted(scene, loses, wins, WIDE * cutter.clearance)
    return _given_way(scene, cutter, loses, wins)


def _deep(scene: Scene, one: str, other: str) -> bool:
    """Whether a good share of one of two parts lies in the other."""
    solids = scene.solids[one], scene.solids[other]
    return (solids[0] & solids[1]).volume > DEEP * min(solid.volume for solid in solids)


def _parted(scene: Scene, loses: str, wins: str, gap: float) -> Scene:
    """Two parts on the sides of a plane: the one that takes least, but for one that leaves a part
    behind the other for good where another plane does not."""
    found = [
        own
        for own in partings(scene.solids[loses], scene.solids[wins], gap)
        if own.lost <= MOST_PARTED
    ]
    if not found:
        return scene.fixed(scene.joint_of(wins).name, f"it cannot be told from {loses}")
    least = _with_parting(scene, loses, wins, found[0])
    if have_ways_out(least, loses, wins):
        return least
    for own in found[1:]:
        beside = _with_parting(scene, loses, wins, own)
        if own.lost <= MOST_ASIDE and have_ways_out(beside, loses, wins):
            return beside.told(
                f"a plane across {'xyz'[found[0].axis]} would have taken less, but left one of "
                "them no way out"
            )
    return least


def _with_parting(scene: Scene, loses: str, wins: str, found: Parting) -> Scene:
    told = (
        f"{loses} and {wins} were sunk into each other; a plane across {'xyz'[found.axis]} parts "
        f"them, which took {found.lost:.0%} of one at most"
    )
    return scene.with_solid(loses, found.one).with_solid(wins, found.other).told(told)


def _eaten(scene: Scene, cutter: Cutter, loses: str, wins: str) -> float:
    """Share of its volume that a part would lose to another and its clearance."""
    whole = scene.solids[loses]
    shared = (whole & union(cutter.tool(scene, wins))).volume
    return 0.0 if shared <= WORTH else shared / whole.volume


def _given_way(scene: Scene, cutter: Cutter, loses: str, wins: str) -> Scene:
    """A part without what another and its clearance take."""
    whole = scene.solids[loses]
    left = cutter.mended(whole - union(cutter.tool(scene, wins)))
    share = 1.0 - left.volume / whole.volume
    told = f"{loses} gave way to {wins} at rest, by {share:.1%} of its volume"
    return scene.with_solid(loses, left).told(*([told] if share > HARDLY else []))


def ranked(scene: Scene, one: str, other: str) -> tuple[str, str]:
    """Who gives way, then who does not: the base, else what carries the other, else the larger."""
    for first, second in ((one, other), (other, one)):
        if first == scene.base or first in scene.carriers(second):
            return first, second
    larger = scene.solids[one].volume > scene.solids[other].volume
    return (one, other) if larger else (other, one)


def clear_ways(scene: Scene, cutter: Cutter) -> Scene:
    """Every joint's way free: parts are cut, wait for others, or end their way sooner."""
    for name in [joint.name for joint in scene.joints]:
        for pair in _pairs(scene, name):  # Ways end, but joints and parts stay.
            for sweep in sweeps_of(scene, name):
                scene = _cleared(scene, cutter, sweep, pair)
    return scene


def _pairs(scene: Scene, joint: str) -> list[tuple[str, str]]:
    """Who would give way to whom, of parts that a joint moves relative to each other; pairs with
    the base come last, as shorter ways cost it less."""
    moved = scene.moved_by(joint)
    pairs = [ranked(scene, own, other) for own in moved for other in scene.solids
             if other not in moved]  # fmt: skip
    return sorted(pairs, key=lambda pair: pair[0] == scene.base)


def _cleared(scene: Scene, cutter: Cutter, sweep: Sweep, pair: tuple[str, str]) -> Scene:
    """Two parts out of each other's way while a joint goes through its range."""
    loses, wins = pair
    poses = sweep_poses(scene.base, scene.joints, sweep)
    course = inverted_poses(poses[loses]) @ poses[wins]
    tool, whole = cutter.tool(scene, wins), scene.solids[loses]
    shared = shared_volumes(tool, whole, course)
    met = np.flatnonzero(shared > WORTH)
    if not len(met):
        return scene
    limit = MOST_INSIDE * min(sum(piece.volume for piece in tool), whole.volume)
    deep = np.flatnonzero(shared > limit)
    left = whole - swept(tool, _around(course, met), within=whole.bounds)
    share = 1.0 - left.volume / whole.volume
    cut = scene.with_solid(loses, cutter.mended(left)) if share <= MOST_GIVEN else scene
    if share > HARDLY:
        told = f"{loses} gave way to {wins} along {sweep.joint}, by {share:.1%} of its volume"
        cut = cut.told(told)
    if not len(deep) and share <= MOST_EATEN:
        return cut
    if loses not in scene.carriers(wins) and (waits := _waiting(scene, cutter, sweep, pair)):
        return waits
    other = loses if wins in scene.moved_by(sweep.joint) else wins
    shorter = scene.ended(sweep, (deep if len(deep) else met).tolist(), other)
    stuck = shorter.span(sweep.joint) < LEAST_LEFT * scene.span(sweep.joint)
    blocked = shorter.joints == scene.joints
    if (stuck or blocked) and share <= MOST_GIVEN:
        return cut
    for rest in () if blocked else sweeps_of(shorter, sweep.joint):
        shorter = _cleared(shorter, cutter, rest, pair)
    return shorter


def _around(course: Floats, met: NDArray[np.intp]) -> Floats:
    """The poses from one before the first to one after the last of some."""
    return course[max(int(met[0]) - 1, 0) : int(met[-1]) + 2]


def shared_volumes(tool: Convex, still: Solid, course: Floats) -> Floats:
    """(K,) m3 that convex pieces share with a solid as they go through (K, 4, 4) poses; where
    pieces overlap it counts twice."""
    place = np.tile(np.eye(4), (len(course), 1, 1))
    movers = [
        Mover(name="tool", shape=shape_of_solids(tool), poses=course),
        Mover(name="still", shape=shape_of_solids([still]), poses=place),
    ]
    shared = np.zeros(len(course))
    for overlap in overlaps(movers):
        shared[overlap.pose] += overlap.volume
    return shared


SHARES = (0.5, 0.75, 1.0)
"""Shares of one joint's way at which it is looked whether another is free."""


def _waiting(scene: Scene, cutter: Cutter, sweep: Sweep, pair: tuple[str, str]) -> Scene | None:
    """The scene in which the swept joint waits for the one of the part it meets, where waiting
    helps."""
    moved = scene.moved_by(sweep.joint)
    met = pair[1] if pair[0] in moved else pair[0]
    other = scene.joint_of(met)
    if any(rule.joint == other.name and rule.requires == sweep.joint for rule in scene.rules):
        return None
    upper = travel(other)[1]
    for share in SHARES:
        least = share * upper
        held = ({other.name: least}, {other.name: upper})
        if all(_free(scene, cutter, scene.way(sweep.joint, others), pair) for others in held):
            scene = scene.with_rule(sweep.joint, other.name, least)
            return scene.told(f"{sweep.joint} waits until {other.name} is at {least:.3g}")
    return None


def _free(scene: Scene, cutter: Cutter, sweep: Sweep, pair: tuple[str, str]) -> bool:
    """Whether two parts do not meet on a way."""
    poses = sweep_poses(scene.base, scene.joints, sweep)
    course = inverted_poses(poses[pair[0]]) @ poses[pair[1]]
    shared = shared_volumes(cutter.tool(scene, pair[1]), scene.solids[pair[0]], course)
    return not (shared > WORTH).any()


def made_sound(scene: Scene) -> Scene:
    """Every part without triangles that finishing would flatten."""
    for name, solid in scene.solids.items():
        scene = scene.with_solid(name, sound(solid))
    return scene
