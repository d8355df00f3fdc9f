"""Batches of soups, held against embree, forward kinematics and the crop of inference."""

import dataclasses

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError
from artgen.core.mesh import TriMesh
from artgen.core.stream import Stream
from artgen.core.transform import inverted
from artgen.dataset.preprocess import square_view
from artgen.dataset.split import split_of
from model.batch import Batch, Rays
from model.data.cameras import state_cameras
from model.data.config import DataConfig
from model.data.library import packed
from model.data.scene import Scene, drawn_scene
from model.data.soup_source import SoupSource, shown
from model.data.stage import photographs, staged
from renders.raycast import PartCaster
from tests.unit.model.data.small import CONFIG, assert_equal, library, soup

CPU = torch.device("cpu")
OTHER_SETTINGS = {
    "others": {},
    "inputs": {"targets_from": "inputs", "target_views": 2},
    "patches": {"patch_px": 8, "rays": 128},
    "own cameras": {"same_cameras": False},
}


def _made(category: str, config: DataConfig, seed: int = 0) -> tuple[Scene, Batch, Rays]:
    scene = drawn_scene(soup(category), config, Stream(seed))
    batch = shown([scene], config, CPU)
    assert batch.rays is not None
    return scene, batch, batch.rays


@pytest.mark.parametrize("settings", OTHER_SETTINGS.values(), ids=OTHER_SETTINGS.keys())
@pytest.mark.parametrize("category", ["cabinet", "laptop"])
def test_rays_meet_parts_alone_and_together_where_embree_says(category, settings):
    """Each ray, moved into each part's rest frame, must meet the part, or miss it, as its target
    says; the nearest of all is at its distance. So depth reprojects onto the surface."""
    scene, _, rays = _made(category, dataclasses.replace(CONFIG, **settings), seed=3)
    nearest = np.full(rays.alpha_BR.shape[1], np.inf)
    wrong = 0
    for p in range(int(scene.truth.arrays["valid_P"].sum())):
        distance = _embree(scene, rays, p)
        nearest = np.minimum(nearest, distance)
        wrong += (np.isfinite(distance) != (rays.part_alpha_BPR[0, p].numpy() > 0)).sum()
    assert wrong <= 1  # A ray may pass an edge within rounding.
    shown_distance = rays.distance_BR[0].numpy()
    both = (shown_distance > 0) & np.isfinite(nearest)
    assert ((shown_distance > 0) != np.isfinite(nearest)).sum() <= 1
    # LATER times up to 100 bodies at 5 radii, and float32 corners on slopes up to 1:50.
    assert np.abs(shown_distance - nearest)[both].max() < 1e-3
    assert both.sum() > 40


@pytest.mark.parametrize("settings", OTHER_SETTINGS.values(), ids=OTHER_SETTINGS.keys())
def test_targets_agree_with_each_other(settings):
    _, _, rays = _made("cabinet", dataclasses.replace(CONFIG, **settings))
    assert torch.equal(rays.alpha_BR, rays.part_alpha_BPR.amax(dim=1))
    assert torch.equal(rays.alpha_BR > 0, rays.distance_BR > 0)
    assert (rays.part_rgb_BPR3 <= rays.part_alpha_BPR[..., None]).all()
    # The object shows the color of one of its parts.
    off = (rays.part_rgb_BPR3 - rays.rgb_BR3[:, None]).abs().amax(dim=-1)
    assert not off.amin(dim=1)[rays.alpha_BR > 0].any()
    torch.testing.assert_close(
        rays.direction_BR3.norm(dim=-1), torch.ones(1, rays.alpha_BR.shape[1])
    )


def test_the_network_sees_the_crop_of_inference_over_the_background():
    scene, batch, _ = _made("laptop", CONFIG)
    rgba = photographs(staged([scene], CPU), state_cameras([scene.inputs], CPU), size=32)
    for t, v in np.ndindex(CONFIG.states, CONFIG.views):
        raw = rgba[0, t * CONFIG.views + v].numpy()
        expected = square_view(raw, scene.inputs.intrinsics[t, v], size=CONFIG.input_px)
        color = expected.rgba[..., :3] + (1.0 - expected.rgba[..., 3:]) * scene.background
        # float32 sums of at most 32 x 32 terms below 1.
        found = batch.images.rgb_BTV3HW[0, t, v].permute(1, 2, 0).numpy()
        assert np.abs(found - color).max() < 2e-6
        assert (
            np.abs(batch.images.alpha_BTVHW[0, t, v].numpy() - expected.rgba[..., 3]).max() < 2e-6
        )
        matrix = batch.images.intrinsics_BTV33[0, t, v].numpy()
        np.testing.assert_allclose(matrix, expected.intrinsics, rtol=1e-6)


def test_input_rays_go_through_the_cropped_images():
    """A supervised ray of an input view projects into the network's image, and onto its color."""
    config = dataclasses.replace(CONFIG, targets_from="inputs", target_views=2, input_px=48)
    config = dataclasses.replace(config, render_px=96, target_px=96)
    _, batch, rays = _made("cabinet", config)
    inside = 0
    for r in range(config.rays):
        if rays.alpha_BR[0, r] == 0:
            continue
        t = int(rays.state_BR[0, r])
        point = rays.origin_BR3[0, r] + rays.distance_BR[0, r] * rays.direction_BR3[0, r]
        for v in range(config.views):
            pose = batch.images.camera_from_world_BTV44[0, t, v]
            if (pose[:3, :3] @ rays.origin_BR3[0, r] + pose[:3, 3]).norm() > 1e-4:
                continue
            pixel = batch.images.intrinsics_BTV33[0, t, v] @ (pose[:3, :3] @ point + pose[:3, 3])
            column, row = (pixel[:2] / pixel[2]).long().clamp(0, 47).tolist()
            assert batch.images.alpha_BTVHW[0, t, v, row, column] > 0
            inside += 1
    assert inside > 40


