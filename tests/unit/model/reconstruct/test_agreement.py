"""Silhouettes tell right predictions from wrong ones, and lead back to the right."""

import dataclasses

import numpy as np

from model.reconstruct.agreement import agreeing, agreement
from model.reconstruct.guess import ObjectGuess
from model.reconstruct.outlines import Silhouettes
from model.reconstruct.refine import STEPS, refined
from tests.unit.model.reconstruct.studio import STATES


def test_the_truth_agrees(guess: ObjectGuess, seen: Silhouettes) -> None:
    """Alpha is thresholded after the crop's resampling: half a px around shapes of some 44 px."""
    assert agreement(guess, seen) >= 0.93


def test_a_closed_door_agrees_less_than_an_open_one(guess: ObjectGuess, seen: Silhouettes) -> None:
    door = dataclasses.replace(guess.joints[0], observed=np.zeros(2))
    wrong = dataclasses.replace(guess, joints=(door, guess.joints[1]))
    assert agreement(wrong, seen) < agreement(guess, seen) - 0.02


def test_a_shrunken_field_gives_way_to_its_box(guess: ObjectGuess, seen: Silhouettes) -> None:
    """The base as a crumb in the middle of its box."""
    base = guess.parts[0]
    small = dataclasses.replace(base, vertices=0.3 * base.vertices)
    found = agreeing(dataclasses.replace(guess, parts=(small, *guess.parts[1:])), seen)
    assert found.parts[0].boxed
    assert any(slot == 0 and "rounded box" in text for slot, text in found.told)
    assert agreement(found, seen) >= 0.85


def test_fields_that_agree_stay(guess: ObjectGuess, seen: Silhouettes) -> None:
    assert not any(part.boxed for part in agreeing(guess, seen).parts)


def test_a_wrong_state_is_fitted_back(guess: ObjectGuess, seen: Silhouettes) -> None:
    """The door 0.7 rad too far closed in the second state; the last step decides how near."""
    door = dataclasses.replace(guess.joints[0], observed=guess.joints[0].observed - (0.0, 0.7))
    wrong = dataclasses.replace(guess, joints=(door, guess.joints[1]))
    found = refined(wrong, seen)
    off = abs(float(found.joints[0].observed[1]) - STATES[1]["part_1_joint"])
    assert off <= 2.0 * np.pi * (STEPS[-1] + STEPS[-2])
    assert agreement(found, seen) > agreement(wrong, seen)
    assert "fitted to the silhouettes" in found.told[0][1]
