"""Settings by hand reach their place, or say why not."""

import pytest

from artgen.core.errors import ModelError, UsageError
from model.config import Config
from model.training.settings import changed

CONFIG = Config(recipe="debug", size="nano")


def test_values_reach_their_place() -> None:
    words = ["train.steps=7", "model.trunk.direction=both", "data.fov_deg=[20, 30]"]
    found = changed(CONFIG, [*words, "model.planes=null"])
    assert found.train.steps == 7
    assert found.model.trunk.direction == "both"
    assert found.data.fov_deg == (20.0, 30.0)
    assert found.model.planes is None
    assert found.weights == CONFIG.weights


def test_no_word_changes_nothing() -> None:
    assert changed(CONFIG, []) is CONFIG


@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("train.steps", "expected KEY=VALUE"),
        ("train.step=3", r"no 'step' \(did you mean 'steps'\?\)"),
        ("trian.steps=3", r"no 'trian' \(did you mean 'train'\?\)"),
        ("recipe.steps=3", "nothing lies below"),
    ],
)
def test_misspelt_words_are_told(word: str, said: str) -> None:
    with pytest.raises(UsageError, match=said):
        changed(CONFIG, [word])


def test_values_of_another_type_are_told() -> None:
    with pytest.raises(ModelError, match=r"train\.steps is 'many'"):
        changed(CONFIG, ["train.steps=many"])
