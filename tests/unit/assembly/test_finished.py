"""A bundle read back is the object that was written, looks included."""

import numpy as np
import pytest

from artgen.assembly.finished import finished_object
from artgen.assembly.harvest import bundle_id, bundle_source
from artgen.core.errors import ExportError
from artgen.export.layout import GLB
from tests.made import finished

FLOAT32 = 2e-6
"""m; UV pass through float32 tiles: 6e-8 of some 10 tiles of 1 m, then the grid of 1e-6 m."""


@pytest.mark.blender
def test_vertices_bodies_uv_and_surfaces_come_back(bundle):
    was, now = finished("cabinet", 0), finished_object(bundle)
    assert now.joints == was.joints
    assert now.surfaces == was.surfaces
    for one, other in zip(was.parts, now.parts, strict=True):
        assert np.array_equal(one.mesh.vertices, other.mesh.vertices)
        assert np.array_equal(one.mesh.faces, other.mesh.faces)
        assert np.array_equal(one.mesh.body, other.mesh.body)
        assert np.array_equal(one.mesh.slot, other.mesh.slot)
        assert np.abs(one.mesh.uv - other.mesh.uv).max() < FLOAT32
        assert one.grips == other.grips
        assert one.densities == other.densities


@pytest.mark.blender
def test_a_bundle_is_a_source(bundle):
    source = bundle_source(bundle)
    assert source.id == bundle_id(bundle)
    assert source.id.startswith("artgen_" + finished("cabinet", 0).asset_id)
    assert all(member.kind == "front" for member in source.members)


@pytest.mark.blender
def test_a_glb_of_another_object_is_refused(bundle, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    for path in bundle.rglob("*"):
        if path.is_file():
            (other / path.relative_to(bundle)).parent.mkdir(exist_ok=True, parents=True)
            (other / path.relative_to(bundle)).write_bytes(path.read_bytes())
    glb = (other / GLB).read_bytes()
    (other / GLB).write_bytes(glb[:-8])
    with pytest.raises(ExportError, match="cannot be read"):
        finished_object(other)
    mesh = next((other / "meshes").glob("*base.obj"))
    mesh.write_text(mesh.read_text().replace("\nv 0.", "\nv 0.1", 1))
    (other / GLB).write_bytes(glb)
    with pytest.raises(ExportError, match="lie up to|other triangles"):
        finished_object(other)
