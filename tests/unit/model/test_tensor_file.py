"""Tensor files come back equal, and show any damage."""

from pathlib import Path

import pytest
import torch

from artgen.core.errors import ModelError
from model.tensor_file import read_tensors, write_tensors

TENSORS = {
    "half": torch.arange(6, dtype=torch.float16).reshape(2, 3),
    "brain": torch.ones(2, dtype=torch.bfloat16),
    "count": torch.tensor(7),
    "turned": torch.arange(6.0).reshape(2, 3).T,
    "empty": torch.zeros(0, 3),
}
MEANING = {"step": 3, "names": ["a", "b"], "nested": {"x": 0.1}}


def written(folder: Path) -> Path:
    path = folder / "some.safetensors"
    write_tensors(path, TENSORS, schema="test/1", meaning=MEANING)
    return path


def test_tensors_and_meaning_come_back_equal(tmp_path: Path) -> None:
    tensors, meaning = read_tensors(written(tmp_path), schema="test/1")
    assert meaning == MEANING
    assert tensors.keys() == TENSORS.keys()
    for name, tensor in TENSORS.items():
        assert tensors[name].dtype == tensor.dtype
        assert torch.equal(tensors[name], tensor)


def test_equal_content_gives_equal_bytes(tmp_path: Path) -> None:
    first = written(tmp_path).read_bytes()
    assert written(tmp_path).read_bytes() == first


def test_who_may_read_other_files_of_the_folder_may_read_it(tmp_path: Path) -> None:
    """A network that a colleague is to use on the same machine."""
    plain = tmp_path / "plain"
    plain.touch()
    assert written(tmp_path).stat().st_mode == plain.stat().st_mode


def test_every_truncation_is_told(tmp_path: Path) -> None:
    path = written(tmp_path)
    whole = path.read_bytes()
    for size in range(0, len(whole), 7):
        path.write_bytes(whole[:size])
        with pytest.raises(ModelError, match="truncated"):
            read_tensors(path, schema="test/1")


def test_a_changed_weight_is_told(tmp_path: Path) -> None:
    path = written(tmp_path)
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(ModelError, match="digest"):
        read_tensors(path, schema="test/1")


def test_another_schema_is_told(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="schema 'test/1', expected 'test/2'"):
        read_tensors(written(tmp_path), schema="test/2")


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="no such file"):
        read_tensors(tmp_path / "none", schema="test/1")


def test_a_foreign_file_is_told(tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    path.write_bytes(b"\x89PNG" + bytes(100))
    with pytest.raises(ModelError, match="not a whole safetensors file of 104 bytes"):
        read_tensors(path, schema="test/1")
