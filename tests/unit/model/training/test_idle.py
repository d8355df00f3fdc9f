"""Settings promise no term that a run does not compute; where they do, it is told."""

import dataclasses

import pytest

from model.config import Config, LossWeights
from model.training.idle import IMAGE_TERMS, idle_line, idle_terms
from model.training.recipes import RECIPES, articulation_only
from model.training.settings import changed

NANO = RECIPES["multiview"]("nano")
S = RECIPES["multiview"]("s")


@pytest.mark.parametrize("size", ["nano", "s", "paper"])
@pytest.mark.parametrize("recipe", RECIPES)
def test_every_weight_of_a_recipe_has_its_term(recipe: str, size: str) -> None:
    """All sizes stated a perceptual weight, and only `paper` had the patches that it needs."""
    assert idle_terms(RECIPES[recipe](size), perceptual=True) == {}  # type: ignore[arg-type]


def test_without_its_package_the_perceptual_term_alone_is_idle() -> None:
    idle = idle_terms(S, perceptual=False)
    assert idle.keys() == {"part_perceptual"}
    assert "artgen[encoders]" in idle_line(idle)
    assert idle_terms(NANO, perceptual=False) == {}


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["weights.part_perceptual=1"], "data.patch_px is 0"),
        (["weights.distance=1", "data.rays=0"], "data.rays is 0"),
        (["weights.distance=1", "train.rendered=1"], "train.rendered is 1"),
        (["model.limits=false"], "limits (model.limits is off)"),
        (["model.limits=false", "weights.range=1"], "range (model.limits is off)"),
        (["model.tree=false"], "model.tree is off"),
    ],
)
def test_the_reason_names_the_setting(words: list[str], why: str) -> None:
    assert why in idle_line(idle_terms(changed(NANO, words), perceptual=True))


def test_boxes_and_joints_alone_leave_all_image_terms_out() -> None:
    everything = LossWeights(**dict.fromkeys(IMAGE_TERMS, 1.0))  # type: ignore[arg-type]
    config: Config = dataclasses.replace(articulation_only(NANO), weights=everything)
    assert idle_terms(config, perceptual=True).keys() == set(IMAGE_TERMS)
