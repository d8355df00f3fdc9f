"""Which donors suit a slot, how even their use is kept, and which is taken."""

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.assembly.library import Entry, Library, is_slot
from artgen.core.mesh import Floats
from artgen.core.stream import Stream

RATIO = 2.0
"""Greatest factor between the proportions of a donor's face and the slot's."""
WHOLE_RATIO = 1.35
"""The same for parts that are scaled as a whole."""
THICKER = 3.0
"""Greatest factor between thicknesses."""
SIZE = 2.5
"""Greatest factor between sizes."""
ALIKE = 0.05
"""Slots whose sides agree within this share are of one group."""
ONE_DONOR = 0.8
"""Chance that all slots of a group take one donor."""
ONE_STYLE = 0.7
"""Chance that all groups of an object take donors of one source where it has some."""
OWN = 0.5
"""An object that keeps a greater share of its own fronts is no new one."""
EDGED = 0.2
"""Chance that an object prefers fronts that are gripped at their own edges; else it prefers fronts
with handles."""
ROUNDS = 12
"""Of evening out the use of donors; it changes by under 1 % in the last."""


def suits(donor: Entry, slot: Entry) -> bool:
    """Whether a donor's body can take the place of a slot's."""
    if donor.source == slot.source or donor.split != slot.split or "print" in donor.stuffs:
        return False
    if (donor.label, donor.kind, donor.joint) != (slot.label, slot.kind, slot.joint):
        return False
    if donor.side != slot.side and {donor.side, slot.side} != {"left", "right"}:
        return False
    if slot.side == "along" and donor.handle:
        return False
    thick = slot.depth / donor.depth
    whole = slot.kind == "whole"
    scales = [slot.width / donor.width, slot.height / donor.height, *([thick] if whole else ())]
    return (
        max(scales) / min(scales) <= (WHOLE_RATIO if whole else RATIO)
        and 1.0 / THICKER <= thick <= THICKER
        and all(1.0 / SIZE <= scale <= SIZE for scale in scales)
    )


@dataclass(frozen=True, kw_only=True)
class Group:
    """Slots that are alike, and the donors that suit all of them, best first."""

    slots: tuple[Entry, ...]
    donors: tuple[Entry, ...]


