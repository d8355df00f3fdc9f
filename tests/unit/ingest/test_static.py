"""Mesh files of objects that do not move: parts by node, in order, capped."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from artgen.core.errors import ArtgenError
from artgen.ingest.build import build
from artgen.ingest.options import Options
from artgen.ingest.reading import read_meshes
from artgen.ingest.static import read_static


def table(path: Path) -> Path:
    """y up, front +z: a top on four legs; the node of each leg is placed by its own transform."""
    scene = trimesh.Scene()
    scene.add_geometry(
        trimesh.creation.box((1.2, 0.05, 0.8)), node_name="top",
        transform=trimesh.transformations.translation_matrix((0, 0.75, 0)),
    )  # fmt: skip
    for number, (x, z) in enumerate([(1, 1), (-1, -1), (-1, 1), (1, -1)]):
        scene.add_geometry(
            trimesh.creation.box((0.05, 0.7, 0.05)), node_name=f"leg {number}",
            transform=trimesh.transformations.translation_matrix((0.5 * x, 0.35, 0.3 * z)),
        )  # fmt: skip
    scene.export(path)
    return path


def test_parts_are_the_largest_then_low_to_high_front_to_back_left_to_right(
    tmp_path: Path,
) -> None:
    found = read_static(table(tmp_path / "a table.glb"), up="y", most=8)
    leaves = [shape.leaf for shape in found.parts[0].shapes]
    assert leaves == ["0_top", "1_leg 2", "2_leg 0", "3_leg 1", "4_leg 3"]
    assert found.doubts == ()


def test_the_smallest_beyond_the_cap_are_joined_to_the_largest_and_counted(
    tmp_path: Path,
) -> None:
    found = read_static(table(tmp_path / "t.glb"), up="y", most=2)
    assert len(found.parts[0].shapes) == 2
    assert found.doubts == (
        "3 of 5 parts, the smallest, are joined to the largest: at most 2 are kept",
    )
    assert sum(len(soup.faces) for soup in read_meshes(found).soups.values()) == 60


def test_the_object_stands_upright_and_its_parts_are_listed(tmp_path: Path) -> None:
    foreign = read_static(table(tmp_path / "t.glb"), up="y", most=8)
    obj = build(foreign, Options(), asset_id="t", category="static").obj
    extent = np.diff(obj.base.mesh.bounds, axis=0)[0]
    # The longest side is 0.6 m; vertices are rounded to 1e-7 m, GLB holds float32.
    np.testing.assert_allclose(extent, 0.5 * np.array([1.2, 0.8, 0.775]), atol=3e-7)
    runs = obj.provenance["fragments"]["base"]
    assert [run["bodies"] for run in runs] == [[k, 1] for k in range(5)]
    assert obj.joints == ()


def test_up_may_be_z(tmp_path: Path) -> None:
    foreign = read_static(table(tmp_path / "t.glb"), up="z", most=8)
    np.testing.assert_array_equal(foreign.object_from_source, np.eye(3))


@pytest.mark.parametrize("content", [b"", b"glTF", b"not a mesh" * 100])
def test_what_is_no_mesh_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "x.glb"
    path.write_bytes(content)
    with pytest.raises(ArtgenError, match=r"x\.glb"):
        read_static(path, up="y", most=8)
