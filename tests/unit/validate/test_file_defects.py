"""Defects planted in the files of a sound bundle: the check that is there for each names it."""

import math
import shutil
from pathlib import Path

import pytest

from artgen.export.layout import GLB, MANIFEST, MJCF, URDF, mesh_path
from artgen.validate import validate_bundle
from tests.unit.validate.cabinet import ASSET, cupboard, write_quick_bundle
from tests.unit.validate.edits import (
    Edit,
    all_flipped,
    append,
    collapsed,
    cut,
    delete,
    edit_manifest,
    first_line,
    flipped,
    in_mjcf,
    in_urdf,
    joint_axis,
    joint_number,
    obj_lines,
    part_field,
    replaced,
    sign,
    without,
)

DOOR_OBJ = mesh_path(ASSET, "door")
DRAWER_OBJ = mesh_path(ASSET, "drawer")

UNSIGNED: dict[str, tuple[str, str, Edit]] = {
    "changed after export": ("files.hash", URDF, append(URDF, b"\n")),
    "missing file": ("files.file", DOOR_OBJ, delete(DOOR_OBJ)),
    "foreign file": ("files.file", "notes.txt", append("notes.txt", b"hello")),
    "no manifest": ("files.readable", MANIFEST, delete(MANIFEST)),
    "no urdf": ("files.readable", URDF, delete(URDF)),
    "manifest cut short": ("files.readable", MANIFEST, cut(MANIFEST)),
    "mjcf cut short": ("files.readable", MJCF, cut(MJCF)),
    "schema of another version": (
        "files.readable",
        MANIFEST,
        replaced(MANIFEST, "artgen-bundle/2", "artgen-bundle/0"),
    ),
    "manifest without joints": (
        "files.readable",
        MANIFEST,
        lambda folder: edit_manifest(folder, lambda m: m.pop("joints")),
    ),
}
"""Name to (check, subject of the finding, edit); hashes stay as they were."""

