"""What a folder holds, found by its files."""

from pathlib import Path

import pytest

from artgen.core.errors import ArtgenError, ModelError
from model.evaluation.adapters.formats import places
from tests.unit.model.evaluation.adapters.outputs import (
    write_artgs,
    write_dta,
    write_paris,
    write_singapo,
    write_two_states,
    write_urdf,
    write_urdformer,
)


@pytest.mark.parametrize(
    ("write", "expected"),
    [
        (write_urdf, "urdf"),
        (write_singapo, "singapo"),
        (lambda folder: write_paris(folder, "rotate"), "paris"),
        (write_dta, "dta"),
        (write_artgs, "artgs"),
        (write_two_states, "two_states"),
    ],
)
def test_each_system_is_known_by_its_files(tmp_path: Path, write: object, expected: str) -> None:
    write(tmp_path / "7201")  # type: ignore[operator]
    found = places(tmp_path)
    assert list(found) == ["7201"]
    assert found["7201"].format == expected
    assert len(found["7201"].read()) > 1


def test_files_of_one_folder_are_named_by_themselves(tmp_path: Path) -> None:
    file = write_urdformer(tmp_path)
    (file.parent / "label4.urdf").write_bytes(file.read_bytes())
    assert sorted(places(tmp_path / "output", "urdformer")) == ["label3", "label4"]


def test_folders_of_one_name_are_told_apart(tmp_path: Path) -> None:
    for category in ("oven", "door"):
        write_singapo(tmp_path / category / "0")
    assert sorted(places(tmp_path)) == ["door/0/object.json", "oven/0/object.json"]


def test_nothing_to_score_is_told(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="holds no bundle or"):
        places(tmp_path)
    with pytest.raises(ModelError, match="did you mean 'urdf'"):
        places(tmp_path, "urdff")
    with pytest.raises(ModelError, match="is no folder"):
        places(tmp_path / "none")


def test_a_damaged_bundle_is_found_by_its_folder(tmp_path: Path) -> None:
    """It fails where it is read, and the others are found."""
    for place, text in (("laptop/000000", "{"), ("mine", "[]"), ("good", '{"asset_id": "one"}')):
        (tmp_path / place).mkdir(parents=True)
        (tmp_path / place / "manifest.json").write_text(text, encoding="utf-8")
    found = places(tmp_path)
    assert sorted(found) == ["laptop_000000", "mine", "one"]
    with pytest.raises(ArtgenError, match=r"laptop/000000/manifest\.json cannot be read"):
        found["laptop_000000"].read()
