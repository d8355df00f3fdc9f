"""Meshes and joints of PARIS, Digital Twin Art, ArtGS and their ground truth."""

import math
from pathlib import Path

import numpy as np
import pytest

from artgen.articulation.targets import PRISMATIC, REVOLUTE
from artgen.core.errors import ModelError
from model.evaluation.adapters.mesh_joints import (
    layout_of_artgs,
    layout_of_dta,
    layout_of_paris,
    layout_of_two_states,
)
from model.evaluation.joints import line_distance
from model.evaluation.matching import by_order
from model.evaluation.paris import paris
from tests.unit.model.evaluation.adapters.outputs import (
    write_artgs,
    write_dta,
    write_paris,
    write_two_states,
)
from tests.unit.model.evaluation.layouts import DOOR


def test_paris_turns(tmp_path: Path) -> None:
    layout = layout_of_paris(write_paris(tmp_path / "fridge", "rotate"))
    assert layout.types.tolist() == [0, REVOLUTE]
    assert np.allclose(layout.boxes[1], DOOR, rtol=0.0, atol=1e-7)  # PLY holds float32.
    assert layout.limits[1].tolist() == pytest.approx([0.0, 1.5], abs=1e-15)
    assert layout.axes[1].tolist() == [0.0, 0.0, -1.0]


def test_paris_slides_twice_its_half(tmp_path: Path) -> None:
    layout = layout_of_paris(write_paris(tmp_path / "storage", "translate"))
    assert layout.types.tolist() == [0, PRISMATIC]
    assert layout.states is not None
    assert layout.states.tolist() == [[0.0, 0.0], [0.0, 0.5]]


def test_the_longest_run_of_paris_is_read(tmp_path: Path) -> None:
    """By its number of updates: by name, it5000 would come after it20000."""
    folder = write_paris(tmp_path, "rotate")
    for path in list(folder.iterdir()):
        early = folder / path.name.replace("it20000", "it5000")
        early.write_text("damaged", encoding="utf-8")
    assert len(layout_of_paris(folder)) == 2


def test_dta_states_rigid_motions(tmp_path: Path) -> None:
    layout = layout_of_dta(write_dta(tmp_path / "step_0004000"))
    assert layout.types.tolist() == [0, PRISMATIC, REVOLUTE]
    assert layout.limits[:, 1].tolist() == pytest.approx([0.0, 0.25, 1.5], abs=1e-14)
    # Eigenvectors and a least-squares solve of a matrix with condition 1 / sin(0.75): 1e-14.
    assert np.allclose(layout.axes[2], (0.0, 0.0, -1.0), rtol=0.0, atol=1e-14)
    gap = line_distance(
        layout.origins[2], layout.axes[2], np.array([0.2, 0.1, 9.0]), layout.axes[2]
    )
    assert gap == pytest.approx(0.0, abs=1e-13)


def test_without_an_axis_mesh_the_turn_tells(tmp_path: Path) -> None:
    folder = write_dta(tmp_path)
    for path in folder.glob("init_axis_*"):
        path.unlink()
    assert layout_of_dta(folder).types.tolist() == [0, PRISMATIC, REVOLUTE]


def test_a_half_turn_has_an_axis(tmp_path: Path) -> None:
    """At pi the antisymmetric part of R vanishes: the axis is that of an eigenvector."""
    folder = write_dta(tmp_path)
    text = '[{"rotation": [[-1,0,0],[0,-1,0],[0,0,1]], "translation": [0.4, 0.2, 0]}]'
    for path in folder.glob("init_p*_motion.json"):
        path.unlink()
    (folder / "init_motion.json").write_text(text, encoding="utf-8")
    (folder / "init_axis_0_prismatic.obj").unlink()
    layout = layout_of_dta(folder)
    assert abs(layout.axes[1, 2]) == pytest.approx(1.0, abs=1e-15)
    assert layout.origins[1].tolist() == pytest.approx([0.2, 0.1, 0.0], abs=1e-15)
    assert layout.limits[1, 1] == pytest.approx(math.pi, abs=3e-8)  # asin at 1.


def test_artgs_is_scored_against_the_ground_truth(tmp_path: Path) -> None:
    truth = layout_of_two_states(write_two_states(tmp_path / "gt"))
    guess = layout_of_artgs(write_artgs(tmp_path / "artgs"))
    found = paris(guess, truth, by_order(3, 3))
    assert found.axis_deg == 0.0
    assert found.position == pytest.approx(0.0, abs=1e-14)
    assert found.motion_deg == pytest.approx(0.0, abs=1e-13)
    assert found.motion_length == 0.0
    assert found.cd_whole is not None
    # Two samples of an area of about 6 + 3 + 4, with A / (pi N) each: in thousandths below 2.
    assert 0.0 < found.cd_whole < 2.0


def test_a_missing_part_and_a_strange_type_are_told(tmp_path: Path) -> None:
    folder = write_artgs(tmp_path)
    (folder / "part_2.ply").unlink()
    with pytest.raises(ModelError, match="no part_2 with one of"):
        layout_of_artgs(folder)
    text = (folder / "joints.json").read_text(encoding="utf-8").replace('"p"', '"screw"')
    (folder / "joints.json").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match="'screw' is none of"):
        layout_of_artgs(folder)
    with pytest.raises(ModelError, match="none of init_motion"):
        layout_of_dta(folder)
