import dataclasses

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from model.data.draws import background_color
from model.data.scene import drawn_scene
from model.data.truth import articulation
from model.field.kinematics import world_from_rest
from tests.unit.model.data.small import CONFIG, soup


def test_a_scene_is_a_function_of_its_stream():
    one, same, other = (drawn_scene(soup("cabinet"), CONFIG, Stream(0, k)) for k in ("a", "a", "b"))
    for name in ("poses", "looks", "background", "draws", "vertices"):
        assert np.array_equal(getattr(one, name), getattr(same, name)), name
    assert not np.array_equal(one.poses, other.poses)
    assert not np.array_equal(one.inputs.camera_from_world, other.inputs.camera_from_world)


def test_more_rays_or_views_change_no_other_draw():
    one = drawn_scene(soup("cabinet"), CONFIG, Stream(0))
    more = drawn_scene(soup("cabinet"), dataclasses.replace(CONFIG, rays=200, views=3), Stream(0))
    assert np.array_equal(one.poses, more.poses)
    assert np.array_equal(one.looks, more.looks)
    assert np.array_equal(one.others.camera_from_world, more.others.camera_from_world)
    assert np.array_equal(one.draws, more.draws[: len(one.draws)])


def test_motion_says_what_the_states_show():
    drawn = {
        kind: drawn_scene(soup("cabinet"), dataclasses.replace(CONFIG, motion=kind), Stream(2))
        for kind in ("states", "one", "rest")
    }
    motion = {kind: scene.truth.arrays["motion_TP"] for kind, scene in drawn.items()}
    assert not np.array_equal(*motion["states"])
    assert np.array_equal(*motion["one"])
    assert motion["one"].any()
    assert not motion["rest"].any()
    identity = np.broadcast_to(np.eye(4), drawn["rest"].poses.shape)
    np.testing.assert_allclose(drawn["rest"].poses, identity, atol=1e-7)


def test_all_of_the_object_is_in_every_input_image():
    scene = drawn_scene(soup("laptop"), CONFIG, Stream(7))
    part = np.zeros(len(scene.vertices), int)
    part[scene.faces] = scene.part[:, None]
    for t in range(CONFIG.states):
        pose = scene.poses[t][part]
        points = np.einsum("vij,vj->vi", pose[:, :3, :3], scene.vertices) + pose[:, :3, 3]
        assert np.linalg.norm(points, axis=1).max() < 1.0 + 1e-5  # ... and in the unit sphere
        for v in range(CONFIG.views):
            camera = scene.inputs.camera_from_world[t, v]
            local = points @ camera[:3, :3].T + camera[:3, 3]
            pixels = local @ scene.inputs.intrinsics[t, v].T
            assert np.abs(pixels[:, :2] / pixels[:, 2:] - 16.0).max() <= 16.0


def test_an_object_with_too_many_parts_is_refused():
    with pytest.raises(ModelError, match="do not fit into 2 slots"):
        drawn_scene(soup("cardboard_box"), dataclasses.replace(CONFIG, slots=2), Stream(0))


def test_backgrounds():
    assert background_color("white", Stream(0)).tolist() == [1.0, 1.0, 1.0]
    assert background_color("black", Stream(0)).tolist() == [0.0, 0.0, 0.0]
    drawn = background_color("random", Stream(0))
    assert np.array_equal(drawn, background_color("random", Stream(0)))
    assert len(set(drawn.tolist())) == 3


@pytest.mark.parametrize("category", ["cabinet", "laptop", "cardboard_box"])
def test_counted_from_the_first_state_the_object_moves_the_same(category):
    """Poses since the first state are those since rest, undone by the first; float32 and radii of
    at most 2 leave 1e-6. Boxes hold the parts as they stand in it, without room to spare."""
    first = dataclasses.replace(CONFIG, rest="first")
    one, other = (drawn_scene(soup(category), config, Stream(4)) for config in (CONFIG, first))
    assert np.array_equal(one.poses, other.poses)
    blocks = [articulation([scene.truth], torch.device("cpu")) for scene in (one, other)]
    closed, counted = (world_from_rest(block)[0] for block in blocks)
    torch.testing.assert_close(counted, closed @ closed[:1].inverse(), rtol=0.0, atol=1e-6)
    assert not blocks[1].motion_BTP[:, 0].any()
    truth = other.truth.arrays
    for part in range(len(soup(category).parts)):
        pose = one.poses[0, part]
        points = one.vertices[one.faces[one.part == part]].reshape(-1, 3) @ pose[:3, :3].T
        points = points + pose[:3, 3]
        np.testing.assert_allclose(
            [points.min(axis=0), points.max(axis=0)],
            truth["center_P3"][part] + np.array([[-0.5], [0.5]]) * truth["size_P3"][part],
            atol=1e-5,
        )


def test_limits_are_counted_from_the_first_state_as_well():
    first = dataclasses.replace(CONFIG, rest="first")
    scenes = [drawn_scene(soup("cabinet"), config, Stream(4)) for config in (CONFIG, first)]
    one, other = (scene.truth.arrays for scene in scenes)
    start = one["motion_TP"][0]
    np.testing.assert_allclose(other["limits_P2"] + start[:, None], one["limits_P2"], atol=1e-12)
    assert np.ptp(other["limits_P2"], axis=1).any()
