"""SINGAPO's trees."""

import json
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import ModelError
from model.evaluation.adapters.singapo_json import layout_of_singapo
from model.evaluation.layout import HANDLE
from model.evaluation.reshape import without
from tests.unit.model.evaluation.adapters.outputs import write_singapo
from tests.unit.model.evaluation.layouts import cabinet


def test_the_tree_in_our_axes(tmp_path: Path) -> None:
    layout = layout_of_singapo(write_singapo(tmp_path / "41085"))
    assert layout.name == "41085"
    assert layout.category == "StorageFurniture"
    assert layout.labels == ("base", "drawer", "door", "handle")
    ours = without(layout, lambda label: label == HANDLE)
    truth = cabinet()
    assert np.allclose(ours.boxes, truth.boxes, rtol=0.0, atol=1e-15)
    assert np.allclose(ours.limits, truth.limits, rtol=0.0, atol=1e-15)
    # +y there is up; the negative range turns it around to our -z.
    assert np.allclose(ours.axes, truth.axes, rtol=0.0, atol=0.0)
    assert layout.parents.tolist() == [-1, 0, 0, 2]


def test_meshes_are_read_where_they_are(tmp_path: Path) -> None:
    layout = layout_of_singapo(write_singapo(tmp_path / "41085"))
    assert [mesh is None for mesh in layout.meshes] == [True, False, False, True]
    assert layout.meshes[1] is not None
    assert np.allclose(layout.meshes[1].bounds, layout.boxes[1], rtol=0.0, atol=1e-7)  # float PLY.


def test_continuous_and_screw(tmp_path: Path) -> None:
    file = write_singapo(tmp_path / "1")
    stated = json.loads(file.read_text(encoding="utf-8"))
    stated["diffuse_tree"][0]["joint"]["type"] = "screw"
    stated["diffuse_tree"][1]["joint"]["type"] = "continuous"
    file.write_text(json.dumps(stated), encoding="utf-8")
    layout = layout_of_singapo(file)
    assert layout.types.tolist() == [0, 0, 1, 0]
    assert layout.endless.tolist() == [False, False, True, False]


def test_another_file_is_told(tmp_path: Path) -> None:
    file = tmp_path / "object.json"
    file.write_text("{}", encoding="utf-8")
    with pytest.raises(ModelError, match="diffuse_tree"):
        layout_of_singapo(file)


def test_meshes_outside_the_folder_are_not_read(tmp_path: Path) -> None:
    file = write_singapo(tmp_path / "1")
    stated = json.loads(file.read_text(encoding="utf-8"))
    (tmp_path / "drawer.ply").write_bytes((tmp_path / "1" / "plys" / "drawer.ply").read_bytes())
    stated["diffuse_tree"][0]["plys"] = ["../drawer.ply"]
    file.write_text(json.dumps(stated), encoding="utf-8")
    assert layout_of_singapo(file).meshes[1] is None
