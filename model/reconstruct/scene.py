"""Parts and joints while they are being fitted to each other; every change makes a new value."""

import dataclasses
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.states import travel
from artgen.articulation.types import Joint, Limit, Precondition
from artgen.geometry.solid import Solid
from artgen.validate.sweep import Sweep, sweeps

POSES = 21
"""Places along a joint's way at which parts are cut, those where validators look."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """Parts and joints between them; the base is the first part, parents come before children.

    Attributes:
        rules: which joint waits for which.
        joined: parts that became pieces of others, by the name of the other.
        changes: what was done so far, a sentence each.
    """

    solids: Mapping[str, Solid]
    joints: tuple[Joint, ...]
    rules: tuple[Precondition, ...] = ()
    joined: Mapping[str, str] = dataclasses.field(default_factory=dict)
    changes: tuple[str, ...] = ()

    @property
    def base(self) -> str:
        """The fixed part."""
        return next(iter(self.solids))

    def joint(self, name: str) -> Joint:
        """The joint of that name."""
        return next(joint for joint in self.joints if joint.name == name)

    def joint_of(self, part: str) -> Joint:
        """The joint that moves a part."""
        return next(joint for joint in self.joints if joint.child == part)

    def carriers(self, part: str) -> set[str]:
        """All parts that a part hangs on, directly or not."""
        parents = {joint.child: joint.parent for joint in self.joints}
        found = set()
        while part in parents:
            part = parents[part]
            found.add(part)
        return found

    def moved_by(self, joint: str) -> set[str]:
        """The part that a joint moves, and all that hang on it."""
        child = self.joint(joint).child
        return {name for name in self.solids if name == child or child in self.carriers(name)}

    def way(self, joint: str, others: Mapping[str, float] | None = None) -> Sweep:
        """A joint through its whole way while others are held."""
        path = np.linspace(*travel(self.joint(joint)), POSES).tolist()
        return Sweep(joint=joint, states=tuple({**(others or {}), joint: q} for q in path))

    def span(self, joint: str) -> float:
        """From one end of a joint's way to the other, rad or m."""
        lower, upper = travel(self.joint(joint))
        return upper - lower

    def told(self, *changes: str) -> "Scene":
        """The same with more to tell."""
        return dataclasses.replace(self, changes=(*self.changes, *changes))

    def with_solid(self, part: str, solid: Solid) -> "Scene":
        """The same with another shape of one part."""
        return dataclasses.replace(self, solids={**self.solids, part: solid})

    def with_joint(self, joint: Joint) -> "Scene":
        """The same with another joint of that name."""
        joints = tuple(joint if own.name == joint.name else own for own in self.joints)
        return dataclasses.replace(self, joints=joints)

    def with_rule(self, joint: str, requires: str, at_least: float) -> "Scene":
        """The same where one joint waits for another."""
        rule = Precondition(joint=joint, requires=requires, at_least=at_least)
        return dataclasses.replace(self, rules=(*self.rules, rule))

    def piece_of(self, part: str) -> str:
        """The part that holds a part, which may be itself."""
        while part in self.joined:
            part = self.joined[part]
        return part

    def fixed(self, joint: str, why: str) -> "Scene":
        """The same without a joint: the part that it moved is a piece of what carried it."""
        gone = self.joint(joint)
        solids = {name: solid for name, solid in self.solids.items() if name != gone.child}
        solids[gone.parent] = solids[gone.parent] | self.solids[gone.child]
        joints = tuple(
            dataclasses.replace(own, parent=gone.parent) if own.parent == gone.child else own
            for own in self.joints
            if own.name != joint
        )
        scene = dataclasses.replace(
            self,
            solids=solids,
            joints=joints,
            rules=tuple(rule for rule in self.rules if joint not in (rule.joint, rule.requires)),
            joined={**self.joined, gone.child: gone.parent},
        )
        return scene.told(f"{gone.child} became a piece of {gone.parent}: {why}")

    def renamed(self, names: Mapping[str, str]) -> "Scene":
        """The same with parts, their joints and the sentences about them under other names."""

        def new(text: str) -> str:
            return re.sub(r"part_\d+", lambda found: names.get(found[0], found[0]), text)

        return Scene(
            solids={new(name): solid for name, solid in self.solids.items()},
            joints=tuple(
                dataclasses.replace(
                    own, name=new(own.name), parent=new(own.parent), child=new(own.child)
                )
                for own in self.joints
            ),
            rules=tuple(
                dataclasses.replace(rule, joint=new(rule.joint), requires=new(rule.requires))
                for rule in self.rules
            ),
            joined={new(part): new(other) for part, other in self.joined.items()},
            changes=tuple(map(new, self.changes)),
        )

    def ended(self, sweep: Sweep, met: Sequence[int], what: str) -> "Scene":
        """The same with the swept joint's way ended a step before the poses at which it meets
        something, and rules that ask for more of it with it; told where it cannot move at all."""
        joint = self.joint(sweep.joint)
        path = np.array([state[joint.name] for state in sweep.states])
        rest = int(np.argmin(np.abs(path)))
        upper = path[max(min([p for p in met if p >= rest], default=len(path)) - 1, rest)]
        lower = path[min(max([p for p in met if p <= rest], default=-1) + 1, rest)]
        if not lower < upper:
            return self.told(f"{joint.name} cannot leave rest for {what}; its way was left as is")
        if path[0] < 0.0:  # Rest stays in the middle of what turns both ways.
            upper = min(-lower, upper)
            lower = -upper
        if not upper > 0.0:
            return self.told(f"{joint.name} cannot leave rest for {what}; its way was left as is")
        limit = Limit(lower=float(lower) + 0.0, upper=float(upper))
        kind = "revolute" if joint.type == "continuous" else joint.type
        scene = self.with_joint(dataclasses.replace(joint, type=kind, limit=limit))
        rules = tuple(
            dataclasses.replace(rule, at_least=min(rule.at_least, limit.upper))
            if rule.requires == joint.name
            else rule
            for rule in self.rules
        )
        return dataclasses.replace(scene, rules=rules).told(
            f"{joint.name} ends at {upper:.3g}, where it meets {what}"
        )


def sweeps_of(scene: Scene, joint: str) -> list[Sweep]:
    """What a joint is swept by: once, or with what it waits for just open and wide open."""
    return [sweep for sweep in sweeps(scene.joints, scene.rules, POSES) if sweep.joint == joint]
