"""What one seed of a category is, without finishing it: parameters, kinematic tree, silhouettes."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.canonical import canonicalize
from artgen.articulation.types import Draft
from artgen.core.jsonio import content_hash, plain
from artgen.core.stream import Stream
from artgen.coverage_study.views import extent_of, views_of
from artgen.generators import load_builder
from artgen.rules import load_rule, sample


@dataclass(frozen=True, kw_only=True)
class DrawTask:
    """Seeds `start` up to `stop` of a category."""

    category: str
    seed: int
    start: int
    stop: int

    @property
    def asset_id(self) -> str:
        """Names the task in messages."""
        return f"{self.category}_{self.start:06d}"


@dataclass(frozen=True, kw_only=True, eq=False)
class Drawn:
    """One draft in numbers.

    Attributes:
        params: as drawn, by name.
        tries: samples drawn until every invariant held.
        topology: hash of the kinematic tree: roles and kinds of joints, names left out.
        structure: hash of the bodies of every part, by material.
        roles: role to number of parts.
        kinds: kind of joint to number of joints; coupled ones count as `mimic`.
        depth: joints on the longest chain.
        views: depth maps at rest and open, as `views_of` makes them.
    """

    category: str
    index: int
    params: Mapping[str, object]
    tries: int
    topology: str
    structure: str
    roles: Mapping[str, int]
    kinds: Mapping[str, int]
    depth: int
    views: NDArray[np.float32]


def draw_all(task: DrawTask) -> list[Drawn]:
    """Every seed of a task."""
    return [drawn(task.category, task.seed, index) for index in range(task.start, task.stop)]


def drawn(category: str, seed: int, index: int) -> Drawn:
    """One seed of a category."""
    builder = load_builder(category)
    rule = load_rule(category)
    sampled = sample(
        rule,
        Stream(seed, category, index),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )
    draft = canonicalize(builder.build(sampled.params, sampled.surfaces))
    return Drawn(
        category=category,
        index=index,
        params=plain(sampled.params),
        tries=sampled.tries,
        topology=topology(draft),
        structure=structure(draft),
        roles=Counter(part.label for part in draft.parts),
        kinds=Counter("mimic" if joint.mimic else joint.type for joint in draft.joints),
        depth=depth(draft),
        views=views_of(draft, extent=extent_of(rule)),
    )


def topology(draft: Draft) -> str:
    """A hash that two drafts share exactly if a renaming of parts makes their trees equal."""
    labels = {part.name: part.label for part in draft.parts}
    root = draft.parts[0].name

    def branch(name: str) -> list[object]:
        ways = [
            [joint.type, joint.mimic is not None, branch(joint.child)]
            for joint in draft.joints
            if joint.parent == name
        ]
        return [labels[name], sorted(ways, key=repr)]

    return content_hash(branch(root))[:12]


def structure(draft: Draft) -> str:
    """A hash of how many bodies of which material every part has."""
    counts = [Counter(body.surface for body in part.bodies) for part in draft.parts]
    return content_hash([sorted(count.items()) for count in counts])[:12]


def depth(draft: Draft) -> int:
    """Joints on the longest chain from the base."""
    level = {draft.parts[0].name: 0}
    for joint in draft.joints:  # Parents come first.
        level[joint.child] = level[joint.parent] + 1
    return max(level.values())
