"""The study's cabinet: boxes around its boards, joints that open, views that see it all."""

import torch

from model.field.kinematics import moved, world_from_rest
from model.field.volume import render_along
from model.field_study.scene import PARTS, boards, scene


def test_boxes_hold_their_boards() -> None:
    field = boards()
    articulation = field.articulation
    for p, part in enumerate(PARTS):
        middle, size = (torch.tensor([board[k] for board in part]) for k in (0, 1))
        low, high = middle - size / 2.0, middle + size / 2.0
        center, half = articulation.center_BP3[0, p], articulation.size_BP3[0, p] / 2.0
        torch.testing.assert_close(center - half, low.amin(dim=0))
        torch.testing.assert_close(center + half, high.amax(dim=0))


def test_drawer_and_door_open_to_the_front() -> None:
    articulation = boards().articulation
    poses = world_from_rest(articulation)[0]
    for p in (1, 2):
        rest, there = (moved(poses[t, p], articulation.center_BP3[0, p, None])[0] for t in (0, 1))
        assert there[1] < rest[1] - 0.1


def test_everything_lies_in_the_unit_sphere_and_in_the_images() -> None:
    """No ray at the border of an image meets a board."""
    place = scene(12, "cpu")
    seen = render_along(
        *(place.field, place.articulation, place.origin_BR3, place.direction_BR3, place.state_BR),
        inverse_beta=100.0,
        samples=24,
    )
    images = seen.alpha_BR.reshape(2, 2, 12, 12)
    for border in (images[..., 0], images[..., -1], images[..., 0, :], images[..., -1, :]):
        assert border.max() < 0.01
    assert 0.1 < images.mean() < 0.5
    assert (seen.part_alpha_BPR.amax(dim=-1) > 0.9).all()
