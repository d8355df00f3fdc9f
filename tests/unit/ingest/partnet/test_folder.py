"""Folders with every trap that the data set and its edited copies hold."""

import dataclasses
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import IngestError
from artgen.export.partnet.nodes import Leaf, Motion, Node
from artgen.export.partnet.rule import urdf_text
from artgen.ingest.partnet.folder import read_partnet
from artgen.ingest.reading import read_meshes
from tests.unit.ingest.folders import Folder, cabinet, hinge, leaf, slide

EDGE = {"origin": (-0.5, 0.0, 0.3), "direction": (0.0, 1.0, 0.0)}


def test_a_plain_folder_reads_without_a_doubt(tmp_path: Path) -> None:
    """The root is last, its name says `shelf`; the label comes from semantics.txt."""
    found = read_partnet(cabinet().write(tmp_path / "45940"))
    assert found.doubts == ()
    assert (found.id, found.category) == ("45940", "StorageFurniture")
    assert [(p.name, p.word, len(p.shapes)) for p in found.parts] == [
        ("link_2", "furniture_body", 5), ("link_0", "drawer", 1), ("link_1", "rotation_door", 2)
    ]  # fmt: skip
    assert [shape.leaf for shape in found.parts[2].shapes] == ["cabinet_door_surface", "handle"]


def test_a_folder_of_six_digits_is_called_by_its_name_not_by_its_annotation(tmp_path: Path) -> None:
    """100809 has anno_id 809, which is another object of the data set: its entry in a table of
    rests was not heeded, and nothing told the two apart."""
    root = cabinet().write(tmp_path / "100809")
    meta = json.loads((root / "meta.json").read_text())
    (root / "meta.json").write_text(json.dumps({**meta, "anno_id": "809"}))
    found = read_partnet(root)
    assert (found.id, found.anno_id, found.family) == ("100809", "809", "partnet-mobility:100809")


def test_the_folder_that_one_stands_in_has_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(cabinet().write(tmp_path / "45940"))
    assert read_partnet(Path()).id == "45940"


def test_a_above_b_keeps_the_direction_and_starts_at_a(tmp_path: Path) -> None:
    door = read_partnet(cabinet().write(tmp_path / "1")).joints[1]
    assert door.axis == (0.0, 1.0, 0.0)
    assert (door.start, door.lower, door.upper) == (0.0, math.radians(-90.0), 0.0)


def test_free_hinges_have_no_stops_whatever_a_and_b_say(tmp_path: Path) -> None:
    free = Motion(origin=(0.0, 0.0, 0.0), direction=(1.0, 0.0, 0.0), a=3.0, b=-3.0, free=True)
    door = read_partnet(cabinet(door=free).write(tmp_path / "1")).joints[1]
    assert (door.type, door.lower, door.upper, door.start) == ("continuous", None, None, None)


def test_turning_sliders_are_one_part_and_say_so(tmp_path: Path) -> None:
    """Helper and link are folded: no part is called helper, and the URDF still agrees."""
    folder = cabinet(drawer=slide(-0.108, -0.008, rotates=True, turn=180.0))
    folder.words["link_0"] = ("slider+", "lid")
    found = read_partnet(folder.write(tmp_path / "3763"))
    assert found.doubts == ()
    assert [part.name for part in found.parts] == ["link_2", "link_0", "link_1"]
    lid = found.joints[0]
    assert (lid.type, lid.turns, lid.lower, lid.upper) == ("prismatic", True, -0.108, -0.008)


def test_junk_nodes_shift_the_links_of_urdf_and_semantics(tmp_path: Path) -> None:
    """Node 1 is junk: the URDF calls node 2 `link_1`, and so does semantics.txt."""
    folder = cabinet()
    junk = Node(id=1, parent=-1, kind="junk", name="junk", leaves=leaf(9, "junk"))
    drawer, door, root = folder.nodes
    whole = [drawer, junk, dataclasses.replace(door, id=2, parent=3),
             dataclasses.replace(root, id=3)]  # fmt: skip
    folder.urdf = urdf_text(folder.nodes, folder.objs, name="partnet_m")
    folder.nodes = [dataclasses.replace(whole[0], parent=3), *whole[1:]]
    folder.objs[9] = ["original-9"]
    folder.boxes["original-9"] = ((-3.0, -3.0, -3.0), (3.0, 3.0, 3.0))
    found = read_partnet(folder.write(tmp_path / "1"))
    assert [(p.name, p.word) for p in found.parts] == [
        ("link_2", "furniture_body"), ("link_0", "drawer"), ("link_1", "rotation_door")
    ]  # fmt: skip
    assert found.doubts == (
        "1 junk nodes are left out",
        "links are numbered without the junk nodes",
        "1 meshes belong to no link and are left out",
    )


