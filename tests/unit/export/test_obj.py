"""OBJ: what is written reads back bit for bit, by us and by trimesh."""

import io
from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from numpy.testing import assert_allclose, assert_array_equal

from artgen.core.errors import ExportError
from artgen.core.mesh import TriMesh
from artgen.export.obj import distinct, hull_text, obj_text, read_obj
from artgen.geometry.normals import corner_normals
from tests.strategies import chest, mesh_of, meshes, wedge

UNIT = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))


@given(meshes())
@settings(deadline=None, max_examples=50)
def test_obj_reads_back_bit_for_bit(mesh: TriMesh) -> None:
    read = read_obj(obj_text(mesh, mtl="m.mtl"))
    for name in ("vertices", "faces", "atlas", "body"):
        assert_array_equal(getattr(read, name), getattr(mesh, name))


def test_hulls_read_back_bit_for_bit() -> None:
    mesh = wedge(((0.1, 0.2, 0.3), (0.4, 0.6, 0.7)))
    read = read_obj(hull_text(mesh))
    assert_array_equal(read.vertices, mesh.vertices)
    assert_array_equal(read.faces, mesh.faces)


def test_trimesh_reads_the_same_triangles_and_normals() -> None:
    """Normals are rounded to 1e-5, so to half of that a component."""
    mesh = chest().parts[1].mesh
    text = obj_text(mesh, mtl="m.mtl")
    read = trimesh.load(io.StringIO(text), file_type="obj", process=False, force="mesh")
    assert_array_equal(np.asarray(read.triangles), mesh.triangles)
    normals = np.asarray(read.vertex_normals)[read.faces]
    assert_allclose(normals, corner_normals(mesh), rtol=0, atol=1e-5)


def test_mujoco_loads_the_faces_of_every_body(tmp_path: Path) -> None:
    """Bodies were `g` groups once, of which MuJoCo takes the faces of the first alone."""
    mesh = mesh_of([UNIT, ((2.0, 0.0, 0.0), (3.0, 1.0, 1.0))])
    (tmp_path / "m.obj").write_text(obj_text(mesh, mtl="m.mtl"))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><asset><mesh name="m" file="{tmp_path}/m.obj"/></asset><worldbody>'
        '<geom type="mesh" mesh="m"/></worldbody></mujoco>'
    )
    assert model.nmeshface == len(mesh.faces) == 24


def test_distinct_keeps_the_order_of_first_use() -> None:
    values = np.array([[2.0, 1.0], [0.0, 5.0], [2.0, 1.0], [-0.0, 5.0]])
    rows, index = distinct(values)
    assert_array_equal(rows, [[2.0, 1.0], [0.0, 5.0]])
    assert_array_equal(index, [0, 1, 0, 1])


def test_a_mesh_without_atlas_is_refused() -> None:
    bare = wedge(UNIT)
    with pytest.raises(ExportError, match="atlas"):
        obj_text(bare, mtl="m.mtl")


def test_a_foreign_line_is_refused() -> None:
    with pytest.raises(ExportError, match="vp"):
        read_obj("vp 0 0\n")
