"""Network files: what was trained comes back, of a finished, a killed or a stopped run."""

import json
from pathlib import Path

import pytest
import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.batch import Batch
from model.network.art import Art
from model.tensor_file import write_tensors
from model.training.art_file import ModelCard, load_art, save_art
from model.training.checkpoint import (
    Checkpoint,
    checkpoint_path,
    found_checkpoints,
    read_checkpoint,
    write_checkpoint,
)
from model.training.cli import ship
from model.training.objective import Objective
from model.training.schedule import Moment
from model.training.settings import changed
from tests.unit.model.tiny_session import TINY, laptop_material, session


def assert_holds(art: Art, average: dict[str, Tensor]) -> None:
    """The network has the weights of a moving average."""
    for name, value in art.state_dict().items():
        assert torch.equal(value, average[f"art.{name}"])


def test_half_weights_round_to_11_bits(tmp_path: Path) -> None:
    path = tmp_path / "half.safetensors"
    torch.manual_seed(3)
    art, card = Art(TINY.model), ModelCard(hours=0.5, metrics={"psnr_db": 20.0}, limits=("none",))
    save_art(path, art, TINY, card, stored="float16")
    found, _, read_card = load_art(path)
    assert read_card == card
    for name, value in found.state_dict().items():
        # Half a unit in the 11th place, or half of the smallest number below 2 ** -14.
        assert torch.allclose(value, art.state_dict()[name], rtol=2.0**-11, atol=2.0**-25)


def test_network_files_of_another_kind_are_refused(tmp_path: Path) -> None:
    write_tensors(tmp_path / "a", {}, schema="artgen-soups/1", meaning={})
    with pytest.raises(ModelError, match="expected 'artgen-art/1'"):
        load_art(tmp_path / "a")


def test_the_checkpoint_of_a_killed_run_is_a_network(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Only art.safetensors, written at the end, could be evaluated, shipped or begun with."""
    torch.manual_seed(3)
    weights = {f"art.{name}": value for name, value in Art(TINY.model).state_dict().items()}
    average = {name: value + 0.5 for name, value in weights.items()}
    path = checkpoint_path(tmp_path, 2)
    write_checkpoint(
        path,
        Checkpoint(
            weights=weights,
            average=average,
            moments={},
            step=2,
            cursor=4,
            seconds=1800.0,
            config={"config": json.loads(TINY.to_json())},
        ),
    )
    art, config, card = load_art(path)
    assert_holds(art, average)
    assert config == TINY
    assert (card.steps, card.hours, card.data["seen"]) == (2, 0.5, 4)
    assert card.limits == ("Read from a checkpoint: 2 of 4 updates.",)
    out = tmp_path / "shipped.safetensors"
    assert ship([str(path), "--out", str(out)]) == 0
    assert_holds(load_art(out)[0], average)
    assert json.loads(capsys.readouterr().out)["steps"] == 2


def test_a_checkpoint_of_something_else_is_no_network(tmp_path: Path) -> None:
    path = checkpoint_path(tmp_path, 0)
    nothing: dict[str, Tensor] = {"a": torch.zeros(1)}
    write_checkpoint(
        path,
        Checkpoint(
            weights=nothing, average=nothing, moments={}, step=0, cursor=0, seconds=0.0, config={}
        ),
    )
    with pytest.raises(ModelError, match="does not state its network"):
        load_art(path)


def test_a_stopped_run_goes_on_in_a_new_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The message names the file, `--start` reads it: a step at rate 0 leaves its weights."""
    real = Objective.forward

    def failing(self: Objective, batch: Batch, moment: Moment) -> dict[str, Tensor]:
        losses = real(self, batch, moment)
        return {**losses, "axis": losses["axis"] * float("nan")} if moment.step == 3 else losses

    material = laptop_material(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(Objective, "forward", failing)
        with pytest.raises(ModelError, match="axis is nan") as caught:
            session(material, tmp_path / "first")
    start = tmp_path / "first" / "stopped" / "step_00000003.safetensors"
    assert str(caught.value).endswith(f"--start {start}")
    average = dict(read_checkpoint(start).average)
    found, _, card = load_art(start)
    assert_holds(found, average)
    assert card.limits[-1] == "Training stopped there: loss term axis is nan."
    still = changed(TINY, ["train.steps=1", "train.learning_rate=0"])
    again, _, _ = load_art(session(material, tmp_path / "second", still, start=start))
    assert_holds(again, average)
    assert not found_checkpoints(tmp_path / "first")[1:]
