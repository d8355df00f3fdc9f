"""A prediction that is a sound cabinet opens in MuJoCo; one that is none does not load."""

import dataclasses

import torch

from model.batch import Articulation
from model.evaluation.simulated import prediction_gates
from model.network.prediction import Prediction


def prediction(articulation: Articulation) -> Prediction:
    """What a network without planes and doubts would say."""
    slots = articulation.valid_BP.shape[1]
    return Prediction(
        articulation=articulation,
        axis_BP3=articulation.axis_BP3,
        origin_BP3=articulation.origin_BP3,
        type_logits_BP2=torch.zeros(1, slots, 2),
        limited=True,
    )


SOUND = Articulation(
    valid_BP=torch.tensor([[True, True]]),
    center_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.0, -0.45, 0.0]]]),
    size_BP3=torch.tensor([[[0.8, 0.6, 0.8], [0.7, 0.1, 0.7]]]),
    type_BP=torch.tensor([[0, 1]]),
    axis_BP3=torch.tensor([[[0.0, 0.0, 0.0], [0.0, 0.0, -1.0]]]),
    origin_BP3=torch.tensor([[[0.0, 0.0, 0.0], [-0.35, -0.5, 0.0]]]),
    motion_BTP=torch.tensor([[[0.0, 0.0], [0.0, 0.2]]]),
    limits_BP2=torch.tensor([[[0.0, 0.0], [0.0, 0.25]]]),
    parent_BP=torch.tensor([[-1, 0]]),
)
"""A box with a door before it, hinged at its outer left edge."""


def test_a_sound_prediction_passes() -> None:
    found = prediction_gates(prediction(SOUND), radius=0.5, resolution=0)
    assert found.loads
    assert found.reasons == {}
    assert found.passed


def test_a_prediction_without_base_does_not_load() -> None:
    headless = dataclasses.replace(SOUND, valid_BP=torch.tensor([[False, True]]))
    found = prediction_gates(prediction(headless), radius=0.5, resolution=0)
    assert not found.passed
    assert "cannot be put together" in found.reasons["loads"]
