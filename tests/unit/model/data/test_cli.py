import pytest

from artgen.core.errors import ModelError, UsageError
from model.data.cli import train_data
from model.data.library import read_library


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


@pytest.mark.parametrize("words", [["--count", "2"], ["--workers", "0"], ["--tolerance", "-1"]])
def test_numbers_that_cannot_be_are_refused(words):
    with pytest.raises(UsageError, match="at least"):
        train_data(words)
