"""Grips of a bundle: stated alike in every file, within reach, and pulled as the joint goes."""

import dataclasses
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import pytest

from artgen.articulation.types import ArticulatedObject, Grip, Vector
from artgen.export.layout import MJCF, URDF
from artgen.validate import validate_bundle
from tests.unit.validate.cabinet import cupboard, write_quick_bundle
from tests.unit.validate.edits import edit_manifest, sign
from tests.unit.validate.test_foreign import verdict

FRONT: Vector = (0.0, -1.0, 0.0)
HANDLE = Grip(
    name="door_handle", kind="handle", position=(0.205, -0.2025, 0.28), outward=FRONT, pull=FRONT
)
EDGE = Grip(name="drawer_edge", kind="edge", position=(0.0, -0.2, 0.69), outward=FRONT, pull=FRONT)


def held(door: Grip | None = HANDLE, drawer: Grip = EDGE) -> ArticulatedObject:
    """The cabinet, with a handle on its door and an edge of its drawer to pull at."""
    obj = cupboard()
    grips = {"door": () if door is None else (door,), "drawer": (drawer,)}
    parts = tuple(dataclasses.replace(p, grips=grips.get(p.name, ())) for p in obj.parts)
    return dataclasses.replace(obj, parts=parts)


def with_grip(**fields: object) -> ArticulatedObject:
    return held(door=dataclasses.replace(HANDLE, **fields))  # type: ignore[arg-type]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_quick_bundle(held(), tmp_path / "bundle")


def test_a_sound_grip_is_valid_in_every_format(folder: Path) -> None:
    assert [str(f) for f in validate_bundle(folder).findings] == []
    for file in (URDF, MJCF):
        assert [str(f) for f in verdict(folder / file).findings] == []


BUILT_IN = {
    "in the air": with_grip(position=(0.205, -0.26, 0.28)),
    "inside the carcass": with_grip(position=(0.295, -0.17, 0.28), outward=(0.0, 1.0, 0.0)),
    "behind its own door, where the carcass is": with_grip(
        position=(0.29, -0.182, 0.28), outward=(0.0, 1.0, 0.0)
    ),
    "pushed shut": with_grip(pull=(0.0, 1.0, 0.0)),
    "pulled along the hinge": with_grip(pull=(0.0, 0.0, 1.0)),
}


@pytest.mark.parametrize("name", BUILT_IN)
def test_a_grip_that_no_hand_can_use_is_named(name: str, tmp_path: Path) -> None:
    report = validate_bundle(write_quick_bundle(BUILT_IN[name], tmp_path / "bundle"))
    assert {(f.check, f.part) for f in report.findings} == {("semantics.grip", "door_handle")}


def in_urdf(change: Callable[[ET.Element], object]) -> Callable[[Path], None]:
    def edit(folder: Path) -> None:
        tree = ET.parse(folder / URDF)
        change(tree.getroot())
        tree.write(folder / URDF)

    return edit


def in_mjcf(change: Callable[[ET.Element], object]) -> Callable[[Path], None]:
    def edit(folder: Path) -> None:
        tree = ET.parse(folder / MJCF)
        change(tree.getroot())
        tree.write(folder / MJCF)

    return edit


def found(root: ET.Element, path: str) -> ET.Element:
    element = root.find(path)
    assert element is not None
    return element


def heavy(robot: ET.Element) -> None:
    """The grip's link gets a mass of its own."""
    inertial = ET.SubElement(found(robot, "link[@name='door_handle']"), "inertial")
    ET.SubElement(inertial, "mass", value="0.1")
    ET.SubElement(inertial, "inertia", {k: "1e-4" for k in ("ixx", "iyy", "izz")})


def without_site(root: ET.Element) -> None:
    body = found(root, ".//body[@name='door']")
    body.remove(found(body, "site"))


def renamed(manifest: dict[str, list[dict[str, list[dict[str, str]]]]]) -> None:
    manifest["parts"][1]["grips"][0]["kind"] = "tentacle"


def lengthened(manifest: dict[str, list[dict[str, list[dict[str, object]]]]]) -> None:
    manifest["parts"][1]["grips"][0]["pull"] = [0.0, -2.0, 0.0]


JOINT = "joint[@name='door_handle_frame']"
EDITED = {
    "another place in the URDF": (
        "structure.grip", "door_handle",
        in_urdf(lambda r: found(r, f"{JOINT}/origin").set("xyz", "0.1 0 0.28")),
    ),
    "turned in the URDF": (
        "structure.grip", "door_handle",
        in_urdf(lambda r: found(r, f"{JOINT}/origin").set("rpy", "0 0 0.1")),
    ),
    "on another part in the URDF": (
        "structure.grip", "door_handle",
        in_urdf(lambda r: found(r, f"{JOINT}/parent").set("link", "drawer")),
    ),
    "a frame with mass": ("structure.type", "door_handle_frame (asset.urdf)", in_urdf(heavy)),
    "a frame that turns": (
        "inertia.mass", "door_handle (asset.urdf)",
        in_urdf(lambda r: found(r, JOINT).set("type", "revolute")),
    ),
    "missing in the MJCF": ("structure.grip", "door_handle", in_mjcf(without_site)),
    "turned in the MJCF": (
        "structure.grip", "door_handle",
        in_mjcf(lambda r: found(r, ".//site[@name='door_handle']").set("xyaxes", "0 0 1 1 0 0")),
    ),
    "a kind that does not exist": (
        "files.readable", "manifest.json", lambda f: edit_manifest(f, renamed),
    ),
    "a direction of length 2": (
        "structure.manifest", "manifest.json", lambda f: edit_manifest(f, lengthened),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", EDITED)
def test_files_that_state_different_grips_are_named(name: str, folder: Path) -> None:
    check, part, edit = EDITED[name]
    edit(folder)
    sign(folder)
    found = {(f.check, f.part) for f in validate_bundle(folder).findings}
    assert (check, part) in found


def test_a_grip_with_the_name_of_a_part_is_named(tmp_path: Path) -> None:
    obj = held(drawer=dataclasses.replace(EDGE, name="slide"))
    report = validate_bundle(write_quick_bundle(obj, tmp_path / "bundle"))
    assert ("structure.grip", "slide") in {(f.check, f.part) for f in report.findings}