def test_several_roots_are_fixed_to_the_one_that_carries_most(tmp_path: Path) -> None:
    folder = cabinet()
    folder.nodes.append(Node(id=3, parent=-1, kind="free", name="vase", leaves=leaf(9, "vase")))
    folder.objs[9], folder.boxes["original-9"] = ["original-9"], ((0, 0.8, 0), (0.1, 1.0, 0.1))
    found = read_partnet(folder.write(tmp_path / "1"))
    assert found.parts[0].name == "link_2"
    assert len(found.parts[0].shapes) == 6
    assert "2 roots; all are fixed to link_2" in found.doubts


def test_stale_motion_of_a_root_and_of_static_nodes_is_ignored(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "7619")
    path = root / "mobility_v2.json"
    stated = json.loads(path.read_text())
    stated[2]["jointData"] = {"axis": {"origin": [None] * 3, "direction": [0, 0, 0]},
                              "limit": {"a": 0, "b": -0.005}}  # fmt: skip
    path.write_text(json.dumps(stated))
    assert read_partnet(root).doubts == ()


def test_a_static_node_below_a_door_moves_with_the_door(tmp_path: Path) -> None:
    folder = cabinet()
    folder.nodes.insert(2, Node(id=3, parent=1, kind="static", name="glass", leaves=leaf(9)))
    folder.objs[9], folder.boxes["original-9"] = ["original-9"], ((-0.4, -0.6, 0.35), (0, 0, 0.36))
    found = read_partnet(folder.write(tmp_path / "1"))
    assert len(found.parts) == 3
    assert len(found.parts[2].shapes) == 3


def test_names_repeat_and_are_told_apart_by_number(tmp_path: Path) -> None:
    """Leaves and materials of all files are called alike, as in the data set."""
    folder = cabinet()
    folder.nodes = [
        dataclasses.replace(node, name="leaf", leaves=tuple(Leaf(id=own.id, name="leaf")
                            for own in node.leaves)) for node in folder.nodes
    ]  # fmt: skip
    root = folder.write(tmp_path / "1")
    mtl = root / "textured_objs/original-7.mtl"
    mtl.write_text("newmtl material_0_0\nd 0.2\nKd 1 0 0\n")
    meshes = read_meshes(read_partnet(root))
    looks = {shape.label: soup.looks[soup.look[0]] for shape, soup in meshes.soups.items()}
    assert looks["original-7.obj"].opacity == 0.2
    assert looks["original-6.obj"].color == (0.5, 0.4, 0.3)


