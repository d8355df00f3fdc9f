"""URDFs of anyone, and URDFormer's."""

from pathlib import Path

import numpy as np
import pytest

from artgen.articulation.targets import PRISMATIC, REVOLUTE
from artgen.core.errors import ModelError
from model.evaluation.adapters.urdf import layout_of_urdf, layout_of_urdformer
from tests.unit.model.evaluation.adapters.outputs import write_urdf, write_urdformer
from tests.unit.model.evaluation.layouts import DOOR, DRAWER


def test_frames_of_links_are_brought_to_the_object(tmp_path: Path) -> None:
    layout = layout_of_urdf(write_urdf(tmp_path / "cabinet"))
    assert layout.labels == ("base", "drawer", "door")
    assert layout.types.tolist() == [0, PRISMATIC, REVOLUTE]
    assert np.allclose(layout.boxes[1], DRAWER, rtol=0.0, atol=1e-15)
    # sin(pi) is 1.2e-16; the knob is within the door's box by x and z, and before it by y.
    assert np.allclose(layout.boxes[2][:, ::2], np.array(DOOR)[:, ::2], rtol=0.0, atol=1e-15)
    assert layout.boxes[2][0, 1] == pytest.approx(-0.25, abs=1e-15)
    assert layout.axes[2].tolist() == [0.0, 0.0, -1.0]
    assert layout.origins[2, :2] == pytest.approx([0.0, -0.1], abs=1e-16)
    assert layout.limits.tolist() == [[0.0, 0.0], [0.0, 0.5], [0.0, 1.5]]


def test_a_part_without_a_shape_is_left_out(tmp_path: Path) -> None:
    file = write_urdf(tmp_path / "cabinet")
    (file.parent / "drawer.obj").unlink()
    assert layout_of_urdf(file).labels == ("base", "door")


def test_a_bare_root_carries_the_rest(tmp_path: Path) -> None:
    file = write_urdf(tmp_path / "cabinet")
    (file.parent / "base.obj").unlink()
    layout = layout_of_urdf(file)
    assert layout.labels == ("base", "drawer", "door")
    assert np.ptp(layout.boxes[0]) >= 0.0
    assert layout.parents.tolist() == [-1, 0, 0]


def test_urdformers_front_is_turned_to_ours(tmp_path: Path) -> None:
    layout = layout_of_urdformer(write_urdformer(tmp_path))
    assert layout.axes[1].tolist() == [0.0, -1.0, 0.0]
    # Width 2 along their y is along our x; depth 1 behind the front plane.
    assert layout.boxes[0].tolist() == [[0.0, 0.0, 0.0], [2.0, 1.0, 1.0]]
    expected = [[0.25, -0.1, 0.5], [1.75, 0.5, 1.0]]
    assert np.allclose(layout.boxes[1], expected, rtol=0.0, atol=1e-15)


def test_what_is_no_urdf_is_told(tmp_path: Path) -> None:
    file = tmp_path / "x.urdf"
    file.write_text("<robot>", encoding="utf-8")
    with pytest.raises(ModelError, match=r"x\.urdf states no object"):
        layout_of_urdf(file)
    file.write_text('<robot name="x"><link name="a"/></robot>', encoding="utf-8")
    with pytest.raises(ModelError, match="no part has a shape"):
        layout_of_urdf(file)
