"""A network away from home: noisy poses, shards and the same objects ray-cast, unseen ones."""

from pathlib import Path

import pytest
import torch

from artgen.core.errors import UsageError
from artgen.dataset.members import encoded
from artgen.dataset.shard import write_shard
from artgen.studies.table import read_table
from model.data.library import read_library
from model.network.art import Art
from model.training.art_file import ModelCard, save_art
from model.training.recipes import RECIPES
from model.training.settings import changed
from model.training_study.claims import BOXES, DGIOU
from model.training_study.shift import study
from model.training_study.shift_page import ShiftRow
from tests.unit.dataset.scenes import made_sample
from tests.unit.model.training_study.small_study import SMALL, small_library


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An untrained network, a library, and shards with one of its test objects."""
    folder: Path = tmp_path_factory.mktemp("shift")
    small_library(folder)
    torch.manual_seed(0)
    config = changed(RECIPES["multiview"]("nano"), (*BOXES, *SMALL))
    save_art(folder / "art.safetensors", Art(config.model).eval(), config, ModelCard())
    sample = made_sample("laptop_000001", states=3, views=4, parts=2, height=12, width=12)
    (folder / "shards").mkdir()
    write_shard(folder / "shards" / "test-000000.tar", [encoded(sample)])
    return folder


def shift(place: Path, out: Path, *more: str) -> int:
    library, network = place / "library.npz", place / "art.safetensors"
    return study([str(network), "--library", str(library), "--out", str(out), *more])


def test_every_condition_has_a_row_and_pairs_are_the_same_objects(
    place: Path, tmp_path: Path
) -> None:
    words = ("--noise-deg", "5", "--noise", "0.05", "--held-out", "2")
    shards = ("--shards", *(f"{name}={place / 'shards'}" for name in ("noise", "copy")))
    assert shift(place, tmp_path, *words, *shards, "--unseen", "bucket") == 0
    rows = [row for row in read_table(tmp_path / "shift.csv", ShiftRow) if row.metric == DGIOU]
    assert [(row.condition, row.objects, row.pairs, row.against) for row in rows] == [
        ("ray-cast", 2, 0, ""),
        ("poses off by 5 deg", 2, 2, "ray-cast"),
        ("poses off by 0.05 radii", 2, 2, "ray-cast"),
        ("ray-cast of noise", 1, 0, ""),
        ("noise", 1, 1, "ray-cast of noise"),
        ("ray-cast of copy", 1, 0, ""),
        ("copy", 1, 1, "ray-cast of copy"),
        ("copy", 1, 1, "noise"),
        ("unseen bucket", 2, 0, ""),
    ]
    assert [row.change for row in rows if row.against == "noise"] == [0.0]
    same = read_library(next((tmp_path / "objects").glob("of_noise_*.npz")))
    assert same.ids == ("laptop_000001",)
    page = (tmp_path / "shift.md").read_text()
    assert "| poses off by 5 deg - ray-cast | 2 |" in page
    assert "| copy - noise | 1 |" in page
    assert (tmp_path / "shift.png").exists()


def test_a_library_without_the_objects_of_shards_is_told(place: Path, tmp_path: Path) -> None:
    sample = made_sample("cabinet_000005", states=2, views=2, parts=2)
    (tmp_path / "shards").mkdir()
    write_shard(tmp_path / "shards" / "test-000000.tar", [encoded(sample)])
    with pytest.raises(UsageError, match="holds none of the test objects .* cabinet_000005"):
        shift(place, tmp_path / "out", "--shards", f"other={tmp_path / 'shards'}")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--shards", "fast"), "expected NAME=FOLDER"),
        (("--noise", "0"), "above 0"),
        (("--held-out", "0"), "--held-out 0"),
    ],
)
def test_what_cannot_be_is_told(
    place: Path, tmp_path: Path, words: tuple[str, ...], message: str
) -> None:
    with pytest.raises(UsageError, match=message):
        shift(place, tmp_path, *words)
    with pytest.raises(UsageError, match="no such file"):
        study([str(tmp_path / "none"), "--library", "library.npz"])
