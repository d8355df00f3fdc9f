"""Which part of a prediction stands for which part of the truth: by order, or by nearness."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from artgen.core.mesh import Floats

FAR = 9_999_999.0
"""The cost of pairing a part with padding, as SINGAPO has it."""


@dataclass(frozen=True)
class Matching:
    """Pairs of parts, one to one.

    Attributes:
        pairs: (predicted, true) indices in the order of the true ones.
        loose_predicted: predicted parts that stand for none.
        loose_true: true parts that none stands for.
    """

    pairs: tuple[tuple[int, int], ...]
    loose_predicted: tuple[int, ...]
    loose_true: tuple[int, ...]

    @property
    def of_true(self) -> dict[int, int]:
        """True part to predicted part."""
        return {true: predicted for predicted, true in self.pairs}


def _matching(pairs: Sequence[tuple[int, int]], predicted: int, true: int) -> Matching:
    taken_predicted, taken_true = {p for p, _ in pairs}, {t for _, t in pairs}
    return Matching(
        pairs=tuple(sorted(pairs, key=lambda pair: pair[1])),
        loose_predicted=tuple(k for k in range(predicted) if k not in taken_predicted),
        loose_true=tuple(k for k in range(true) if k not in taken_true),
    )


def by_order(predicted: int, true: int) -> Matching:
    """Part k stands for part k; ART's slots are such an order."""
    return _matching([(k, k) for k in range(min(predicted, true))], predicted, true)


def by_nearness(predicted: Floats, true: Floats, *, base: bool = True) -> Matching:
    """The one-to-one pairs of (P, 3) and (Q, 3) points with the least sum of distances.

    Args:
        base: the first points are paired with each other beforehand.
    """
    skip = 1 if base else 0
    rows, columns = linear_sum_assignment(cdist(predicted[skip:], true[skip:]))
    pairs = [(skip + int(r), skip + int(c)) for r, c in zip(rows, columns, strict=True)]
    return _matching([*([(0, 0)] if base else []), *pairs], len(predicted), len(true))


def singapo_mapping(source: Floats, target: Floats) -> list[int]:
    """For each of (P, 3) source centers the target that SINGAPO compares it with.

    An optimal one-to-one pairing; sources that are left over get their nearest target, which then
    serves more than one. Bases are not paired beforehand.
    """
    most = max(len(source), len(target))
    cost = np.full((most, most), FAR)
    cost[: len(source), : len(target)] = cdist(source, target)
    rows, columns = linear_sum_assignment(cost)
    nearest = cost[: len(source)].argmin(axis=1)
    paired = dict(zip(rows.tolist(), columns.tolist(), strict=True))
    return [paired[k] if paired[k] < len(target) else int(nearest[k]) for k in range(len(source))]
