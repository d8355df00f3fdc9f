"""Mass properties against closed forms; welding and closedness."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from artgen.core.mesh import TriMesh
from artgen.geometry.measure import combined, moments, open_edges, welded
from artgen.geometry.normals import corner_normals
from artgen.geometry.solid import box, chamfered_box, cylinder


def box_inertia(mass: float, size: tuple) -> np.ndarray:
    a, b, c = (s * s for s in size)
    return np.diag([b + c, a + c, a + b]) * mass / 12.0


@given(st.tuples(*[st.floats(0.01, 2.0)] * 3), st.floats(10.0, 9000.0), st.floats(0.0, 1e4))
def test_a_box_has_the_textbook_inertia_even_far_from_the_origin(size, density, far) -> None:
    """Vertices at 1e4 m are on a grid of 1.8e-12 m, 2e-10 of a 1 cm side; squares double that."""
    solid = box(size, at=(far, -far, far))
    mass, center, tensor = combined([(density, moments(solid.trimesh().triangles))])
    assert_allclose(mass, density * math.prod(size), rtol=2e-9)
    assert_allclose(center, (far, -far, far + size[2] / 2), rtol=1e-12, atol=1e-10)
    expected = box_inertia(mass, size)
    assert_allclose(tensor, expected, rtol=2e-9, atol=2e-9 * expected.max())


def test_the_plain_sum_about_the_origin_would_fail_far_away() -> None:
    """Why the origin is shifted: at 1e4 m the unshifted integral loses most digits of the
    inertia."""
    triangles = box((0.1, 0.1, 0.1), at=(1e4, 0, 0)).trimesh().triangles
    a, b, c = triangles.transpose(1, 0, 2)
    det = np.einsum("ij,ij->i", a, np.cross(b, c))
    total = a + b + c
    volume = det.sum() / 6
    first = (det[:, None] * total).sum(0) / 24
    second = sum(np.einsum("i,ij,ik->jk", det, x, x) for x in (a, b, c, total)) / 120
    naive = second - np.outer(first, first) / volume
    exact = moments(triangles).second
    assert abs(naive[0, 0] / exact[0, 0] - 1.0) > 1e-2


def test_two_materials_are_weighed_each_at_its_density() -> None:
    halves = [box((1, 1, 0.5)), box((1, 1, 0.5), at=(0, 0, 0.5))]
    pieces = [(d, moments(h.trimesh().triangles)) for d, h in zip((3.0, 1.0), halves, strict=True)]
    mass, center, tensor = combined(pieces)
    assert_allclose(mass, 2.0)
    assert_allclose(center, (0, 0, (1.5 * 0.25 + 0.5 * 0.75) / 2.0))
    arms = (0.25 - center[2], 0.75 - center[2])
    i_x = sum(m * (1 + 0.25) / 12 + m * arm**2 for m, arm in zip((1.5, 0.5), arms, strict=True))
    assert_allclose(np.diag(tensor)[0], i_x)


def test_open_edges_counts_a_missing_and_a_flipped_face() -> None:
    faces = box((1, 1, 1)).trimesh().faces
    assert open_edges(faces) == 0
    assert open_edges(faces[1:]) == 3
    flipped = faces.copy()
    flipped[0] = flipped[0, ::-1]
    assert open_edges(flipped) == 6
    assert open_edges(np.concatenate([faces, faces + 8])) == 0


def test_welding_closes_what_rounding_pinches() -> None:
    """A sliver narrower than the grid collapses; what is left must still be closed."""
    solid = box((0.1, 0.1, 0.1)) - box((4e-8, 0.2, 0.05), at=(0, 0, 0.07))
    mesh = solid.trimesh()
    vertices, faces = welded(np.round(mesh.vertices, 7), mesh.faces)
    assert open_edges(faces) == 0
    a, b, c = faces.T
    assert not ((a == b) | (b == c) | (c == a)).any()
    assert len(vertices) < len(mesh.vertices)


def test_bare_box_edges_stay_sharp_and_cylinders_are_smooth() -> None:
    flat = corner_normals(box((1, 1, 1)).trimesh())
    assert_allclose(np.abs(flat).max(axis=2), 1.0)
    round_ = corner_normals(cylinder(0.5, 1.0, segments=32).trimesh())
    mesh = cylinder(0.5, 1.0, segments=32).trimesh()
    radial = mesh.vertices * (1, 1, 0) / np.linalg.norm(mesh.vertices[:, :2], axis=1)[:, None]
    side = np.abs(round_[..., 2]) < 0.5
    error = np.linalg.norm(round_[side] - radial[mesh.faces][side], axis=1)
    # On a uniform prism the two neighbours of an edge weigh alike or 2:1, and one face turns
    # 11.25 degrees: the normal is off by at most a third of half of that, 0.033 rad.
    assert error.max() < 0.04


def test_a_chamfer_carries_the_bend_and_the_flat_stays_flat() -> None:
    mesh = chamfered_box((1, 1, 1), 0.01).trimesh()
    normals = corner_normals(mesh)
    corners = mesh.triangles
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    large = normals[areas > 0.1]
    assert np.abs(large).max(axis=2).min() > 0.999


def test_a_mesh_that_is_wrong_is_refused() -> None:
    with pytest.raises(Exception, match="not finite"):
        TriMesh(vertices=[[0, 0, np.nan], [1, 0, 0], [0, 1, 0]], faces=[[0, 1, 2]])
    with pytest.raises(Exception, match="vertex 3 of 3"):
        TriMesh(vertices=np.eye(3), faces=[[0, 1, 3]])
    with pytest.raises(Exception, match="one vertex twice"):
        TriMesh(vertices=np.eye(3), faces=[[0, 1, 1]])
