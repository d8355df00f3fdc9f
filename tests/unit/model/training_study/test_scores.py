"""Scores: kept as long as nothing changes, and failures cost the worst."""

import dataclasses
import math
from pathlib import Path

import pytest

from artgen.core.errors import ModelError
from model.evaluation.held_out import HeldOut
from model.evaluation.network_run import NetworkRun
from model.evaluation.predictors import Guess
from model.training_study import scores
from model.training_study.claims import AXIS, DGIOU, TYPE
from model.training_study.judge import Judge
from model.training_study.scores import Score, kept_score, scored
from tests.unit.model.training_study.small_study import small_library


@pytest.fixture(scope="module")
def asked(tmp_path_factory: pytest.TempPathFactory) -> NetworkRun:
    library = small_library(tmp_path_factory.mktemp("scores"))
    return Judge(truth=library, count=3, split="test")._asked("mean", False, library)


def test_a_score_is_kept_until_something_changes(asked: NetworkRun, tmp_path: Path) -> None:
    assert kept_score(asked, tmp_path, mask_pixels=0) is None
    score = scored(asked, tmp_path, mask_pixels=0)
    assert score.objects == 3
    assert set(score.metrics[DGIOU]) == {"laptop_000001", "laptop_000009", "cabinet_000003"}
    assert kept_score(asked, tmp_path, mask_pixels=0) == score
    assert kept_score(asked, tmp_path, mask_pixels=24) is None
    assert kept_score(dataclasses.replace(asked, count=2), tmp_path, mask_pixels=0) is None
    (tmp_path / scores.FILE).write_text("{")
    assert kept_score(asked, tmp_path, mask_pixels=0) is None


def test_an_object_without_a_prediction_counts_the_worst(
    asked: NetworkRun, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of metrics whose scale has an end; the others know nothing of it."""
    make = scores.made_predictor

    def failing(run: NetworkRun) -> object:
        own, config = make(run)

        def predict(item: HeldOut) -> Guess:
            if item.name == "laptop_000009":
                raise ModelError("it crashed")
            return own(item)

        return predict, config

    monkeypatch.setattr(scores, "made_predictor", failing)
    score = scored(asked, tmp_path, mask_pixels=0)
    assert score.failures == {"laptop_000009": "it crashed"}
    assert score.metrics[DGIOU]["laptop_000009"] == 2.0
    assert score.metrics[TYPE]["laptop_000009"] == 0.0
    assert "laptop_000009" not in score.metrics[AXIS]


def test_means() -> None:
    score = Score(metrics={DGIOU: {"a": 1.0, "b": 2.0}}, objects=2, failures={})
    assert score.mean(DGIOU) == 1.5
    assert math.isnan(score.mean(TYPE))
