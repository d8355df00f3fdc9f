"""An object of ours as a PartNet-Mobility folder: every file that the layout has, and its frame."""

import io
import json
import re
from pathlib import Path

import numpy as np
import pytest
import trimesh
import yourdfpy
from PIL import Image

from artgen.articulation.types import ArticulatedObject
from artgen.export.partnet.write import normalization, write_partnet
from tests.made import finished


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[ArticulatedObject, Path]:
    obj = finished("cabinet", 0)
    folder = tmp_path_factory.mktemp("export")
    stream = io.BytesIO()
    Image.new("RGB", (4, 4)).save(stream, "PNG")
    write_partnet(obj, folder, {obj.surfaces[0].name: stream.getvalue()}, doubled=True)
    return obj, folder


def read(folder: Path, name: str) -> object:
    return json.loads((folder / name).read_text())


def test_every_file_is_there(written: tuple[ArticulatedObject, Path]) -> None:
    _, folder = written
    assert sorted(path.name for path in folder.iterdir()) == [
        "artgen.json", "bounding_box.json", "images", "meta.json", "mobility.urdf",
        "mobility_v2.json", "result.json", "semantics.txt", "textured_objs",
    ]  # fmt: skip
    assert read(folder, "meta.json")["model_cat"] == "Cabinet"


def test_the_largest_radius_is_1_and_the_box_is_that_of_all_meshes(
    written: tuple[ArticulatedObject, Path],
) -> None:
    """Files hold exact numbers; the radius rounds by an ulp or two."""
    _, folder = written
    points = np.concatenate([vertices(path) for path in (folder / "textured_objs").glob("*.obj")])
    assert np.linalg.norm(points, axis=1).max() == pytest.approx(1.0, abs=1e-15)
    box = read(folder, "bounding_box.json")
    corners = [points.min(axis=0), points.max(axis=0)]
    np.testing.assert_array_equal(corners, [box["min"], box["max"]])


def vertices(path: Path) -> np.ndarray:
    lines = path.read_text().splitlines()
    return np.array([line.split()[1:] for line in lines if line.startswith("v ")], float)


def test_front_is_plus_z_and_up_is_y(written: tuple[ArticulatedObject, Path]) -> None:
    """Drawers of ours open along -y; there along +z."""
    obj, folder = written
    nodes = read(folder, "mobility_v2.json")
    sliders = [node for node in nodes if node["joint"] == "slider"]
    assert sliders
    for node in sliders:
        np.testing.assert_allclose(node["jointData"]["axis"]["direction"], [0, 0, 1], atol=1e-15)
    unit, _ = normalization(obj)
    travel = next(joint.limit.upper for joint in obj.joints if joint.type == "prismatic")
    assert sliders[0]["jointData"]["limit"]["b"] * unit == pytest.approx(travel, rel=1e-15)


def test_ids_of_nodes_are_those_of_leaves_and_every_mesh_has_one(
    written: tuple[ArticulatedObject, Path],
) -> None:
    _, folder = written
    found: dict[int, list[str]] = {}
    waiting = list(read(folder, "result.json"))
    while waiting:
        node = waiting.pop()
        waiting += node.get("children", [])
        if "objs" in node:
            found[node["id"]] = node["objs"]
    named = [p["id"] for node in read(folder, "mobility_v2.json") for p in node["parts"]]
    assert sorted(named) == sorted(found)
    stems = sorted(stem for own in found.values() for stem in own)
    assert stems == sorted(path.stem for path in (folder / "textured_objs").glob("*.obj"))


def test_handles_are_leaves_of_their_own(written: tuple[ArticulatedObject, Path]) -> None:
    obj, folder = written
    gripped = [p for p in obj.parts if any(g.kind in ("handle", "knob") for g in p.grips)]
    nodes = read(folder, "mobility_v2.json")
    assert gripped
    assert sum(any(p["name"] == "handle" for p in node["parts"]) for node in nodes) == len(gripped)


def test_materials_name_images_that_are_there(written: tuple[ArticulatedObject, Path]) -> None:
    _, folder = written
    maps = {
        name
        for path in (folder / "textured_objs").glob("*.mtl")
        for name in re.findall(r"map_Kd (.*)", path.read_text())
    }
    assert maps == {"../images/texture_0.png"}
    assert all((folder / "textured_objs" / name).exists() for name in maps)


def test_others_read_the_folder(written: tuple[ArticulatedObject, Path]) -> None:
    """yourdfpy loads the URDF with all its meshes; trimesh finds doubled faces as in the data."""
    obj, folder = written
    robot = yourdfpy.URDF.load(str(folder / "mobility.urdf"))
    assert len(robot.actuated_joint_names) == len(obj.joints)
    lower, upper = robot.scene.bounds
    box = read(folder, "bounding_box.json")
    low, high = np.array(box["min"]), np.array(box["max"])
    # World (-z, -x, y); trimesh keeps float32 of numbers up to 1.
    np.testing.assert_allclose(lower, [-high[2], -high[0], low[1]], atol=1e-6)
    np.testing.assert_allclose(upper, [-low[2], -low[0], high[1]], atol=1e-6)
    mesh = trimesh.load(folder / "textured_objs/original-1.obj", process=False, force="mesh")
    assert len(mesh.faces) % 2 == 0


def test_what_the_format_cannot_say_is_named(written: tuple[ArticulatedObject, Path]) -> None:
    obj, folder = written
    lost = read(folder, "artgen.json")["left_out"]
    assert sorted(lost.get("grips", [])) == sorted(g.name for p in obj.parts for g in p.grips)


def test_the_same_object_gives_the_same_bytes(
    written: tuple[ArticulatedObject, Path], tmp_path: Path
) -> None:
    obj, folder = written
    image = (folder / "images/texture_0.png").read_bytes()
    write_partnet(obj, tmp_path, {obj.surfaces[0].name: image}, doubled=True)
    for path in folder.rglob("*.*"):
        assert (tmp_path / path.relative_to(folder)).read_bytes() == path.read_bytes()
