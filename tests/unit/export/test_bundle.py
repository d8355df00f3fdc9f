"""read_bundle: what it refuses, and how it says so."""

import json
from pathlib import Path
from typing import Any

import pytest

from artgen.core.errors import ExportError
from artgen.core.jsonio import write_json
from artgen.export import layout, read_bundle
from artgen.export.files import write_meshes
from artgen.export.manifest import manifest
from tests.strategies import drawer_unit


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Meshes and manifest of an object with every kind of joint and collision piece."""
    obj = drawer_unit()
    write_meshes(obj, tmp_path)
    write_json(tmp_path / layout.MANIFEST, manifest(obj, tmp_path))
    return tmp_path


def edited(folder: Path, **changes: Any) -> Path:
    """The folder with top-level entries of its manifest replaced."""
    path = folder / layout.MANIFEST
    path.write_text(json.dumps({**json.loads(path.read_text()), **changes}))
    return folder


def test_a_folder_without_manifest_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ExportError, match=r"manifest\.json cannot be read .* is .* an asset"):
        read_bundle(tmp_path)


@pytest.mark.parametrize("text", ["", "{", "[1, 2]", '"text"', "null"])
def test_a_manifest_that_is_no_object_is_refused(folder: Path, text: str) -> None:
    (folder / layout.MANIFEST).write_text(text)
    with pytest.raises(ExportError, match=r"manifest\.json"):
        read_bundle(folder)


def test_another_schema_is_named(folder: Path) -> None:
    with pytest.raises(ExportError, match="'artgen-bundle/0'.*'artgen-bundle/2'"):
        read_bundle(edited(folder, schema="artgen-bundle/0"))


@pytest.mark.parametrize(
    "changes",
    [
        {"parts": None},
        {"parts": [{}]},
        {"joints": []},
        {"bounds": [0, 1]},
        {"radius": "wide"},
        {"preconditions": [{"joint": "slide", "requires": "nothing", "at_least": 1.0}]},
    ],
)
def test_damage_is_an_export_error(folder: Path, changes: dict[str, Any]) -> None:
    with pytest.raises(ExportError, match="damaged"):
        read_bundle(edited(folder, **changes))


def test_an_unknown_part_is_named_with_the_known(folder: Path) -> None:
    with pytest.raises(ExportError, match="'lid'; it has base, drawer, door, knob"):
        read_bundle(folder).load_mesh("lid")


def test_the_report_is_not_part_of_the_manifest(folder: Path) -> None:
    (folder / layout.REPORT).write_text("{}")
    assert layout.REPORT not in manifest(drawer_unit(), folder)["files"]
