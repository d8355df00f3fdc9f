"""A plan frames every state, spends all chance, and refuses what cannot be rendered."""

import dataclasses
import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from artgen.articulation.states import check_state
from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.errors import RenderError
from artgen.core.stream import Stream
from artgen.core.transform import apply
from artgen.export import Bundle
from renders.asset import check_memory
from renders.passes import APRON, windows
from renders.plan import MOMENTS, RenderPlan, plan_render
from renders.settings import CameraSettings, Settings
from renders.subject import SIZES, check_size, hull_corners

MOVING = Settings(views=2, states=6, size=64, motion="trajectory", motion_blur=0.5)


def planned(bundle: Bundle, settings: Settings, seed: int = 3) -> RenderPlan:
    return plan_render(bundle, Stream(seed), settings=settings, folder=Path("unused"))


# ------------------------------------------------------------------------------------------ hulls


@given(
    arrays.arrays(float, st.tuples(st.integers(4, 40), st.just(3)), elements=st.floats(-1, 1)),
    st.floats(-math.pi, math.pi),
)
def test_the_hull_frames_as_all_points_do(points: np.ndarray, azimuth: float) -> None:
    """Qhull merges facets within 1e-12 of each other or so, flat clouds are kept whole: windows in
    px may differ where an edge falls on a pixel's border within that, so cameras are compared."""
    direction = orbit_direction(azimuth, 0.4)
    if np.ptp(points, axis=0).max() < 1e-3:
        return
    one, other = (
        framed(cloud, direction=direction, fov=0.6, size=(64, 64), fill=0.9)
        for cloud in (points, hull_corners(points))
    )
    np.testing.assert_allclose(
        one.camera_from_world, other.camera_from_world, rtol=0, atol=1e-9 * 30
    )


def test_windows_hold_points_and_their_apron() -> None:
    camera = Camera(focal=100.0, size=(64, 48), camera_from_world=np.eye(4))
    points = np.array([[-0.05, -0.1, 1.0], [0.1, 0.021, 1.0]])
    ((left, top, right, bottom),) = windows([camera], points)
    assert (left, top) == (32 - 5 - APRON, 24 - 10 - APRON)
    assert (right, bottom) == (32 + 10 + APRON, 24 + 3 + APRON)
    assert windows([camera], points + np.array([5.0, 0.0, 0.0])) == [(0, 0, 0, 0)]


# ------------------------------------------------------------------------------------------ plans


@pytest.mark.blender
@pytest.mark.parametrize(
    "settings",
    [
        Settings(views=3, states=3, size=64, cameras=CameraSettings(look_at=0.5, principal=0.4)),
        dataclasses.replace(MOVING, cameras=CameraSettings(scheme="sphere", dolly=0.5)),
    ],
)
def test_every_vertex_of_every_state_is_inside_every_image(
    bundle: Bundle, settings: Settings
) -> None:
    """Also while the shutter is open; 1e-6 px as in test_cameras.py."""
    plan = planned(bundle, settings)
    shown = plan.job.exposures or tuple((pose,) for pose in plan.poses)
    for camera, pose in itertools.product(plan.cameras, itertools.chain(*shown)):
        for part, mesh in zip(plan.bundle.parts, plan.meshes, strict=True):
            pixels = camera.project(apply(np.array(pose[part.name]), mesh.vertices))[:, :2]
            assert pixels.min() >= -1e-6
            assert pixels.max() <= 64 + 1e-6


@pytest.mark.blender
def test_a_trajectory_is_planned_with_its_shutter(bundle: Bundle) -> None:
    """The first or the last moment is the state itself, and all moments obey the bundle."""
    plan = planned(bundle, MOVING)
    assert not any(plan.states[0].values())
    for state in plan.states:
        check_state(bundle.joints, bundle.preconditions, state)
    assert plan.job.transport.motion_blur
    assert len(plan.job.exposures) == 6
    for pose, moments in zip(plan.poses, plan.job.exposures, strict=True):
        assert len(moments) == MOMENTS
        for name, matrix in pose.items():
            ends = (moments[0][name], moments[-1][name])
            assert any(np.array_equal(matrix, end) for end in ends)
    still = planned(bundle, dataclasses.replace(MOVING, motion_blur=0.0))
    assert not still.job.exposures
    assert still.states == plan.states


@pytest.mark.blender
def test_windows_hold_what_moves_while_the_shutter_is_open(bundle: Bundle) -> None:
    still = planned(bundle, dataclasses.replace(MOVING, motion_blur=0.0))
    names = [part.name for part in bundle.parts]
    blurred = planned(bundle, MOVING)
    wider = 0
    for t, v, p in np.ndindex(6, 2, len(names)):
        moments = blurred.job.exposures[t]
        points = [apply(np.array(m[names[p]]), blurred.meshes[p].vertices) for m in moments]
        (window,) = windows([blurred.cameras[v]], np.concatenate(points))
        assert blurred.passes.boxes[t][v][p] == window
        wider += window != still.passes.boxes[t][v][p]
    assert wider > 0


@pytest.mark.blender
def test_a_floor_lies_under_the_object_and_below_all_eyes(bundle: Bundle) -> None:
    settings = Settings(views=40, size=32, ground=True, cameras=CameraSettings(scheme="sphere"))
    plan = planned(bundle, settings)
    ground = plan.job.rig.ground
    assert ground is not None
    assert ground.height == min(mesh.bounds[0, 2] for mesh in plan.meshes)
    assert min(camera.position[2] for camera in plan.cameras) > ground.height
    assert planned(bundle, dataclasses.replace(settings, ground=False)).job.rig.ground is None


@pytest.mark.blender
def test_pose_noise_is_stated_beside_the_truth(bundle: Bundle) -> None:
    quiet = planned(bundle, Settings(views=2, size=32))
    noisy = planned(bundle, Settings(views=2, size=32, cameras=CameraSettings(rotation_noise=0.02)))
    assert quiet.stated is None
    assert noisy.stated is not None
    assert noisy.stated.camera_from_world.shape == (2, 2, 4, 4)
    assert [a.stated for a in quiet.cameras] == [b.stated for b in noisy.cameras]


@pytest.mark.blender
def test_more_views_and_states_leave_the_earlier_ones(bundle: Bundle) -> None:
    few, many = (planned(bundle, Settings(views=v, states=2, size=32)) for v in (2, 7))
    assert few.cameras[1].stated == many.cameras[1].stated
    assert planned(bundle, Settings(states=5)).states[:2] == few.states


@pytest.mark.blender
@pytest.mark.parametrize("factor", [SIZES[0] / 2, SIZES[1] * 2])
def test_sizes_that_cannot_be_rendered_are_told(bundle: Bundle, factor: float) -> None:
    meshes = [bundle.load_mesh(part.name) for part in bundle.parts]
    corners = np.array([[0.0, 0.0, 0.0], [0.6, 0.0, 0.8]])
    check_size(bundle, meshes, corners)
    with pytest.raises(RenderError, match="is its unit the meter"):
        check_size(bundle, meshes, corners * factor)
    with pytest.raises(RenderError, match="move it to the origin"):
        check_size(bundle, meshes, corners + 200.0)


@pytest.mark.blender
def test_images_that_would_not_fit_are_refused(bundle: Bundle) -> None:
    """2 views x 2 states of 32 px with 4 parts: 2.5 x 4 x 1024 x (48 + 80) bytes."""
    plan = planned(bundle, Settings(views=2, states=2, size=32))
    check_memory(plan, 1_310_720)
    with pytest.raises(RenderError, match=r"take about 0.0 GB .*fewer --views, --states"):
        check_memory(plan, 1_310_719)
