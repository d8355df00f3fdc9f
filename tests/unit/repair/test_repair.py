"""Repair writes a valid copy, says what it changed, and neither guesses nor touches the original.

The sound asset is the validator's cupboard; it is spoiled by the defects of `artgen study defects`.
"""

import json
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
import trimesh

from artgen.cli import main
from artgen.defect_study.in_meshes import MESH_DEFECTS
from artgen.defect_study.in_urdf import URDF_DEFECTS
from artgen.defect_study.urdf_edits import (
    collision_boxes,
    in_tree,
    on_joint,
    scaled,
    without_limits,
)
from artgen.export.layout import URDF
from artgen.geometry.measure import moments
from artgen.geometry.solid import prism
from artgen.repair import collision
from artgen.repair.cli import repair
from artgen.repair.collision import convex_pieces, open_interior
from tests.exported import write_without_blender
from tests.unit.validate.cabinet import cupboard

PLANTS = {defect.name: defect.plant for defect in (*URDF_DEFECTS, *MESH_DEFECTS)}

MENDED: Mapping[str, tuple[str, ...]] = {
    "mesh_inside_out": ("winding",),
    "mesh_mirrored": ("winding",),
    "mesh_half_turned": ("winding",),
    "mesh_doubled": ("faces",),
    "mesh_face_doubled": ("faces",),
    **dict.fromkeys(
        (
            *("mass_zero", "mass_negative", "mass_nan", "mass_grams", "mass_tonnes"),
            *("inertial_missing", "inertia_zero", "inertia_negative", "inertia_triangle"),
            *("inertia_tenfold", "inertia_grams_mm", "inertia_identity", "inertia_about_origin"),
            *("center_at_origin", "center_far"),
        ),
        ("inertial",),
    ),
    "limits_missing": ("limit effort", "limit lower", "limit upper", "limit velocity"),
    "effort_zero": ("limit effort",),
    "effort_negative": ("limit effort",),
    "velocity_zero": ("limit velocity",),
    "damping_negative": ("dynamics damping",),
    "friction_negative": ("dynamics friction",),
    "collision_missing": ("collision",),
    "collision_is_visual": ("collision",),
    "collision_shifted": ("collision",),
    "collision_grown": ("collision",),
}
REFUSED = (
    *("two_roots", "duplicate_link", "duplicate_joint", "unknown_parent", "unknown_child"),
    *("cycle", "self_loop", "two_parents", "joint_type", "no_joint_type", "truncated", "empty"),
    *("visual_path", "visual_outside", "visual_absolute", "visual_package"),
)
LEFT: Mapping[str, str] = {
    "axis_zero": "no direction",
    "axis_nan": "no direction",
    "axis_two_numbers": "no direction",
    "pivot_nan": "not six finite numbers",
    "limits_nan": "no numbers",
    "limits_equal": "leave no way",
    "limits_infinite": "infinite",
    "damping_nan": "no finite number",
    "mesh_hole": "holes",
    "mesh_nan": "not finite",
    "mesh_bad_index": "not there",
    "mesh_no_faces": "0 triangles",
    "mesh_mm": "mistake of units",
    "visual_scale": "mistake of units",
}


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_without_blender(cupboard(), tmp_path_factory.mktemp("sound") / "cupboard")


@pytest.fixture
def folder(sound: Path, tmp_path: Path) -> Path:
    """A copy to spoil."""
    return Path(shutil.copytree(sound, tmp_path / "in"))


def contents(folder: Path) -> dict[Path, bytes]:
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def mended(folder: Path, code: int) -> dict[str, list[dict[str, str]]]:
    """What `repair.json` says, when the command ends with that code and leaves its input alone."""
    before, out = contents(folder), folder.with_name("out")
    assert repair([str(folder / URDF), "--out", str(out)]) == code
    assert contents(folder) == before
    assert json.loads((out / "report.json").read_text())["ok"] == (code == 0)
    return dict(json.loads((out / "repair.json").read_text()))


def test_a_sound_asset_comes_out_byte_for_byte(folder: Path) -> None:
    assert mended(folder, 0) | {"schema": ""} == {"schema": "", "changes": [], "left": []}
    made = contents(folder.with_name("out"))
    del made[Path("repair.json")], made[Path("report.json")]
    original = contents(folder)
    assert {Path(URDF), *(path for path in original if path.suffix == ".obj")} <= set(made)
    assert made == {path: original[path] for path in made}


@pytest.mark.parametrize("name", MENDED)
def test_what_can_be_mended_is_and_is_told(name: str, folder: Path) -> None:
    PLANTS[name](folder)
    said = mended(folder, 0)
    assert sorted(change["what"] for change in said["changes"]) == sorted(MENDED[name])
    assert said["left"] == []


@pytest.mark.parametrize("name", LEFT)
def test_what_would_be_a_guess_is_left_and_told(name: str, folder: Path) -> None:
    PLANTS[name](folder)
    said = mended(folder, 1)
    assert said["changes"] == []
    assert any(LEFT[name] in left["why"] for left in said["left"])


