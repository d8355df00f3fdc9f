"""What groups of states are told apart from adds up to all of them."""

import dataclasses
import math

import pytest
import torch

from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation
from model.network.prediction import Prediction
from model.reconstruct.states import Answer, completed, state_groups

MOTIONS = ((0.1, 0.2), (0.25, 0.1), (0.0, 0.3))
"""Of a door and a drawer in three states."""


def truth(states: tuple[int, ...]) -> Articulation:
    """A base with a door in slot 1 and a drawer in slot 2; slot 3 is empty."""
    motion = [[0.0, *MOTIONS[state], 0.0] for state in states]
    return Articulation(
        valid_BP=torch.tensor([[True, True, True, False]]),
        center_BP3=torch.tensor([[[0.0, 0, 0], [0, -0.4, -0.3], [0, -0.3, 0.3], [0, 0, 0]]]),
        size_BP3=torch.tensor([[[0.8, 0.8, 1.0], [0.8, 0.1, 0.4], [0.7, 0.7, 0.3], [0, 0, 0]]]),
        type_BP=torch.tensor([[FIXED, REVOLUTE, PRISMATIC, FIXED]]),
        axis_BP3=torch.tensor([[[0.0, 0, 0], [0, 0, -1], [0, -1, 0], [0, 0, 0]]]),
        origin_BP3=torch.tensor([[[0.0, 0, 0], [-0.4, -0.4, -0.3], [0, 0, 0], [0, 0, 0]]]),
        motion_BTP=torch.tensor([motion]),
        limits_BP2=torch.zeros(1, 4, 2),
        parent_BP=torch.tensor([[-1, 0, 0, -1]]),
    )


def answer(states: tuple[int, ...], **changes: torch.Tensor) -> Answer:
    """What a network without fault says of some states, but for some tensors."""
    said = dataclasses.replace(truth(states), **changes)
    prediction = Prediction(
        articulation=said,
        axis_BP3=said.axis_BP3,
        origin_BP3=said.origin_BP3,
        type_logits_BP2=torch.zeros(1, 4, 2),
    )
    return Answer(states=states, prediction=prediction)


@pytest.mark.parametrize(
    ("states", "together", "expected"),
    [
        (2, 2, [(0, 1)]),
        (1, 2, [(0,)]),
        (4, 2, [(0, 1), (0, 2), (0, 3)]),
        (4, 3, [(0, 1, 2), (0, 2, 3)]),
        (5, 3, [(0, 1, 2), (0, 3, 4)]),
        (3, 1, [(0,), (1,), (2,)]),
    ],
)
def test_groups_share_the_first_state_and_hold_all(
    states: int, together: int, expected: list[tuple[int, ...]]
) -> None:
    assert state_groups(states, together) == expected
    assert {state for group in expected for state in group} == set(range(states))


@pytest.mark.parametrize("lead", [0, 1])
def test_right_answers_about_pairs_are_right_about_all_three(lead: int) -> None:
    """Exactly: numbers are put together, not computed."""
    answers = [answer((0, 1)), answer((0, 2))]
    found = completed(answers[lead], answers, 3)
    expected = truth((0, 1, 2))
    for field in dataclasses.fields(Articulation):
        assert torch.equal(
            getattr(found.articulation, field.name), getattr(expected, field.name)
        ), field.name


def test_an_answer_about_all_states_stays() -> None:
    own = answer((0, 1, 2))
    assert torch.equal(
        completed(own, [own], 3).articulation.motion_BTP, own.prediction.articulation.motion_BTP
    )


def test_slots_and_directions_may_differ_between_answers() -> None:
    """The second answer has door and drawer in each other's slots, the drawer's axis turned around
    and so its motion of the other sign."""
    order = [0, 2, 1, 3]
    other = truth((0, 2))
    sign = torch.tensor([1.0, -1.0, 1.0, 1.0])
    swapped = answer(
        (0, 2),
        center_BP3=other.center_BP3[:, order],
        size_BP3=other.size_BP3[:, order],
        type_BP=other.type_BP[:, order],
        axis_BP3=other.axis_BP3[:, order] * sign[:, None],
        motion_BTP=other.motion_BTP[:, :, order] * sign,
    )
    found = completed(answer((0, 1)), [swapped], 3)
    assert torch.equal(found.articulation.motion_BTP, truth((0, 1, 2)).motion_BTP)


def test_where_types_disagree_the_mean_of_the_own_states_stands() -> None:
    slides = torch.tensor([[FIXED, PRISMATIC, PRISMATIC, FIXED]])
    found = completed(answer((0, 1)), [answer((0, 2), type_BP=slides)], 3)
    door, drawer = found.articulation.motion_BTP[0, 2, 1:3].tolist()
    # One rounding of float32 in the mean of 0.1 and 0.25.
    assert math.isclose(door, 0.175, rel_tol=1e-6)
    assert drawer == pytest.approx(MOTIONS[2][1], rel=1e-6)


def test_a_single_part_has_nothing_to_match() -> None:
    alone = torch.tensor([[FIXED] * 4])
    found = completed(answer((0, 1), type_BP=alone), [answer((0, 2), type_BP=alone)], 3)
    assert found.articulation.motion_BTP.shape == (1, 3, 4)