def test_missing_meshes_are_dropped_and_counted(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    (root / "textured_objs/original-8.obj").unlink()
    meshes = read_meshes(read_partnet(root))
    assert len(meshes.dropped) == 1
    assert "link_1, original-8.obj" in meshes.dropped[0]


def test_a_link_that_loses_all_its_meshes_is_an_error(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    (root / "textured_objs/original-6.obj").write_text("# no face at all\nv 0 0 0\n")
    with pytest.raises(IngestError, match=r"link_0 \(drawer\): no mesh.*it has no face"):
        read_meshes(read_partnet(root))


def test_meshes_that_no_link_names_are_ignored_and_told(tmp_path: Path) -> None:
    folder = cabinet()
    folder.boxes["new-0"] = ((0, 0, 0), (1, 1, 1))
    found = read_partnet(folder.write(tmp_path / "1"))
    assert found.doubts == ("1 meshes belong to no link and are left out",)


@pytest.mark.parametrize(
    ("edit", "told"),
    [
        ((r'(joint_1" type=")revolute', r"\1fixed"), "URDF joint of link_1 is fixed"),
        ((r'(joint_0".*?<origin xyz="[^ ]+ )([^ ]+)', r"\g<1>0.05"), "URDF puts link_0 elsewhere"),
        ((r'upper="0.4"', 'upper="1.4"'), "URDF upper limit of link_0 is 1.4, JSON says 0.4"),
        ((r'(<axis xyz=")0.0 -1.0', r"\g<1>0.0 1.0"), "URDF turns the axis of link_1"),
        ((r'filename="textured_objs/original-8.obj"', 'filename="x.obj"'), "2 meshes of link_1"),
        ((r"^.*$", "<!DOCTYPE r [<!ENTITY a 'b'>]><r/>"), "declares a document type"),
    ],
)
def test_json_counts_where_an_edited_urdf_disagrees(
    edit: tuple[str, str], told: str, tmp_path: Path
) -> None:
    """Copies in the wild have joints made fixed, origins divided, limits widened, meshes cut."""
    plain = read_partnet(cabinet().write(tmp_path / "1"))
    folder = cabinet()
    text = urdf_text(folder.nodes, folder.objs, name="partnet_m")
    folder.urdf = re.sub(*edit, text, count=1, flags=re.S)
    assert folder.urdf != text
    found = read_partnet(folder.write(tmp_path / "2"))
    assert any(told in line for line in found.doubts), found.doubts
    assert found.joints == plain.joints


def test_commas_between_numbers_of_the_urdf_are_read(tmp_path: Path) -> None:
    folder = cabinet()
    text = urdf_text(folder.nodes, folder.objs, name="partnet_m")
    folder.urdf = re.sub(r'xyz="([^ ]+) ([^ ]+) ([^ ]+)"', r'xyz="\1, \2, \3"', text)
    assert read_partnet(folder.write(tmp_path / "1")).doubts == ()


def test_category_is_that_of_meta_json(tmp_path: Path) -> None:
    folder = cabinet()
    folder.category = "Box"
    found = read_partnet(folder.write(tmp_path / "48492"))
    assert found.category == "Box"
    assert found.doubts == ("meta.json says Box, result.json storage_furniture; meta.json counts",)


def test_a_folder_without_urdf_and_semantics_is_read(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    (root / "mobility.urdf").unlink()
    (root / "semantics.txt").unlink()
    found = read_partnet(root)
    assert [part.word for part in found.parts] == ["shelf", "drawer", "cabinet_door"]


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("mobility_v2.json", "{", "cannot be read"),
        ("mobility_v2.json", "[]", "no list of motion nodes"),
        ("mobility_v2.json", "[" * 100000, "cannot be read"),
        ("mobility_v2.json", '[{"id": 0, "parent": -1, "joint": "screw"}]', "none of hinge"),
        ("mobility_v2.json", '[{"id": 0, "parent": 7, "joint": "static"}]', "not there"),
        ("meta.json", "[1]", "holds no object"),
        ("result.json", "{}", "holds no tree"),
    ],
)
def test_damaged_files_are_named(name: str, text: str, told: str, tmp_path: Path) -> None:
    folder = cabinet()
    folder.extra[name] = text
    with pytest.raises(IngestError, match=told):
        read_partnet(folder.write(tmp_path / "1"))


@pytest.mark.parametrize("value", ["NaN", "Infinity", "1e999", "null", '"3"', "true", "[1]"])
def test_a_limit_that_is_no_finite_number_is_refused(value: str, tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    path = root / "mobility_v2.json"
    path.write_text(path.read_text().replace('"b": 0.4', f'"b": {value}'))
    with pytest.raises(IngestError):
        read_partnet(root)


def test_nodes_in_a_circle_are_refused(tmp_path: Path) -> None:
    folder = cabinet()
    folder.nodes[0] = dataclasses.replace(folder.nodes[0], parent=1)
    folder.nodes[1] = dataclasses.replace(folder.nodes[1], parent=0)
    with pytest.raises(IngestError, match="circle"):
        read_partnet(folder.write(tmp_path / "1"))


def test_a_missing_annotation_is_named(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    (root / "mobility_v2.json").unlink()
    with pytest.raises(IngestError, match=r"mobility_v2.json missing; a PartNet-Mobility folder"):
        read_partnet(root)


def test_one_odd_mesh_costs_itself_alone(tmp_path: Path) -> None:
    """A face index beyond 64 bits cost the whole object."""
    folder = cabinet()
    folder.texts["original-8"] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n"
    meshes = read_meshes(read_partnet(folder.write(tmp_path / "1")))
    (line,) = meshes.dropped
    assert "original-8.obj: a line is malformed" in line
    assert len(meshes.soups) == 7


def test_links_that_leave_the_folder_are_not_followed(tmp_path: Path) -> None:
    secret = tmp_path / "secret.obj"
    secret.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    root = cabinet().write(tmp_path / "1")
    (root / "textured_objs/original-8.obj").unlink()
    (root / "textured_objs/original-8.obj").symlink_to(secret)
    meshes = read_meshes(read_partnet(root))
    assert "leads out of the asset's folder" in meshes.dropped[0]
    (root / "meta.json").unlink()
    (root / "meta.json").symlink_to(tmp_path / "secret.obj")
    with pytest.raises(IngestError, match="leads out"):
        read_partnet(root)


def test_spaces_and_other_letters_in_the_path_do_no_harm(tmp_path: Path) -> None:
    found = read_partnet(cabinet().write(tmp_path / "mit Leerzeichen" / "шкаф 1"))
    assert len(read_meshes(found).soups) == 8


def test_nan_in_a_mesh_drops_it(tmp_path: Path) -> None:
    folder = cabinet()
    folder.texts["original-8"] = "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    meshes = read_meshes(read_partnet(folder.write(tmp_path / "1")))
    assert "a vertex is not finite" in meshes.dropped[0]


def test_reading_writes_nothing(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    before = {path: path.stat().st_mtime_ns for path in root.rglob("*")}
    read_meshes(read_partnet(root))
    assert {path: path.stat().st_mtime_ns for path in root.rglob("*")} == before
    assert [path.name for path in tmp_path.iterdir()] == ["1"]


def test_hinges_are_in_degrees_and_slides_in_units(tmp_path: Path) -> None:
    folder: Folder = cabinet(drawer=slide(0.0, 0.64), door=hinge(0.0, 94.0, **EDGE))
    drawer, door = read_partnet(folder.write(tmp_path / "1")).joints
    assert (drawer.upper, door.upper) == (0.64, math.radians(94.0))
    assert np.linalg.norm(door.axis) == 1.0
