"""Cast labels are exact where the answer is known, and agree with themselves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats, TriMesh
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import apply, rigid
from artgen.dataset.sample import BACKGROUND
from artgen.geometry.solid import box, cylinder
from renders.labels import Labels, cast_labels
from renders.raycast import Box, PartCaster

SIZE = (48, 48)
FULL = (0, 0, *SIZE)


def images(
    caster: PartCaster, camera: Camera, pose: Floats, box: Box = FULL
) -> tuple[Floats, Floats]:
    """Depth and normal of one part alone."""
    labels = cast_labels([caster], [[pose]], [camera], [[[box]]])
    return labels.part_depth[0, 0, 0], labels.part_normal[0, 0, 0]


def at_rest(casters: list[PartCaster], camera: Camera, boxes: list[Box]) -> Labels:
    return cast_labels(casters, [[np.eye(4)] * len(casters)], [camera], [[boxes]])


def front_camera() -> Camera:
    corners = [[-0.6, -0.6, -0.2], [0.6, 0.6, 1.0]]
    return framed(corners, direction=orbit_direction(0, 0), fov=0.5, size=SIZE, fill=0.9)


def test_depth_is_planar_and_normals_face_outward() -> None:
    """A wall across the view has one depth, not one distance; float32 storage of 3 m: 2e-7."""
    camera = front_camera()
    wall = PartCaster(box((1.0, 0.2, 0.8)).trimesh())
    depth, normal = images(wall, camera, np.eye(4))
    expected = camera.project([0.0, -0.1, 0.4])[2]
    seen = depth > 0
    assert seen.sum() > 400
    np.testing.assert_allclose(depth[seen], expected, rtol=2e-7)
    np.testing.assert_allclose(normal[seen], np.tile([0, -1, 0], (seen.sum(), 1)), atol=1e-7)
    assert not normal[~seen].any()


@given(
    st.floats(-np.pi, np.pi),
    st.tuples(*[st.floats(-0.2, 0.2)] * 3),
    st.floats(-3, 3),
    st.floats(-1, 1),
)
@settings(deadline=None, max_examples=40)
def test_moving_the_rays_equals_moving_the_part(
    angle: float, shift: tuple, azimuth: float, elevation: float
) -> None:
    """Embree works in float32, so a silhouette pixel may flip; where both hit, float64 decides."""
    mesh = (box((0.3, 0.2, 0.5)) | cylinder(0.08, 0.8, segments=16)).trimesh()
    axis = np.array([0.36, 0.48, 0.8])
    pose = rigid(axis_angle_matrix(axis, angle), shift)
    moved = TriMesh(vertices=apply(pose, mesh.vertices), faces=mesh.faces)
    camera = framed(
        moved.vertices,
        direction=orbit_direction(azimuth, elevation),
        fov=0.6,
        size=SIZE,
        fill=0.9,
    )
    one, facing_one = images(PartCaster(mesh), camera, pose)
    two, facing_two = images(PartCaster(moved), camera, np.eye(4))
    assert ((one > 0) != (two > 0)).sum() <= 2
    both = (one > 0) & (two > 0)
    close = np.abs(one - two) < 1e-6
    assert (both & ~close).sum() <= 4  # an edge seen on one side or the other
    cosine = np.einsum("ij,ij->i", facing_one[both & close], facing_two[both & close])
    assert (cosine > 1 - 1e-5).mean() > 0.99


def test_the_composite_is_the_nearest_part_and_windows_only_save_work() -> None:
    near = box((0.3, 0.1, 0.3), at=(0, -0.3, 0.2)).trimesh()
    far = box((0.9, 0.1, 0.9)).trimesh()
    camera = front_camera()
    casters = [PartCaster(far), PartCaster(near)]
    labels = at_rest(casters, camera, [FULL, FULL])
    assert set(np.unique(labels.part_id)) == {0, 1, BACKGROUND}
    alone_far, alone_near = labels.part_depth[0, 0]
    shown = labels.part_id[0, 0] == 1
    assert np.array_equal(shown, alone_near > 0)
    assert np.array_equal(labels.depth[0, 0][shown], alone_near[shown])
    assert (alone_far[shown] > labels.depth[0, 0][shown]).all()
    assert np.array_equal(labels.part_id == BACKGROUND, labels.depth == 0)
    rows, columns = np.nonzero(alone_near)
    tight = (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
    cut = at_rest(casters, camera, [FULL, tight])
    assert np.array_equal(cut.part_depth, labels.part_depth)
    assert np.array_equal(cut.part_normal, labels.part_normal)


def test_a_part_outside_the_image_leaves_it_empty() -> None:
    caster = PartCaster(box((0.1, 0.1, 0.1)).trimesh())
    depth, normal = images(caster, front_camera(), np.eye(4), (0, 0, 0, 0))
    assert not depth.any()
    assert not normal.any()


def test_no_ray_slips_through_the_seams_of_a_closed_body() -> None:
    """A fine drum seen from 40 sides: every ray inside its silhouette hits its front."""
    ball = cylinder(0.3, 0.6, segments=64).trimesh()
    caster = PartCaster(ball)
    for k in range(40):
        camera = framed(
            ball.vertices, direction=orbit_direction(0.157 * k, 0.4), fov=0.5, size=SIZE, fill=0.9
        )
        depth, normal = images(caster, camera, np.eye(4))
        seen = depth > 0
        _, rays = camera.rays()
        # Smooth normals may turn away from a grazing ray by less than half a facet, 3 degrees.
        cosine = np.einsum("ijk,ijk->ij", normal, rays / np.linalg.norm(rays, axis=-1)[..., None])
        assert cosine[seen].max() < np.sin(np.radians(3.0))


@pytest.mark.parametrize("offset", [0.0, 0.013])
def test_a_known_point_is_found_in_the_id_image(offset: float) -> None:
    """The centroid of a small ball's pixels is the projection of its center, within half a pixel;
    perspective moves it by under 0.01 px at this size."""
    point = np.array([0.21 + offset, -0.13, 0.37 - offset])
    ball = cylinder(0.03, 0.06, segments=24).at(*(point - (0, 0, 0.03))).trimesh()
    camera = framed(
        [[-0.6, -0.6, -0.2], [0.6, 0.6, 1.0]],
        direction=orbit_direction(0.5, 0.35),
        fov=0.5,
        size=(64, 64),
        fill=0.9,
    )
    labels = at_rest([PartCaster(ball)], camera, [(0, 0, 64, 64)])
    rows, columns = np.nonzero(labels.part_id[0, 0] == 0)
    found = np.array([columns.mean() + 0.5, rows.mean() + 0.5])
    assert np.linalg.norm(found - camera.project(point)[:2]) < 0.5
