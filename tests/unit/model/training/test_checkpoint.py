"""Checkpoints come back as they went, and are kept few."""

from pathlib import Path

import pytest
import torch

from artgen.core.errors import ModelError
from model.tensor_file import write_tensors
from model.training.checkpoint import (
    Checkpoint,
    check_weights,
    checkpoint_path,
    found_checkpoints,
    prune,
    read_checkpoint,
    write_checkpoint,
)

WEIGHTS = {"art.block.0.weight": torch.arange(6.0).reshape(2, 3), "art.bias": torch.ones(3)}
CHECKPOINT = Checkpoint(
    weights=WEIGHTS,
    average={name: 2.0 * value for name, value in WEIGHTS.items()},
    moments={"art.bias": {"step": torch.tensor(4.0), "exp_avg": torch.zeros(3)}},
    step=4,
    cursor=128,
    seconds=2.5,
    config={"recipe": "debug"},
    note="routine",
)


def test_a_checkpoint_comes_back_as_it_went(tmp_path: Path) -> None:
    path = checkpoint_path(tmp_path, 4)
    write_checkpoint(path, CHECKPOINT)
    found = read_checkpoint(path)
    for field in ("step", "cursor", "seconds", "config", "note"):
        assert getattr(found, field) == getattr(CHECKPOINT, field)
    for name, value in WEIGHTS.items():
        assert torch.equal(found.weights[name], value)
        assert torch.equal(found.average[name], 2.0 * value)
    assert found.moments.keys() == {"art.bias"}
    assert {kind: value.tolist() for kind, value in found.moments["art.bias"].items()} == {
        "step": 4.0,
        "exp_avg": [0.0, 0.0, 0.0],
    }


def test_a_file_of_another_schema_is_refused(tmp_path: Path) -> None:
    write_tensors(tmp_path / "old", WEIGHTS, schema="artgen-training/0", meaning={})
    with pytest.raises(ModelError, match="schema 'artgen-training/0'"):
        read_checkpoint(tmp_path / "old")


def test_the_newest_are_kept_and_other_files_left(tmp_path: Path) -> None:
    other = tmp_path / "checkpoints" / "step_by_step.txt"
    other.parent.mkdir()
    other.touch()
    for step in (2, 30, 4):
        checkpoint_path(tmp_path, step).touch()
    prune(tmp_path, 2)
    assert found_checkpoints(tmp_path) == [checkpoint_path(tmp_path, step) for step in (4, 30)]
    assert other.exists()


@pytest.mark.parametrize(
    ("found", "said"),
    [
        ({"a": torch.ones(2)}, r"weight a has shape \(2,\).*expects \(3,\)"),
        ({}, r"weight a has shape None"),
        ({"a": torch.ones(3), "b": torch.ones(1)}, r"weight b has shape \(1,\).*expects None"),
    ],
)
def test_weights_of_another_network_are_refused(found: dict[str, torch.Tensor], said: str) -> None:
    with pytest.raises(ModelError, match=said):
        check_weights(Path("file"), found, {"a": torch.ones(3)})
