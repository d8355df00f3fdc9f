"""Repair writes a copy that is valid, says what it changed, and leaves the original alone."""

import json
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import UsageError
from artgen.export.layout import URDF
from artgen.geometry.measure import moments
from artgen.geometry.solid import prism
from artgen.validate.interior import inside_any
from artgen.validate.repair import convex_pieces
from artgen.validate.repair_cli import repair
from tests.exported import write_without_blender
from tests.unit.validate.cabinet import cupboard
from tests.unit.validate.edits import Edit, in_urdf, without
from tests.unit.validate.test_foreign import in_joint, in_link, times, verdict


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_without_blender(cupboard(), tmp_path_factory.mktemp("written") / "cupboard")


def concave(folder: Path) -> None:
    """One collision mesh for the whole carcass: simulators make a block of it."""
    tree = ET.parse(folder / URDF)
    link = tree.find("link[@name='base']")
    assert link is not None
    visual = link.find("visual")
    assert visual is not None
    for old in link.findall("collision"):
        link.remove(old)
    collision = ET.SubElement(link, "collision")
    collision.extend(list(visual))
    tree.write(folder / URDF)


def repeated_faces(folder: Path) -> None:
    """The first triangle of the door stands there three times."""
    (path,) = (folder / "meshes").glob("*_door.obj")
    first = next(line for line in path.read_text().splitlines() if line.startswith("f "))
    with path.open("a") as stream:
        stream.write(f"{first}\n{first}\n")


MENDED: dict[str, tuple[Sequence[Edit], Sequence[str]]] = {
    "nothing": ((), ()),
    "no mass properties": ((without("link[@name='door']/inertial"),), ("inertial",)),
    "tensor off": ((times("door", 0.1),), ("inertial",)),
    "center outside": ((in_link("door", "inertial/origin", "xyz", "0 1 0"),), ("inertial",)),
    "negative mass": ((in_link("door", "inertial/mass", "value", "-1"),), ("inertial",)),
    "bounds exchanged": (
        (in_joint("slide", "limit", "lower", "0.3"), in_joint("slide", "limit", "upper", "0")),
        ("limit lower", "limit upper"),
    ),
    "damping below 0": ((in_joint("hinge", "dynamics", "damping", "-1"),), ("dynamics damping",)),
    "effort of 0": ((in_joint("hinge", "limit", "effort", "0"),), ("limit effort",)),
    "long axis": ((in_joint("slide", "axis", "xyz", "0 -3 0"),), ("axis xyz",)),
    "no collision": ((without("link[@name='drawer']/collision"),), ("collision",)),
    "concave collision": ((concave,), ("collision",)),
    "faces twice": ((repeated_faces,), ("mesh",)),
}  # fmt: skip


@pytest.mark.parametrize("name", MENDED)
def test_what_is_broken_is_mended_and_told(name: str, written: Path, tmp_path: Path) -> None:
    edits, what = MENDED[name]
    folder, out = tmp_path / "in", tmp_path / "out"
    shutil.copytree(written, folder)
    for edit in edits:
        edit(folder)
    assert verdict(folder / URDF, "standard").ok == (not edits)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert repair([str(folder / URDF), "--out", str(out)]) == 0
    assert {path: path.read_bytes() for path in before} == before
    changes = json.loads((out / "repair.json").read_text())
    assert sorted(change["what"] for change in changes) == sorted(what)
    assert json.loads((out / "report.json").read_text())["ok"]


def test_a_limit_that_nobody_stated_is_assumed_and_said_so(written: Path, tmp_path: Path) -> None:
    shutil.copytree(written, tmp_path / "in")
    without("joint[@name='slide']/limit")(tmp_path / "in")
    repair([str(tmp_path / "in" / URDF), "--out", str(tmp_path / "out")])
    changes = json.loads((tmp_path / "out" / "repair.json").read_text())
    assert {change["what"] for change in changes} == {
        *("limit lower", "limit upper", "limit effort", "limit velocity")
    }
    assert any("is assumed" in change["reason"] for change in changes)


def test_the_original_folder_and_broken_trees_are_refused(written: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="own folder"):
        repair([str(written / URDF), "--out", str(written)])
    shutil.copytree(written, tmp_path / "in")
    in_urdf("joint[@name='slide']/child", "link", "door")(tmp_path / "in")
    with pytest.raises(UsageError, match="cannot be mended"):
        repair([str(tmp_path / "in" / URDF), "--out", str(tmp_path / "out")])


def test_a_bent_body_falls_into_convex_pieces_that_leave_its_hollow_open() -> None:
    """An angle iron: CoACD's pieces hold its corner points and not the middle of its mouth."""
    mesh = prism(
        [(0, 0), (0.3, 0), (0.3, 0.02), (0.02, 0.02), (0.02, 0.3), (0, 0.3)], 0.2
    ).trimesh()
    pieces = convex_pieces(mesh, 4)
    assert 2 <= len(pieces) <= 4
    assert not inside_any(np.array([[0.15, 0.15, 0.1]]), pieces, 0.0).any()
    volume = sum(moments(piece.triangles).volume for piece in pieces)
    assert volume == pytest.approx(moments(mesh.triangles).volume, rel=0.05)