SIGNED: dict[str, tuple[str, str, Edit]] = {
    "mesh deleted from bundle and list": ("files.file", DOOR_OBJ, delete(DOOR_OBJ)),
    "absolute path": (
        "files.path",
        f"/data/{DOOR_OBJ}",
        replaced(URDF, DOOR_OBJ, f"/data/{DOOR_OBJ}"),
    ),
    "package path": (
        "files.path",
        f"package://x/{DOOR_OBJ}",
        replaced(URDF, DOOR_OBJ, f"package://x/{DOOR_OBJ}"),
    ),
    "path out of the bundle": (
        "files.path",
        f"../{DOOR_OBJ}",
        replaced(MJCF, DOOR_OBJ, f"../{DOOR_OBJ}"),
    ),
    "two meshes of one base name": (
        "files.basename",
        f"{ASSET}_door",
        replaced(MJCF, DOOR_OBJ, f"collision/{ASSET}_door.obj"),
    ),
    "too many bytes": ("files.budget", "bundle", append("textures/big.png", bytes(3_000_001))),
    "axis of length zero": ("structure.axis", "hinge", joint_axis("hinge", (0.0, 0.0, 0.0))),
    "axis of length two": ("structure.axis", "hinge", joint_axis("hinge", (0.0, 0.0, -2.0))),
    "axis not a number": ("structure.axis", "slide", joint_axis("slide", (math.nan, -1.0, 0.0))),
    "degrees for radians": ("structure.turn", "hinge", joint_number("hinge", "upper", 110.0)),
    "lower above upper": ("structure.limit", "slide", joint_number("slide", "upper", -0.3)),
    "empty range": ("structure.limit", "slide", joint_number("slide", "upper", 0.0)),
    "infinite range": ("structure.limit", "slide", joint_number("slide", "upper", math.inf)),
    "range without a number": (
        "structure.limit",
        "slide",
        joint_number("slide", "upper", math.nan),
    ),
    "rest inside the range": ("structure.rest", "hinge", joint_number("hinge", "lower", -0.4)),
    "rest outside the range": ("structure.rest", "hinge", joint_number("hinge", "lower", 0.4)),
    "no effort": ("structure.effort", "slide", joint_number("slide", "effort", 0.0)),
    "negative effort": ("structure.effort", "slide", joint_number("slide", "effort", -5.0)),
    "no velocity": ("structure.velocity", "slide", joint_number("slide", "velocity", 0.0)),
    "negative damping": ("structure.damping", "hinge", joint_number("hinge", "damping", -0.01)),
    "negative friction": ("structure.friction", "hinge", joint_number("hinge", "friction", -1.0)),
    "friction not a number": (
        "structure.friction",
        "slide",
        joint_number("slide", "friction", math.nan),
    ),
    "joint of an unknown type": (
        "structure.type",
        "hinge",
        in_urdf("joint[@name='hinge']", "type", "fixed"),
    ),
    "duplicate joint names": (
        "structure.tree",
        "slide",
        in_urdf("joint[@name='hinge']", "name", "slide"),
    ),
    "duplicate link names": (
        "structure.tree",
        "door",
        in_urdf("link[@name='drawer']", "name", "door"),
    ),
    "two roots": ("structure.tree", "base, door", without("joint[@name='hinge']")),
    "two parents": (
        "structure.tree",
        "drawer",
        in_urdf("joint[@name='hinge']/child", "link", "drawer"),
    ),
    "cycle": ("structure.tree", "hinge", in_urdf("joint[@name='hinge']/parent", "link", "lid")),
    "link without inertial": ("structure.link", "door", without("link[@name='door']/inertial")),
    "link without collision": (
        "structure.link",
        "drawer",
        without("link[@name='drawer']/collision"),
    ),
    "link without visual": ("structure.link", "door", without("link[@name='door']/visual")),
    "urdf axis flipped": (
        "structure.agreement",
        "slide",
        in_urdf("joint[@name='slide']/axis", "xyz", "0.0 1.0 0.0"),
    ),
    "urdf limit rounded": (
        "structure.agreement",
        "hinge",
        in_urdf("joint[@name='hinge']/limit", "upper", "1.92"),
    ),
    "pivot not a number": (
        "structure.origin",
        "hinge",
        in_urdf("joint[@name='hinge']/origin", "xyz", "nan 0 0"),
    ),
    "base not first": (
        "structure.manifest",
        MANIFEST,
        lambda folder: edit_manifest(folder, lambda m: m["parts"].reverse()),
    ),
    "precondition on nothing": (
        "structure.manifest",
        MANIFEST,
        lambda folder: edit_manifest(
            folder,
            lambda m: m["preconditions"].append(
                {"joint": "slide", "requires": "lid", "at_least": 1.0}
            ),
        ),
    ),
    "mass zero": (
        "inertia.mass",
        "door",
        in_urdf("link[@name='door']/inertial/mass", "value", "0.0"),
    ),
    "mass not a number": ("inertia.mass", "door", part_field("door", "mass", math.nan)),
    "inertia not positive": (
        "inertia.tensor",
        "door",
        in_urdf("link[@name='door']/inertial/inertia", "ixy", "10.0"),
    ),
    "triangle inequality broken": (
        "inertia.tensor",
        "door",
        in_urdf("link[@name='door']/inertial/inertia", "ixx", "10.0"),
    ),
    "inertia of a needle": (
        "inertia.tensor",
        "drawer",
        part_field("drawer", "inertia", [[1, 0, 0], [0, 1, 0], [0, 0, 1e-7]]),
    ),
    "vertex not a number": (
        "mesh.readable",
        DOOR_OBJ,
        obj_lines("door", first_line("v", lambda _: "v nan 0 0")),
    ),
    "vertex not readable": (
        "mesh.readable",
        DOOR_OBJ,
        obj_lines("door", first_line("v", lambda _: "v a b c")),
    ),
    "face names a missing vertex": (
        "mesh.readable",
        DOOR_OBJ,
        obj_lines("door", first_line("f", lambda _: "f 1/1/1 2/1/1 999/1/1")),
    ),
    "face names one vertex twice": (
        "mesh.readable",
        DOOR_OBJ,
        obj_lines("door", first_line("f", collapsed)),
    ),
    "hole in a mesh": (
        "mesh.closed",
        "drawer, body 0",
        obj_lines("drawer", first_line("f", lambda _: None)),
    ),
    "one face flipped": (
        "mesh.closed",
        "drawer, body 0",
        obj_lines("drawer", first_line("f", flipped)),
    ),
    "whole mesh inside out": ("mesh.volume", "drawer, body 0", obj_lines("drawer", all_flipped)),
    "vertex moved": (
        "mesh.manifest",
        "base",
        obj_lines("base", first_line("v", lambda _: "v -0.31 -0.18 0.0")),
    ),
    "triangles without area": (
        "mesh.triangle",
        "base",
        obj_lines("base", first_line("v", lambda _: "v -0.3 -0.18 0.7")),
    ),
    "atlas outside the square": (
        "mesh.atlas",
        "door",
        obj_lines("door", first_line("vt", lambda _: "vt 1.2 0.5")),
    ),
    "glb node renamed": ("mesh.glb", "door", replaced(GLB, '"name": "door"', '"name": "Door"')),
    "glb cut short": ("mesh.glb", GLB, cut(GLB)),
    "glb door elsewhere": ("mesh.glb", "door", replaced(GLB, "-0.298", "-0.299")),
    "density of air": ("inertia.density", "door", part_field("door", "densities", [1.2, 700.0])),
    "mjcf limit in degrees": (
        "compile.limit",
        "hinge",
        in_mjcf(".//joint[@name='hinge']", "range", "0 110"),
    ),
    "mjcf limit not in force": (
        "compile.limit",
        "slide",
        in_mjcf(".//joint[@name='slide']", "limited", "false"),
    ),
    "mjcf joint of another kind": (
        "compile.joint",
        "slide",
        in_mjcf(".//joint[@name='slide']", "type", "hinge"),
    ),
    "mjcf joint renamed": (
        "compile.joint",
        "slide",
        in_mjcf(".//joint[@name='slide']", "name", "glide"),
    ),
    "mjcf ball joint": ("compile.dof", MJCF, in_mjcf(".//joint[@name='slide']", "type", "ball")),
    "mjcf body renamed": (
        "compile.body",
        "door",
        in_mjcf(".//body[@name='door']", "name", "flap"),
    ),
    "mjcf mass": ("compile.mass", "door", in_mjcf(".//body[@name='door']/inertial", "mass", "3.0")),
    "mjcf center of mass at the origin": (
        "compile.mass",
        "door",
        in_mjcf(".//body[@name='door']/inertial", "pos", "0 0 0"),
    ),
    "mjcf does not compile": (
        "compile.file",
        MJCF,
        in_mjcf(".//joint[@name='slide']", "axis", "0 0 0"),
    ),
    "mjcf axis flipped": (
        "motion.kinematics",
        "drawer",
        in_mjcf(".//joint[@name='slide']", "axis", "0 1 0"),
    ),
    "mjcf axis tilted by a microradian": (
        "motion.kinematics",
        "door",
        in_mjcf(".//joint[@name='hinge']", "axis", "1e-6 0 -1"),
    ),
    "urdf pivot off by a micrometer": (
        "motion.kinematics",
        "door",
        in_urdf("joint[@name='hinge']/origin", "xyz", "-0.298001 -0.2 0.0"),
    ),
}
"""As above, with hashes brought up to date after the edit."""


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_quick_bundle(cupboard(), tmp_path_factory.mktemp("sound") / "bundle")


