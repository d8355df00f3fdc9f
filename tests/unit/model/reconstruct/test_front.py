"""Where no file says what is the front, the turn is found from which the network is right."""

import dataclasses
import math
from typing import cast

import numpy as np
import pytest
import torch

from model.batch import Images
from model.config import Config
from model.network.art import Art
from model.network.prediction import Prediction
from model.reconstruct.assemble import Assembled
from model.reconstruct.capture import Capture
from model.reconstruct.front import FINER, STEPS, Front, best_turn, faced, told_front, turned
from model.reconstruct.search import Question, found, question
from model.training.recipes import RECIPES, articulation_only
from tests.unit.model.reconstruct.test_search import Knowing, sphere

STEP = 2.0 * math.pi / STEPS


@pytest.fixture(scope="module")
def config() -> Config:
    return articulation_only(RECIPES["debug"]("nano"))


def asked(config: Config, capture: Capture, perfect: Assembled) -> Question:
    return question(cast(Art, Knowing()), config, capture, sphere(perfect), parts=3)


@pytest.mark.parametrize("true", [0.0, 1.0, -2.6, math.pi])
def test_the_best_turn_is_found(true: float) -> None:
    """Of a merit that falls off to both sides, to half of the finest step; a quarter turn away it
    is lower by 1, or by what the coarse steps miss of the top and of the quarter."""
    count = [0]

    def worth(turn: float) -> float:
        count[0] += 1
        return math.cos(turn - true)

    front = best_turn(worth)
    assert abs(math.remainder(front.turn - true, 2.0 * math.pi)) <= STEP / 2.0**FINER / 2.0 + 1e-9
    assert abs(front.lead - 1.0) <= 2.0 * math.sin(STEP / 2.0)
    assert count[0] == STEPS + 2 * FINER


def test_a_turned_question_is_the_same_question(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    """Turned there and back; and cameras that turn with the object see it where they saw it: poses
    told to the network are float32, so 2^-24 of some 3 radii."""
    one = asked(config, capture, perfect)
    there = turned(one, 0.7)
    assert np.abs(there.seen.ways - one.seen.ways).max() > 0.1
    back = turned(there, -0.7)
    assert np.abs(back.seen.ways - one.seen.ways).max() <= 1e-12
    assert np.abs(back.capture.camera_from_world - one.capture.camera_from_world).max() <= 1e-12
    poses = [q.images.camera_from_world_BTV44[0].double().numpy() for q in (one, there)]
    eyes = [-np.einsum("tvji,tvj->tvi", p[..., :3, :3], p[..., :3, 3]) for p in poses]
    assert np.abs(np.linalg.norm(eyes[0], axis=-1) - np.linalg.norm(eyes[1], axis=-1)).max() < 1e-6
    angles = [np.arctan2(eye[..., 1], eye[..., 0]) for eye in eyes]
    off = np.remainder(angles[1] - angles[0] - 0.7 + math.pi, 2.0 * math.pi) - math.pi
    assert np.abs(off).max() < 1e-6


@pytest.mark.parametrize("true", [0.9, -2.0])
def test_the_front_is_found(
    config: Config, capture: Capture, perfect: Assembled, true: float
) -> None:
    """Of photographs in a world that was turned; the network knows the object's boxes and joints
    from the front alone, so silhouettes tell to within half of a finest step and a little."""
    right = asked(config, capture, perfect)
    there, front = faced(turned(right, -true))
    assert abs(math.remainder(front.turn - true, 2.0 * math.pi)) <= STEP / 2.0**FINER
    best = found(right, right.about, (0, 1)).agreement
    assert found(there, there.about, (0, 1)).agreement >= best - 0.05
    assert "front" in told_front(front)


class Blind(Knowing):
    """A network that knows no side: a single box as wide as deep."""

    def __call__(self, images: Images, valid_BP: torch.Tensor) -> Prediction:
        said = super().__call__(images, valid_BP)
        shape = torch.ones_like(said.articulation.size_BP3)
        still = torch.zeros_like(said.articulation.motion_BTP)
        middle = torch.zeros_like(said.articulation.center_BP3)
        same = dataclasses.replace(
            said.articulation, center_BP3=middle, size_BP3=shape, motion_BTP=still
        )
        return dataclasses.replace(said, articulation=same)


def test_a_front_that_cannot_be_told_is_doubted(
    config: Config, capture: Capture, perfect: Assembled
) -> None:
    """A square box agrees as well a quarter turn on."""
    one = question(cast(Art, Blind()), config, capture, sphere(perfect), parts=3)
    _, front = faced(one)
    assert front.lead < 1e-3
    assert "hardly better" in told_front(front)
    assert "hardly" not in told_front(Front(turn=1.0, lead=0.2))
    assert "57 degrees left" in told_front(Front(turn=1.0, lead=0.2))
