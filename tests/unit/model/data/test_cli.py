import pytest

from artgen.core.errors import ModelError, UsageError
from model.data.cli import train_data
from model.data.library import read_library
from tests.strategies import drawer_unit
from tests.unit.model.data.small import written_bundle


def test_one_command_makes_a_library_and_says_what_it_holds(tmp_path, capsys):
    path = tmp_path / "nano.npz"
    words = ["--categories", "cardboard_box", "cabinet", "--count", "3", "--seed", "5"]
    words += ["--out", str(path), "--workers", "2", "--tolerance", "0.02"]
    assert train_data(words) == 0
    assert "3 objects of 2 categories" in capsys.readouterr().out
    library = read_library(path)
    assert library.ids == ("cardboard_box_000000", "cardboard_box_000001", "cabinet_000000")
    assert library.made["seed"] == 5
    before = path.read_bytes()
    assert train_data(words) == 0
    assert path.read_bytes() == before
    with pytest.raises(ModelError, match="holds another library"):
        train_data([*words[:-1], "0.03"])


def test_bundles_alone(tmp_path, capsys):
    written_bundle(drawer_unit(), tmp_path / "run" / "assets" / "a")
    written_bundle(drawer_unit(), tmp_path / "run" / "failed" / "b")
    words = ["--count", "0", "--bundles", str(tmp_path / "run"), "--out", str(tmp_path / "a.npz")]
    assert train_data([*words, "--workers", "1"]) == 0
    assert read_library(tmp_path / "a.npz").ids == (drawer_unit().asset_id,)
    assert "1 objects of 1 categories" in capsys.readouterr().out
    with pytest.raises(UsageError, match="holds no bundle"):
        train_data([*words[:3], str(tmp_path / "run" / "failed" / "b" / "meshes")])


@pytest.mark.parametrize("words", [["--count", "2"], ["--workers", "0"], ["--tolerance", "-1"]])
def test_numbers_that_cannot_be_are_refused(words):
    with pytest.raises(UsageError, match="at least"):
        train_data(words)
