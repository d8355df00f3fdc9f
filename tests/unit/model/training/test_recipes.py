"""What the recipes promise: views, states, terms, and sizes that fit their data."""

import pytest

from model.training.recipes import RECIPES, articulation_only
from model.training.schedule import moment_at

SIZES = ("nano", "s", "paper")


@pytest.mark.parametrize("size", SIZES)
def test_recipes_say_their_name_and_fit_their_data(size: str) -> None:
    for name, recipe in RECIPES.items():
        config = recipe(size)  # type: ignore[arg-type]
        assert (config.recipe, config.size) == (name, size)
        assert config.data.input_px == config.model.images.image_px
        assert config.data.states == 2
        largest = max(stage.target_px for stage in config.train.stages)
        assert largest <= config.data.render_px


@pytest.mark.parametrize("size", ["s", "paper"])
def test_the_papers_views(size: str) -> None:
    """V = 4 and V = 1, T = 2."""
    assert RECIPES["multiview"](size).data.views == 4  # type: ignore[arg-type]
    assert RECIPES["monocular"](size).data.views == 1  # type: ignore[arg-type]


def test_the_papers_optimizer() -> None:
    assert RECIPES["multiview"]("paper").train.betas == (0.9, 0.95)


@pytest.mark.parametrize("size", SIZES)
def test_static_training_renders_and_learns_boxes_alone(size: str) -> None:
    """As the paper pre-trains; the number of parts is learned beside it where there is a head."""
    config = RECIPES["static_pretrain"](size)  # type: ignore[arg-type]
    weights = config.weights
    assert (weights.type, weights.axis, weights.origin, weights.motion) == (0.0, 0.0, 0.0, 0.0)
    assert (weights.limits, weights.parent) == (0.0, 0.0)
    assert min(weights.center, weights.size, weights.part_rgb, weights.part_mask) > 0.0
    assert config.data.motion == "rest"
    assert config.train.rendered == 0.0


@pytest.mark.parametrize("size", SIZES)
def test_static_training_never_renders_through_joints_that_nothing_teaches(size: str) -> None:
    """It left the true joints at half of the run, and parts went as untaught heads had them go."""
    train = RECIPES["static_pretrain"](size).train  # type: ignore[arg-type]
    assert all(moment_at(train, step).forced for step in (0, train.steps // 2, train.steps - 1))


@pytest.mark.parametrize("size", SIZES)
def test_debugging_runs_the_renderer_from_the_first_step(size: str) -> None:
    config = RECIPES["debug"](size)  # type: ignore[arg-type]
    assert config.train.rendered == 0.0
    assert config.data.rays > 0


def test_without_shapes_there_are_no_rays() -> None:
    config = articulation_only(RECIPES["multiview"]("paper"))
    assert config.model.planes is None
    assert config.data.rays == 0
    assert config.data.patch_px == 0


@pytest.mark.parametrize("size", ["s", "paper"])
@pytest.mark.parametrize("recipe", ["static_pretrain", "multiview", "monocular"])
def test_sizes_with_a_perceptual_weight_have_whole_patches(recipe: str, size: str) -> None:
    config = RECIPES[recipe](size)  # type: ignore[arg-type]
    data, smallest = config.data, min(stage.target_px for stage in config.train.stages)
    assert config.weights.part_perceptual > 0.0
    assert 0 < data.patch_px <= smallest
    assert data.rays % data.patch_px**2 == 0


@pytest.mark.parametrize("recipe", RECIPES)
def test_nano_has_no_perceptual_term(recipe: str) -> None:
    config = RECIPES[recipe]("nano")
    assert config.weights.part_perceptual == 0.0
    assert config.data.patch_px == 0