def test_the_sound_bundle_has_no_finding(sound: Path) -> None:
    report = validate_bundle(sound)
    assert [str(finding) for finding in report.findings] == []
    assert report.ok
    assert [skipped.name for skipped in report.skipped] == [
        "semantics.band",
        "dynamics.effects",  # proven on one asset in fifty
    ]


@pytest.mark.parametrize("name", UNSIGNED)
def test_a_spoilt_file_is_named(name: str, sound: Path, tmp_path: Path) -> None:
    check, part, edit = UNSIGNED[name]
    assert (check, part) in found(sound, tmp_path, edit)


@pytest.mark.parametrize("name", SIGNED)
def test_a_planted_defect_is_named(name: str, sound: Path, tmp_path: Path) -> None:
    check, part, edit = SIGNED[name]

    def signed(folder: Path) -> None:
        edit(folder)
        sign(folder)

    assert (check, part) in found(sound, tmp_path, signed)


def found(sound: Path, tmp_path: Path, edit: Edit) -> set[tuple[str, str]]:
    """(check, part without its file) of every finding on an edited copy."""
    folder = tmp_path / "copy"
    shutil.copytree(sound, folder)
    edit(folder)
    report = validate_bundle(folder)
    assert not report.ok
    return {(f.check, f.part.partition(" (")[0]) for f in report.findings}
