"""Whole images are the rays of their pixels, in any number of pieces."""

import pytest
import torch

from model.field import pictures as module
from model.field.kinematics import moved, world_from_rest
from model.field.pictures import pictures
from model.field.volume import render_along
from tests.unit.model.box_scenes import box_field, cabinet, camera, intrinsics, view

EYES = ((1.8, -2.2, 1.4), (0.3, -3.0, 0.2))


@pytest.mark.parametrize("rays", [1 << 14, 100])
def test_pictures_are_their_rays(rays: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two states by two views; pieces of 100 rays end in the middle of images."""
    monkeypatch.setattr(module, "RAYS", rays)
    articulation = cabinet()
    cameras = torch.stack([camera(eye) for eye in EYES]).expand(1, 2, 2, 4, 4)
    matrices = intrinsics(12).expand(1, 2, 2, 3, 3)
    options = {"inverse_beta": 100.0, "samples": 12}
    field = box_field(articulation)
    found = pictures(field, articulation, matrices, cameras, height=12, width=12, **options)
    assert found.part_rgb_BPTV3HW.shape == (1, 6, 2, 2, 3, 12, 12)
    for state in range(2):
        for number, eye in enumerate(EYES):
            origin, direction = view(12, eye)
            states = torch.full((1, 144), state)
            seen = render_along(field, articulation, origin, direction, states, **options)
            rgb = found.rgb_BTV3HW[0, state, number].movedim(0, -1).reshape(-1, 3)
            torch.testing.assert_close(rgb, seen.rgb_BR3[0], rtol=0, atol=1e-6)
            part = found.part_alpha_BPTVHW[0, :, state, number].reshape(6, -1)
            torch.testing.assert_close(part, seen.part_alpha_BPR[0], rtol=0, atol=1e-6)
            far = found.distance_BTVHW[0, state, number].flatten()
            torch.testing.assert_close(far, seen.distance_BR[0], rtol=0, atol=1e-5)
    assert torch.equal(found.over(1.0)[..., 0, 0], torch.ones(1, 2, 2, 3))


def test_a_part_is_where_the_camera_projects_it() -> None:
    """The middle of the moved knob, projected by hand, lies at the middle of its own mask within
    half a pixel: of a box seen in perspective the two differ by less than a tenth of its width."""
    articulation = cabinet()
    matrices = intrinsics(48).expand(1, 2, 1, 3, 3)
    cameras = camera(EYES[0]).expand(1, 2, 1, 4, 4)
    found = pictures(
        *(box_field(articulation), articulation, matrices, cameras),
        height=48,
        width=48,
        inverse_beta=200.0,
        samples=16,
    )
    poses = world_from_rest(articulation)
    for state in range(2):
        middle = moved(poses[0, state, 3], articulation.center_BP3[0, 3, None])
        local = moved(camera(EYES[0]), middle)[0]
        pixel = (intrinsics(48) @ local)[:2] / local[2]
        mask = found.part_alpha_BPTVHW[0, 3, state, 0]
        y, x = torch.meshgrid(*(torch.arange(48) + 0.5 for _ in range(2)), indexing="ij")
        centroid = torch.stack([(mask * x).sum(), (mask * y).sum()]) / mask.sum()
        assert (centroid - pixel).norm() < 0.5