@pytest.mark.parametrize("name", REFUSED)
def test_broken_trees_and_missing_files_are_refused(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    PLANTS[name](folder)
    before, out = contents(folder), folder.with_name("out")
    assert main(["repair", str(folder / URDF), "--out", str(out)]) == 2
    assert "cannot be mended" in capsys.readouterr().err
    assert contents(folder) == before
    assert not out.exists()


def test_exchanged_limits_and_a_long_axis_are_put_right(folder: Path) -> None:
    for key, value in (("lower", "0.3"), ("upper", "0")):
        on_joint("limit", key, value, "prismatic")(folder)
    on_joint("axis", "xyz", "0 -3 0", "prismatic")(folder)
    said = {change["what"]: change["to"] for change in mended(folder, 0)["changes"]}
    assert said == {"limit lower": "0.0", "limit upper": "0.3", "axis xyz": "0.0 -1.0 0.0"}


@pytest.mark.parametrize(
    ("factor", "kept"), [(1.2, True), (1e3, False), (1e-3, False)], ids=["kg", "grams", "tonnes"]
)
def test_a_mass_is_kept_where_its_density_is_plausible(
    factor: float, kept: bool, folder: Path
) -> None:
    """The door of 700 kg/m3: 1.2 times its mass may be its own, 1000 times it may not."""
    true = stated_mass(folder)
    scaled("inertial/mass", "value", factor)(folder)
    PLANTS["inertia_identity"](folder)
    (change,) = mended(folder, 0)["changes"]
    assert ("the stated mass is kept" in change["why"]) == kept
    assert ("700 kg/m3 is assumed" in change["why"]) != kept
    expected = factor * true if kept else true
    # Sums of 24 triangles over values of one size: 1e-15, and 1e-9 is what the validator allows.
    assert stated_mass(folder.with_name("out")) == pytest.approx(expected, rel=1e-9)


def stated_mass(folder: Path) -> float:
    element = ET.parse(folder / URDF).find("link[@name='door']/inertial/mass")
    assert element is not None
    return float(element.get("value", "nan"))


def test_limits_are_swept_for_the_way_that_is_free(folder: Path) -> None:
    """The door can turn outward alone: [0, a quarter turn], and not the other way round."""
    in_tree(without_limits)(folder)
    said = {change["what"]: change for change in mended(folder, 0)["changes"]}
    assert float(said["limit lower"]["to"]) == 0.0
    assert float(said["limit upper"]["to"]) == pytest.approx(np.pi / 2.0, rel=1e-15)
    assert all("assumed" in change["why"] for change in said.values())


def test_an_stl_that_faces_inward_becomes_an_obj_that_does_not(folder: Path) -> None:
    (path,) = (folder / "meshes").glob("*_door.obj")
    mesh = trimesh.load_mesh(path, process=False)
    mesh.faces = mesh.faces[:, ::-1]
    stl = path.with_suffix(".stl")
    stl.write_bytes(mesh.export(file_type="stl"))
    text = (folder / URDF).read_text()
    (folder / URDF).write_text(text.replace(path.name, stl.name))
    said = mended(folder, 0)["changes"]
    assert [change["what"] for change in said] == ["mesh", "winding"]
    assert f"{stl.stem}_mended.obj" in (folder.with_name("out") / URDF).read_text()


def test_an_out_folder_that_holds_something_is_refused(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = contents(folder)
    assert main(["repair", str(folder / URDF), "--out", str(folder)]) == 2
    assert "not empty" in capsys.readouterr().err
    assert contents(folder) == before


ANGLE = ((0, 0), (0.3, 0), (0.3, 0.02), (0.02, 0.02), (0.02, 0.3), (0, 0.3))


def test_a_concave_body_falls_into_pieces_that_leave_its_mouth_open() -> None:
    """An angle iron: of 50800 mm2 of hull, 11600 are iron and 77.2 % open; two boxes
    leave all of it, slanted cuts a little less."""
    mesh = prism(ANGLE, 0.2).trimesh()
    pieces = convex_pieces(mesh, 4)
    assert 2 <= len(pieces) <= 4
    said = open_interior(mesh, pieces)
    assert said.startswith("the mesh leaves 77.2% of its hull open")
    assert float(said.split("pieces ")[1].split("%")[0]) > 95.0
    volume = sum(moments(piece.triangles).volume for piece in pieces)
    assert volume == pytest.approx(moments(mesh.triangles).volume, rel=0.05)


def test_without_coacd_collision_is_left_and_the_command_says_so(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No hull takes the place of pieces that could not be made."""
    PLANTS["collision_missing"](folder)
    monkeypatch.setattr(collision, "CONVEX", 2.0)  # Every body then asks for CoACD.
    monkeypatch.setattr("sys.executable", "/bin/false")
    said = mended(folder, 1)
    assert said["changes"] == []
    assert [left["subject"] for left in said["left"]] == ["door"]
    assert "pip install 'artgen[qa]'" in said["left"][0]["why"]


def test_pieces_that_meet_where_the_meshes_do_not_are_replaced(folder: Path) -> None:
    """3 mm of padding around boards that clear each other by 2: within what pieces may stick out,
    but the door touches the drawer."""
    collision_boxes(lambda center, size: (center, size + 0.006))(folder)
    said = mended(folder, 0)["changes"]
    assert {change["what"] for change in said} == {"collision"}
    assert all("where the meshes of" in change["why"] for change in said)


def test_pieces_of_another_scale_are_replaced_by_those_of_the_mesh(folder: Path) -> None:
    """A visual and its mass in a scale that the collision does not share."""
    scaled("collision/geometry/box", "size", 1.2)(folder)
    assert [change["what"] for change in mended(folder, 0)["changes"]] == ["collision"]
