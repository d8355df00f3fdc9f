"""Shapes that share their space with others, or are shreds, become boxes."""

import dataclasses

import numpy as np

from artgen.geometry.solid import Solid, cylinder, slab
from model.reconstruct.sense import sensible, shared
from tests.unit.model.reconstruct.perfect import part

BASE = slab((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
BALL = cylinder(0.2, 0.4, segments=64).at(0.5, 0.5, 1.2)
SOLIDS = {0: BASE, 1: BALL, 2: BALL.at(0.05)}


def made(solids: dict[int, Solid], budget: int = 10_000) -> tuple[dict[int, Solid], list[int]]:
    guesses = {slot: part(slot, solid) for slot, solid in solids.items()}
    found, told = sensible(solids, guesses, dict.fromkeys(solids, budget), {1: 0, 2: 0})
    return found, [slot for slot, _ in told]


def test_two_parts_in_one_place_become_boxes_of_their_size() -> None:
    found, told = made(SOLIDS)
    assert told == [1, 2]
    assert found[0] is BASE
    for slot in told:
        assert np.abs(found[slot].bounds - SOLIDS[slot].bounds).max() <= 1e-9


def test_a_drawer_in_its_cabinet_stays() -> None:
    solids = {0: BASE, 1: slab((0.1, 0.0, 0.1), (0.9, 0.9, 0.9))}
    assert made(solids) == (solids, [])


def test_what_hangs_on_a_part_may_lie_in_it() -> None:
    assert shared(2, SOLIDS, {1: 0, 2: 1}) == 0.0
    assert shared(2, SOLIDS, {1: 0, 2: 0}) > 0.5


def test_what_is_a_box_already_is_not_replaced_again() -> None:
    guesses = {
        slot: dataclasses.replace(part(slot, solid), boxed=slot > 0)
        for slot, solid in SOLIDS.items()
    }
    budgets = dict.fromkeys(SOLIDS, 10_000)
    assert sensible(SOLIDS, guesses, budgets, {1: 0, 2: 0}) == (SOLIDS, [])


def test_shreds_become_a_box() -> None:
    _, told = made({0: BASE, 1: BALL}, budget=20)
    assert told == [1]
