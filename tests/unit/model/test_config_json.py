"""Settings survive JSON, and JSON that does not fit is refused with the key."""

import json

import pytest

from artgen.core.errors import ModelError
from model.config import Config
from model.training.recipes import RECIPES, articulation_only

TEXT = RECIPES["multiview"]("nano").to_json()


def changed(key: str, value: object) -> str:
    tree = json.loads(TEXT)
    *above, last = key.split(".")
    table = tree
    for step in above:
        table = table[step]
    table[last] = value
    return json.dumps(tree)


@pytest.mark.parametrize("recipe", RECIPES)
@pytest.mark.parametrize("size", ["nano", "s", "paper"])
def test_settings_come_back(recipe: str, size: str) -> None:
    config = RECIPES[recipe](size)  # type: ignore[arg-type]
    assert Config.from_json(config.to_json()) == config
    alone = articulation_only(config)
    assert Config.from_json(alone.to_json()) == alone
    assert alone.model.planes is None


def test_whole_numbers_serve_as_floats() -> None:
    config = Config.from_json(changed("weights.center", 3))
    assert config.weights.center == 3.0
    assert isinstance(config.weights.center, float)


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("model.trunk.widht", 3, r"Config\.model\.trunk has no 'widht' \(did you mean 'width'\?\)"),
        (
            "model.trunk.width",
            "256",
            r"Config\.model\.trunk\.width is '256', expected a value of type int",
        ),
        ("model.trunk.width", True, "is True, expected a value of type int"),
        (
            "model.trunk.direction",
            "sideways",
            "expected one of 'image_from_part', 'part_from_image'",
        ),
        ("model.trunk", 3, r"Config\.model\.trunk is 3, expected the fields of Trunk"),
        ("model.images.image_px", 50, "50 px do not divide"),
        ("train.betas", [0.9], r"Config\.train\.betas has 1 entries, expected 2"),
        ("train.stages", [{"start": 0.0}], r"Config\.train\.stages\[0\] lacks target_px"),
        ("weights.center", None, r"Config\.weights\.center is None"),
    ],
)
def test_what_does_not_fit_is_told_with_its_key(key: str, value: object, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        Config.from_json(changed(key, value))


def test_settings_of_another_version_are_refused() -> None:
    tree = json.loads(TEXT)
    del tree["weights"]
    with pytest.raises(ModelError, match="Config lacks weights; the file is of another version"):
        Config.from_json(json.dumps(tree))


def test_text_that_is_no_json_is_refused() -> None:
    with pytest.raises(ModelError, match="expected the JSON of a Config"):
        Config.from_json("{")
    with pytest.raises(ModelError, match=r"Config is \[\], expected the fields of Config"):
        Config.from_json("[]")


def test_settings_that_came_later_mean_their_default() -> None:
    tree = json.loads(TEXT)
    del tree["model"]["images"]["blind"], tree["data"]["part_order"], tree["data"]["rest"]
    assert Config.from_json(json.dumps(tree)) == Config.from_json(TEXT)
