"""Objects of ours, exported as PartNet-Mobility folders and ingested again."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import ArticulatedObject, Part
from artgen.core.errors import IngestError
from artgen.core.transform import apply
from artgen.export.partnet.write import write_partnet
from artgen.ingest.build import Built, build
from artgen.ingest.options import GivenRest, Options
from artgen.ingest.partnet.folder import read_partnet
from artgen.validate.origin import origin_of
from tests.made import finished
from tests.unit.ingest.folders import cabinet, hinge, slide

CATEGORIES = ("cabinet", "bucket")
"""Without joints that follow others, which the format cannot say."""
ROUNDED = 1e-7
"""m; a vertex leaves rounded to 1e-7 m, is divided, printed exactly, multiplied and rounded again:
it comes back to the same place, or to the next one of the grid."""
EXACT = 1e-9
"""m and rad: a hundred products of numbers of size 1."""


@cache
def round_trip(category: str, folder: Path) -> tuple[ArticulatedObject, Built]:
    obj = finished(category, 0)
    folder.mkdir()
    write_partnet(obj, folder, {}, doubled=True)
    return obj, build(read_partnet(folder), Options(), asset_id="back", category=category)


@pytest.fixture(scope="module", params=CATEGORIES)
def both(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[ArticulatedObject, ArticulatedObject]:
    obj, built = round_trip(request.param, tmp_path_factory.mktemp("trip") / request.param)
    return obj, built.obj


def twins(obj: ArticulatedObject, back: ArticulatedObject) -> dict[str, str]:
    """Part of the original to the part that came back, by the number of its link."""
    read = back.provenance["joints_read"]
    links = {f"link_{k}": part.name for k, part in enumerate((*obj.parts[1:], obj.parts[0]))}
    found = {links[entry["link"]]: name.removesuffix("_joint") for name, entry in read.items()}
    return {obj.base.name: back.base.name, **found}


def test_labels_and_tree_come_back(
    both: tuple[ArticulatedObject, ArticulatedObject],
) -> None:
    obj, back = both
    names = twins(obj, back)
    assert len(names) == len(obj.parts)
    labels = {part.name: part.label for part in back.parts}
    assert {p.name: p.label for p in obj.parts} == {p: labels[own] for p, own in names.items()}
    parents = {joint.child: joint.parent for joint in back.joints}
    for joint in obj.joints:
        assert parents[names[joint.child]] == names[joint.parent]


def test_every_vertex_comes_back(both: tuple[ArticulatedObject, ArticulatedObject]) -> None:
    obj, back = both
    own = {part.name: part for part in back.parts}
    for name, twin in twins(obj, back).items():
        first, second = (set_of(p) for p in (part_of(obj, name), own[twin]))
        assert cKDTree(second).query(first)[0].max() <= np.sqrt(3.0) * ROUNDED
        assert cKDTree(first).query(second)[0].max() <= np.sqrt(3.0) * ROUNDED


def test_closed_bodies_come_back_closed(
    both: tuple[ArticulatedObject, ArticulatedObject],
) -> None:
    """Volumes to the rounding of vertices: a face of area A moves by 1e-7 m at most."""
    obj, back = both
    assert origin_of(back.provenance).shells == {}
    own = {part.name: part for part in back.parts}
    for name, twin in twins(obj, back).items():
        part = part_of(obj, name)
        volume, again = (_volume(p) for p in (part, own[twin]))
        area = np.linalg.norm(np.cross(*np.diff(part.mesh.triangles, axis=1).transpose(1, 0, 2)))
        assert abs(volume - again) <= max(area, 1.0) * 2e-6
        assert len(part.mesh.faces) - len(own[twin].mesh.faces) <= 0.01 * len(part.mesh.faces)


@pytest.mark.parametrize("seed", range(3))
def test_kinematics_come_back(seed: int, both: tuple[ArticulatedObject, ArticulatedObject]) -> None:
    """The same points at the same state, with q counted from the rest that was found."""
    obj, back = both
    names = twins(obj, back)
    rng = np.random.default_rng(seed)
    read = back.provenance["joints_read"]
    state, again = {}, {}
    for joint in obj.joints:
        lower, upper = (-3.0, 3.0) if joint.limit is None else (joint.limit.lower,
                                                                joint.limit.upper)  # fmt: skip
        state[joint.name] = q = float(rng.uniform(lower, upper))
        twin = next(j for j in back.joints if j.child == names[joint.child])
        assert read[twin.name]["rest"] == [0.0], read[twin.name]
        again[twin.name] = q * float(np.sign(np.dot(twin.axis, joint.axis)))
    poses = forward_kinematics(obj.base.name, obj.joints, state)
    moved = forward_kinematics(back.base.name, back.joints, again)
    points = rng.uniform(-1.0, 1.0, (4, 3))
    for name, twin in names.items():
        assert np.abs(apply(poses[name], points) - apply(moved[twin], points)).max() <= EXACT


def part_of(obj: ArticulatedObject, name: str) -> Part:
    return next(part for part in obj.parts if part.name == name)


def set_of(part: Part) -> np.ndarray:
    return np.unique(part.mesh.vertices, axis=0)


def _volume(part: Part) -> float:
    a, b, c = part.mesh.triangles.transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def built_cabinet(tmp_path: Path, options: Options | None = None, **motions: object) -> Built:
    root = cabinet(**motions).write(tmp_path / "45940")
    return build(read_partnet(root), options or Options(), asset_id="a", category="c")


def test_what_starts_open_is_closed_at_zero_and_opens_at_positive_q(tmp_path: Path) -> None:
    """The start pose of this drawer is 0.4 units out, and its door is drawn 90 degrees open."""
    door = hinge(90.0, 0.0, origin=(-0.5, 0.0, 0.3), direction=(0.0, -1.0, 0.0))
    built = built_cabinet(tmp_path, drawer=slide(0.4, 0.0), door=door)
    joints = {joint.name: joint for joint in built.obj.joints}
    read = built.obj.provenance["joints_read"]
    assert read["drawer_joint"]["rest"] == [0.0]
    assert read["drawer_joint"]["confidence"] == "high"
    assert joints["drawer_joint"].axis == (0.0, -1.0, 0.0)
    assert joints["door_joint"].limit.lower == 0.0
    opened = forward_kinematics("base", built.obj.joints, {"door_joint": 1.0})["door"]
    middle = part_of(built.obj, "door").mesh.bounds.mean(axis=0)
    assert apply(opened, middle[None])[0, 1] < middle[1]


def test_the_users_table_of_rests_is_obeyed(tmp_path: Path) -> None:
    """Node 1 of object 45940 is said to be closed at -90 degrees: wrong, and so be it."""
    options = Options(rests=(GivenRest(id="45940", number="1", q=-90.0),))
    built = built_cabinet(tmp_path, options)
    read = built.obj.provenance["joints_read"]["door_joint"]
    assert (read["confidence"], read["rest"], read["number"]) == ("given", [-90.0], "1")
    assert built.obj.provenance["doubts"] == []


def test_a_rest_beyond_the_range_is_told(tmp_path: Path) -> None:
    options = Options(rests=(GivenRest(id="45940", number="1", q=-120.0),))
    said = built_cabinet(tmp_path, options).obj.provenance
    assert said["joints_read"]["door_joint"]["rest"] == [-90.0]
    assert said["doubts"] == ["joint joint_1: the closed pose given, -120.0, lies beyond its range"]


def test_provenance_says_where_it_comes_from_and_who_may_have_it(tmp_path: Path) -> None:
    said = built_cabinet(tmp_path).obj.provenance
    assert said["source"]["dataset"] == "partnet-mobility"
    assert said["source"]["id"] == "45940"
    assert said["source"]["family"] == "partnet-mobility:45940"
    assert said["licence"]["id"] == "LicenseRef-PartNet-Mobility"
    assert said["licence"]["distributable"] is False
    assert said["scale"]["reason"] == "assumed: longest 1.1 m"
    assert [run["leaf"] for run in said["fragments"]["door"]] == ["cabinet_door_surface", "handle"]


def test_the_assumed_size_holds(tmp_path: Path) -> None:
    obj = built_cabinet(tmp_path).obj
    boxes = np.array([part.mesh.bounds for part in obj.parts])
    extent = boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)
    # Both ends are rounded to 1e-7 m.
    assert extent.max() == pytest.approx(1.1, abs=2e-7)


def test_115_keys_are_capped_and_counted(tmp_path: Path) -> None:
    """A keyboard of 115 sliding keys keeps as many parts as are asked for; the others are fixed."""
    folder = cabinet()
    base = folder.nodes[2]
    folder.nodes = [base.__class__(id=200, parent=-1, kind="free", name="b", leaves=base.leaves)]
    for k in range(115):
        x, z = -1.0 + 0.1 * (k % 20), -0.2 + 0.1 * (k // 20)
        stem = f"new-{k}"
        folder.boxes[stem] = ((x, 0.8, z), (x + 0.08 + 1e-4 * k, 0.9, z + 0.08))
        folder.objs[1000 + k] = [stem]
        folder.nodes.append(base.__class__(
            id=k, parent=200, kind="slider", name="key", motion=slide(0.0, -0.05,
            direction=(0.0, 1.0, 0.0)), leaves=(folder.nodes[0].leaves[0].__class__(
                id=1000 + k, name="key"),)))  # fmt: skip
        folder.words[f"link_{k}"] = ("slider", "key")
    built = build(
        read_partnet(folder.write(tmp_path / "7619")), Options(max_parts=8), asset_id="a",
        category="keyboard",
    )  # fmt: skip
    assert len(built.obj.parts) == 8
    assert {part.label for part in built.obj.parts} == {"base", "button"}
    said = built.obj.provenance["doubts"]
    assert any("108 of 116 parts, the smallest, are fixed" in line for line in said)


def test_a_slider_that_turns_is_kept_and_is_no_sample_for_art(tmp_path: Path) -> None:
    drawer = slide(0.0, 0.2, rotates=True)
    said = built_cabinet(tmp_path, drawer=drawer).obj.provenance
    assert any("slides and turns at once" in line for line in said["art"])


def test_open_surfaces_are_listed_and_weigh_as_sheets(tmp_path: Path) -> None:
    folder = cabinet()
    folder.texts["original-5"] = (
        "v -0.5 -0.7 -0.4\nv 0.5 -0.7 -0.4\nv 0.5 0.7 -0.4\nv -0.5 0.7 -0.4\nf 1 2 3\nf 1 3 4\n"
    )
    foreign = read_partnet(folder.write(tmp_path / "1"))
    obj = build(foreign, Options(meters_per_unit=1.0), asset_id="a", category="c").obj
    assert origin_of(obj.provenance).shells == {"base": frozenset({4})}
    assert obj.base.densities is None
    sides = 2 * 0.1 * 1.6 * 0.7 + 2 * 1.0 * 0.1 * 0.7
    assert obj.base.mass.mass == pytest.approx(500.0 * (sides + 1.4 * 0.004), rel=1e-6)


def test_an_object_whose_meshes_are_all_absent_is_refused(tmp_path: Path) -> None:
    root = cabinet().write(tmp_path / "1")
    for path in (root / "textured_objs").iterdir():
        path.unlink()
    with pytest.raises(IngestError, match=r"link_2 .furniture_body., link_0 .*no mesh"):
        build(read_partnet(root), Options(), asset_id="a", category="c")