@pytest.mark.parametrize("targets_from", ["inputs", "others"])
def test_noise_of_poses_changes_nothing_but_what_the_network_is_told(targets_from):
    config = dataclasses.replace(CONFIG, targets_from=targets_from)
    _, clean, rays = _made("cabinet", config)
    _, noisy, noisy_rays = _made("cabinet", dataclasses.replace(config, pose_noise_deg=5.0))
    assert_equal(noisy_rays, rays)
    assert torch.equal(noisy.images.rgb_BTV3HW, clean.images.rgb_BTV3HW)
    turned = noisy.images.camera_from_world_BTV44 - clean.images.camera_from_world_BTV44
    assert turned.abs().max() > 0.02


def test_company_changes_no_image():
    """On one machine an item is the same alone and among others, to rounding of sums."""
    scenes = [
        drawn_scene(soup(name), CONFIG, Stream(k)) for k, name in enumerate(("cabinet", "laptop"))
    ]
    both = shown(scenes, CONFIG, CPU)
    for k in range(2):
        alone = shown(scenes[k : k + 1], CONFIG, CPU)
        torch.testing.assert_close(both.images.rgb_BTV3HW[k], alone.images.rgb_BTV3HW[0])
        assert both.rays is not None
        assert alone.rays is not None
        assert torch.equal(both.rays.part_alpha_BPR[k], alone.rays.part_alpha_BPR[0])
        torch.testing.assert_close(both.rays.rgb_BR3[k], alone.rays.rgb_BR3[0])


def test_articulation_alone_casts_no_rays():
    scene = drawn_scene(soup("cabinet"), dataclasses.replace(CONFIG, rays=0), Stream(0))
    assert scene.others is None
    config = dataclasses.replace(CONFIG, rays=0)
    alone, full = shown([scene], config, CPU), shown([_made("cabinet", CONFIG)[0]], CONFIG, CPU)
    assert alone.rays is None
    assert_equal(alone.images, full.images)
    assert_equal(alone.truth, full.truth)


def test_objects_with_too_many_parts_are_counted_and_told(caplog):
    source = SoupSource(library(), slots=6)
    assert len(source) == 5
    assert list(source.left_out) == ["office_chair_000000"]
    assert "parts, 6 slots" in source.left_out["office_chair_000000"]
    assert "1 of 6 objects are left out, such as office_chair_000000: 18 parts" in caplog.text


def test_splits_share_no_object():
    many = packed(
        [dataclasses.replace(soup("laptop"), asset_id=f"laptop_{k:06d}") for k in range(60)]
    )
    names = {}
    for split in ("train", "val", "test"):
        source = SoupSource(many, split=split)
        names[split] = {many.ids[k] for k in source.positions}
        assert all(split_of(name) == split for name in names[split])
    assert sum(len(found) for found in names.values()) == 60


def test_an_object_that_borrows_parts_lies_where_its_donors_do():
    """One donor in train, one in test: the object is in neither split, and that is said."""
    ids = [f"laptop_{k:06d}" for k in range(60)]
    train = next(name for name in ids if split_of(name) == "train")
    test = next(name for name in ids if split_of(name) == "test")
    made = soup("laptop")
    mixed = dataclasses.replace(made, asset_id="mixed", donors=(train, test))
    whole = dataclasses.replace(made, asset_id="whole", donors=(test,))
    both = packed([mixed, whole])
    assert both[1].donors == (test,)
    source = SoupSource(both, split="test")
    assert source.positions == (1,)
    assert "borrows parts from different splits" in source.left_out["mixed"]
    assert len(SoupSource(both)) == 2
    with pytest.raises(ModelError, match="split train"):
        SoupSource(both, split="train")


def test_an_empty_split_is_refused():
    only = packed([soup("office_chair")])
    with pytest.raises(ModelError, match="raise the slots"):
        SoupSource(only, slots=6)


def _embree(scene: Scene, rays: Rays, part: int) -> np.ndarray:
    """(R,) distance along each ray to a part alone, in the state that the ray looks at."""
    faces = scene.faces[scene.part == part]
    caster = PartCaster(TriMesh(vertices=scene.vertices, faces=faces))
    distance = np.full(rays.alpha_BR.shape[1], np.inf)
    for r, t in enumerate(rays.state_BR[0].tolist()):
        rest = inverted(scene.poses[t, part].astype(float))
        origin = rest[:3, :3] @ rays.origin_BR3[0, r].double().numpy() + rest[:3, 3]
        ray = (rest[:3, :3] @ rays.direction_BR3[0, r].double().numpy())[None]
        triangle = caster._first(origin, ray)
        (met,) = np.nonzero(triangle >= 0)
        if len(met):
            met, along = caster._depth(origin, ray, triangle, met)
            distance[r] = along[0] if len(along) else np.inf
    return distance
