"""Laws of settings: contradictions are refused at construction, and the paper is the default."""

import dataclasses

import pytest

from artgen.core.errors import ModelError
from model.config import Config, ImageTokens, ModelConfig, PlaneConfig, Trunk
from model.data.config import DataConfig


def test_defaults_are_the_papers_figures() -> None:
    """32 blocks, cross to self 3 : 1, 16 heads, width 256, 8 slots, 24 to 192."""
    model = ModelConfig()
    assert (model.trunk.blocks, model.trunk.heads, model.trunk.width) == (32, 16, 256)
    assert model.trunk.layout.count("X") == 3 * model.trunk.layout.count("S")
    assert model.trunk.direction == "image_from_part"
    assert model.slots == 8
    assert model.planes is not None
    assert (model.planes.grid, model.planes.grid * model.planes.scale) == (24, 192)
    assert model.field.bias == "paper"
    assert (model.limits, model.tree, model.count) == (False, False, False)


def test_contradictions_are_refused() -> None:
    with pytest.raises(ModelError, match="50 px do not divide into patches of 8 px"):
        ImageTokens(image_px=50)
    with pytest.raises(ModelError, match="a scale of 6 is no power of two"):
        PlaneConfig(scale=6, upsampler="transposed")
    with pytest.raises(ModelError, match="'XY' must consist of X and S"):
        Trunk(pattern="XY")
    with pytest.raises(ModelError, match="7 heads do not divide a width of 256"):
        Trunk(heads=7)


def test_data_must_fit_the_network() -> None:
    with pytest.raises(ModelError, match=r"data\.input_px is 64, model\.images\.image_px 256"):
        Config(recipe="x", size="nano", data=DataConfig(input_px=64))
    with pytest.raises(ModelError, match="data has 3 states and 8 parts"):
        Config(recipe="x", size="nano", data=DataConfig(input_px=256, states=3))
    with pytest.raises(ModelError, match=r"and 6 \(model\.slots\)"):
        Config(recipe="x", size="nano", model=dataclasses.replace(ModelConfig(), slots=6))
