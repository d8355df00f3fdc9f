"""Matchings: by order, nearest in sum, and SINGAPO's many-to-one."""

from itertools import permutations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from model.evaluation.matching import by_nearness, by_order, singapo_mapping

points = st.lists(st.tuples(*[st.floats(-1.0, 1.0)] * 3), min_size=1, max_size=5, unique=True).map(
    lambda rows: np.array(rows, float)
)


def test_by_order_leaves_the_rest_loose() -> None:
    matching = by_order(4, 2)
    assert matching.pairs == ((0, 0), (1, 1))
    assert matching.loose_predicted == (2, 3)
    assert matching.loose_true == ()


@given(points, points)
def test_by_nearness_has_the_least_sum_of_all(first: np.ndarray, second: np.ndarray) -> None:
    matching = by_nearness(first, second, base=False)
    found = sum(np.linalg.norm(first[p] - second[t]) for p, t in matching.pairs)
    few, many = sorted((first, second), key=len)
    least = min(
        sum(np.linalg.norm(few[k] - many[j]) for k, j in enumerate(order))
        for order in permutations(range(len(many)), len(few))
    )
    assert abs(found - least) <= 1e-12  # Ten roundings of distances below 4.
    assert len(matching.pairs) + len(matching.loose_true) == len(second)
    assert len(matching.pairs) + len(matching.loose_predicted) == len(first)


def test_bases_are_paired_beforehand() -> None:
    first = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    assert by_nearness(first, first[::-1]).pairs == ((0, 0), (1, 1))
    assert by_nearness(first, first[::-1], base=False).pairs == ((1, 0), (0, 1))


@given(points, points)
def test_singapo_gives_leftovers_their_nearest(first: np.ndarray, second: np.ndarray) -> None:
    mapping = singapo_mapping(first, second)
    paired = by_nearness(first, second, base=False)
    assert len(mapping) == len(first)
    cost = sum(np.linalg.norm(first[p] - second[mapping[p]]) for p, _ in paired.pairs)
    if len(first) <= len(second):
        assert len(set(mapping)) == len(first)
    for loose in range(len(first)):
        gaps = np.linalg.norm(second - first[loose], axis=1)
        used_twice = mapping.count(mapping[loose]) > 1
        assert not used_twice or gaps[mapping[loose]] >= gaps.min()
    assert cost >= 0.0


def test_a_third_part_shares_the_nearest_target() -> None:
    first = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.2, 0.0, 0.0)])
    assert singapo_mapping(first, first[:2]) == [0, 1, 1]
    assert singapo_mapping(first[:2], first) == [0, 1]
