"""The tables of `artgen study coverage`."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from artgen.coverage_study.drawn import Drawn
from artgen.coverage_study.neighbours import Neighbour
from artgen.rules.distributions import Chance, Choice
from artgen.rules.schema import CategoryRule

FEW_DIGITS = "{:.4g}"


@dataclass(frozen=True, kw_only=True)
class Coverage:
    """One category.

    Attributes:
        numbers: parameters that are numbers drawn from a range.
        choices: parameters that are one of a list, or true or false.
        tries: samples drawn for one that meets all invariants, mean.
        topologies: distinct kinematic trees, names left out.
        structures: distinct lists of bodies by part and material.
        kinds: kinds of joints that occur.
        depth: joints on the longest chain.
        nearest, median: share of pixels that differ from the nearest neighbor, least and median.
        twins: objects of which another hardly differs in shape.
    """

    category: str
    objects: int
    numbers: int
    choices: int
    tries: float
    topologies: int
    structures: int
    least_parts: int
    most_parts: int
    kinds: str
    depth: int
    nearest: float
    median: float
    twins: int


@dataclass(frozen=True, kw_only=True)
class ParameterRow:
    """How one parameter came out: what was drawn after invariants threw some draws away.

    Attributes:
        rule: what it is drawn from.
        found: least, median and greatest of a number; each option with its share of a choice.
        unused: options that no object has.
    """

    category: str
    parameter: str
    rule: str
    found: str
    unused: str


@dataclass(frozen=True, kw_only=True)
class CategoryCoverage:
    """All that is told of one category."""

    row: Coverage
    parameters: tuple[ParameterRow, ...]
    nearest: tuple[Neighbour, ...]


def from_json(data: Mapping[str, Any]) -> CategoryCoverage:
    """What `plain` made of one."""
    return CategoryCoverage(
        row=Coverage(**data["row"]),
        parameters=tuple(ParameterRow(**entry) for entry in data["parameters"]),
        nearest=tuple(Neighbour(**entry) for entry in data["nearest"]),
    )


def coverage(
    rule: CategoryRule, objects: Sequence[Drawn], nearest: Sequence[Neighbour]
) -> Coverage:
    """The row of one category."""
    listed = [isinstance(draw.distribution, Choice | Chance) for draw in rule.draws.values()]
    parts = [sum(drawn.roles.values()) for drawn in objects]
    apart = [n.differing for n in nearest]
    return Coverage(
        category=rule.name,
        objects=len(objects),
        numbers=listed.count(False),
        choices=listed.count(True),
        tries=float(np.mean([drawn.tries for drawn in objects])),
        topologies=len({drawn.topology for drawn in objects}),
        structures=len({drawn.structure for drawn in objects}),
        least_parts=min(parts),
        most_parts=max(parts),
        kinds=" ".join(sorted({kind for drawn in objects for kind in drawn.kinds})),
        depth=max(drawn.depth for drawn in objects),
        nearest=min(apart),
        median=float(np.median(apart)),
        twins=sum(n.twin for n in nearest),
    )


def parameter_rows(rule: CategoryRule, objects: Sequence[Drawn]) -> list[ParameterRow]:
    """One row a parameter."""
    rows = []
    for key, draw in rule.draws.items():
        values = column(objects, key)
        counts = Counter(values) if _is_listed(values) else None
        options = draw.distribution.options if isinstance(draw.distribution, Choice) else ()
        rows.append(
            ParameterRow(
                category=rule.name,
                parameter=key,
                rule=str(draw.distribution),
                found=_spread(values) if counts is None else _shares(counts),
                unused=" ".join(str(o) for o in options if o not in set(values)),
            )
        )
    return rows


def column(objects: Sequence[Drawn], key: str) -> list[object]:
    """All values of a parameter; those of a tuple one after another."""
    values: list[object] = []
    for drawn in objects:
        value = drawn.params[key]
        values += value if isinstance(value, list) else [value]
    return values


def _is_listed(values: Sequence[object]) -> bool:
    return not all(isinstance(value, float) for value in values)


def _shares(counts: Counter[object]) -> str:
    total = counts.total()
    return " ".join(f"{value} {counts[value] / total:.0%}" for value in sorted(counts, key=str))


def _spread(values: Sequence[object]) -> str:
    numbers = np.array(values, float)
    return " ".join(FEW_DIGITS.format(v) for v in np.percentile(numbers, (0, 50, 100)))
