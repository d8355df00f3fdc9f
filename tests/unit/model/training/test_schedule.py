"""Schedules at their ends and corners, against closed forms."""

import math

import pytest

from artgen.core.errors import ModelError
from model.training.schedule import Stage, TrainConfig, forced_at, moment_at, perceptual_at, rate_at

CONFIG = TrainConfig(
    steps=1101,
    learning_rate=1.0,
    final_ratio=0.1,
    warmup_steps=100,
    inverse_beta=(10.0, 120.0),
    stages=(Stage(start=0.0, target_px=32), Stage(start=0.5, target_px=64)),
    forced=0.25,
    perceptual=(0.2, 0.4),
)
ROUNDINGS = 4 * 2.3e-16
"""A cosine, a product and two sums of numbers up to 1."""
MIDWAY = 0.1 + 0.9 * (0.5 + 0.5 * math.cos(math.pi * 500 / 1001))


@pytest.mark.parametrize(
    ("step", "rate"),
    [(0, 0.01), (49, 0.5), (99, 1.0), (100, 1.0), (600, MIDWAY), (1101, 0.1), (5000, 0.1)],
)
def test_rate_warms_up_linearly_and_leaves_on_a_cosine(step: int, rate: float) -> None:
    assert rate_at(CONFIG, step) == pytest.approx(rate, abs=ROUNDINGS)


def test_inverse_deviation_is_linear_from_first_to_last_update() -> None:
    values = [moment_at(CONFIG, step).inverse_beta for step in (0, 550, 1100)]
    assert values == [10.0, 65.0, 120.0]


def test_stages_begin_at_their_share_of_the_run() -> None:
    assert [moment_at(CONFIG, step).target_px for step in (0, 550, 551, 1100)] == [32, 32, 64, 64]


def test_true_joints_lead_at_first() -> None:
    assert [forced_at(CONFIG, step) for step in (0, 275, 276)] == [True, True, False]
    assert not forced_at(TrainConfig(forced=0.0), 0)


def test_rays_are_rendered_from_their_share_of_the_run_on() -> None:
    late = TrainConfig(steps=100, rendered=0.3)
    assert [moment_at(late, step).rendered for step in (0, 29, 30, 99)] == [
        False,
        False,
        True,
        True,
    ]
    assert moment_at(CONFIG, 0).rendered


def test_the_perceptual_term_fades_in() -> None:
    found = [perceptual_at(CONFIG, step) for step in (0, 220, 330, 440, 1100)]
    assert found == pytest.approx([0.0, 0.0, 0.5, 1.0, 1.0], abs=ROUNDINGS)


def test_a_perceptual_term_without_fading_is_switched_on() -> None:
    at_once = TrainConfig(steps=101, perceptual=(0.5, 0.5))
    assert [perceptual_at(at_once, step) for step in (49, 50)] == [0.0, 1.0]


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"steps": 0}, "steps 0"),
        ({"picture_every": -1}, "picture_every -1"),
        ({"ema_decay": 1.0}, "ema_decay 1.0"),
        ({"stages": ()}, r"start at \[\]"),
        ({"stages": (Stage(start=0.5, target_px=8),)}, r"start at \[0.5\]"),
        ({"stages": (Stage(start=0.0, target_px=8), Stage(start=1.0, target_px=8))}, "before 1"),
    ],
)
def test_impossible_settings_are_refused(settings: dict[str, int], said: str) -> None:
    with pytest.raises(ModelError, match=said):
        TrainConfig(**settings)  # type: ignore[arg-type]