class Market:
    """Which donors suit which slots, over a whole library, and weights that even out their use."""

    def __init__(self, library: Library, categories: Sequence[str]) -> None:
        self.library = library
        self._candidates = library.templates(categories)
        self.donors = tuple(entry for entry in library.entries if is_slot(entry))
        self.handles = tuple(_distinct(entry for entry in library.entries if entry.handle))

    @cached_property
    def template_ids(self) -> tuple[str, ...]:
        """Templates of which more than half of the slots have a donor."""
        suited: dict[str, list[bool]] = defaultdict(list)
        for (template, _), places in self.suitable.items():
            suited[template].append(bool(places))
        return tuple(id for id in self._candidates if np.mean(suited[id]) > OWN)

    @cached_property
    def suitable(self) -> Mapping[tuple[str, int], tuple[int, ...]]:
        """(template, number) to the places in `donors` of those that suit the slot."""
        chosen = set(self._candidates)
        by_kind: dict[tuple[str, str, str], list[int]] = defaultdict(list)
        for place, donor in enumerate(self.donors):
            by_kind[donor.label, donor.kind, donor.split].append(place)
        return {
            (slot.source, slot.number): tuple(
                place
                for place in by_kind[slot.label, slot.kind, slot.split]
                if suits(self.donors[place], slot)
            )
            for slot in self.donors
            if slot.source in chosen
        }

    @cached_property
    def weights(self) -> Floats:
        """(D,) weight of each donor such that, over all templates, all that suit any slot are used
        about equally often (proportional fitting of rows and columns)."""
        weight = np.ones(len(self.donors))
        rows = [np.array(places) for places in self.suitable.values() if places]
        for _ in range(ROUNDS):
            use = np.zeros(len(weight))
            for places in rows:
                use[places] += weight[places] / weight[places].sum()
            used = use > 0.0
            weight[used] *= np.sqrt(use[used].mean() / use[used])
        return weight

    def expected_use(self) -> Floats:
        """(D,) share of all slots that each donor fills if every template comes equally often and
        first choices fit."""
        use = np.zeros(len(self.donors))
        chosen = set(self.template_ids)
        for (template, _), places in self.suitable.items():
            if template in chosen and places:
                own = list(places)
                use[own] += self.weights[own] / self.weights[own].sum()
        return np.asarray(use / use.sum())

    def usable(self) -> frozenset[int]:
        """Places of donors that suit some slot of some template."""
        return frozenset(place for places in self.suitable.values() for place in places)

    def groups(self, template: str, stream: Stream) -> list[Group]:
        """The slots of a template in groups that are alike, each with donors in the order in which
        they are tried."""
        rng = stream.child("groups").generator()
        slots = [e for e in self.library.members(template) if is_slot(e)]
        apart = rng.random() >= ONE_DONOR
        alike = [[slot] for slot in slots] if apart else _clusters(slots)
        sources = sorted({d.source for s in slots for d in self._suited(s)})
        one_style = bool(sources) and rng.random() < ONE_STYLE
        style = sources[int(rng.integers(len(sources)))] if one_style else None
        edged = bool(rng.random() < EDGED)
        ordered = (self._ordered(group, stream.child("donor", k)) for k, group in enumerate(alike))
        return [
            Group(
                slots=tuple(group),
                donors=tuple(sorted(donors, key=lambda d: (d.edge != edged, d.source != style))),
            )
            for group, donors in zip(alike, ordered, strict=True)
        ]

    def _suited(self, slot: Entry) -> list[Entry]:
        return [self.donors[place] for place in self.suitable[slot.source, slot.number]]

    def _ordered(self, group: Sequence[Entry], stream: Stream) -> list[Entry]:
        """Donors that suit every slot of a group, drawn by weight."""
        places = [self.suitable[slot.source, slot.number] for slot in group]
        common = sorted(set(places[0]).intersection(*places[1:]))
        if not common:
            return []
        # Drawing without replacement by weight is sorting by log(uniform) / weight (Efraimidis and
        # Spirakis 2006).
        draw = np.log(stream.generator().random(len(common))) / self.weights[common]
        return [self.donors[common[k]] for k in np.argsort(-draw)]

    def handle_order(self, split: str, stream: Stream) -> list[Entry]:
        """Handles that a split offers in the order in which they are tried.

        Those that another split offers are left out of what was drawn, so that they move no other.
        """
        own = [entry for entry in self.handles if entry.split == split]
        drawn = [own[k] for k in stream.generator().permutation(len(own))]
        offered = self.library.handle_splits
        return [entry for entry in drawn if offered[entry.handle_shape] == split]


def _distinct(entries: Iterable[Entry]) -> list[Entry]:
    """One entry for each shape of handle in each split."""
    found: dict[tuple[str, str], Entry] = {}
    for entry in entries:
        found.setdefault((entry.split, entry.handle_shape), entry)
    return list(found.values())


def _clusters(slots: Sequence[Entry]) -> list[list[Entry]]:
    """Slots of one kind whose width and height agree."""
    groups: list[list[Entry]] = []
    for slot in slots:
        for group in groups:
            if _alike(slot, group[0]):
                group.append(slot)
                break
        else:
            groups.append([slot])
    return groups


def _alike(one: Entry, other: Entry) -> bool:
    if (one.label, one.kind, one.joint) != (other.label, other.kind, other.joint):
        return False
    if one.side != other.side and {one.side, other.side} != {"left", "right"}:
        return False
    sides = ((one.width, other.width), (one.height, other.height))
    return all(abs(math.log(a / b)) <= ALIKE for a, b in sides)
