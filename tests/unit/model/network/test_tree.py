"""Laws of parents out of logits: always a tree, the best parents where those already are one."""

import itertools

import pytest
import torch
from torch import Tensor

from model.network.heads import REFUSED
from model.network.tree import parents
from tests.unit.model.tiny_art import held


def refused(logits: Tensor, valid_BP: Tensor) -> Tensor:
    itself = torch.eye(valid_BP.shape[1], dtype=torch.bool)
    return logits.masked_fill(itself | ~valid_BP[:, None], REFUSED)


def assert_trees(parent_BP: Tensor, valid_BP: Tensor) -> None:
    for parent, valid in zip(parent_BP.tolist(), valid_BP.tolist(), strict=True):
        for slot, above in enumerate(parent):
            assert (above >= 0) == (valid[slot] and slot > 0)
            steps = 0
            while above > 0:
                assert valid[above]
                above, steps = parent[above], steps + 1
                assert steps < len(parent), parent


def test_answers_are_trees() -> None:
    torch.manual_seed(0)
    counts = tuple(1 + k % 8 for k in range(400))
    valid = held(counts, 8)
    assert_trees(parents(refused(torch.randn(400, 8, 8), valid), valid), valid)


def test_best_parents_are_kept_where_they_form_a_tree() -> None:
    valid = held((4,))
    for choice in itertools.product(range(4), repeat=3):
        parent = (0, *choice)
        logits = refused(torch.zeros(1, 4, 4), valid)
        for child, above in enumerate(parent):
            if child and child != above:
                logits[0, child, above] = 5.0
        if _is_tree(parent):
            assert parents(logits, valid).tolist() == [[-1, *choice]]


def _is_tree(parent: tuple[int, ...]) -> bool:
    for slot in range(1, len(parent)):
        above = slot
        for _ in parent:
            above = parent[above]
        if above != 0:
            return False
    return True


def test_a_circle_opens_where_that_costs_least() -> None:
    logits = refused(torch.zeros(1, 4, 4), held((4,)))
    logits[0, 1, 2] = logits[0, 2, 3] = logits[0, 3, 1] = 5.0
    logits[0, 2, 0] = 4.0
    assert parents(logits, held((4,))).tolist() == [[-1, 2, 0, 1]]


@pytest.mark.parametrize("slots", [1, 2, 3])
def test_few_slots(slots: int) -> None:
    valid = torch.ones(1, slots, dtype=torch.bool)
    assert_trees(parents(refused(torch.randn(1, slots, slots), valid), valid), valid)


def test_two_circles_open() -> None:
    valid = held((5,), 5)
    logits = refused(torch.zeros(1, 5, 5), valid)
    logits[0, 1, 2] = logits[0, 2, 1] = logits[0, 3, 4] = logits[0, 4, 3] = 5.0
    assert_trees(parents(logits, valid), valid)
