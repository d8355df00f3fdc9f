"""Held-out items: what is shown is a part of what is there; surfaces are the soup's."""

import dataclasses

import numpy as np
import pytest
import torch

from model.data.soup_source import SoupSource
from model.evaluation.held_out import HeldOut, blinded, held_out
from tests.unit.model.data.small import CONFIG, library

SHOWN = dataclasses.replace(CONFIG, states=2, views=2)


@pytest.fixture(scope="module")
def item() -> HeldOut:
    return next(held_out(SoupSource(library(), slots=6), SHOWN, count=1))


def test_more_views_and_states_than_are_shown(item: HeldOut) -> None:
    shown, everything = item.shown.images.rgb_BTV3HW, item.everything.images.rgb_BTV3HW
    assert shown.shape[:3] == (1, 2, 2)
    assert everything.shape[:3] == (1, 3, 4)
    assert torch.equal(shown, everything[:, :2, :2])
    assert item.shown.truth.motion_BTP.shape[1] == 2
    # White behind the object, so that predictions over white compare.
    corner = everything[..., 0, 0]
    assert torch.equal(corner, torch.ones_like(corner))


def test_surfaces_lie_in_their_boxes(item: HeldOut) -> None:
    assert item.layout.name == item.name
    assert item.layout.category == "cabinet"
    for mesh, box in zip(item.layout.meshes, item.layout.boxes, strict=True):
        assert mesh is not None
        # Triangles may leave the exact shape by 0.01 radii; boxes are float32.
        assert np.abs(mesh.bounds - box).max() <= 0.0101


def test_blind_images_tell_nothing(item: HeldOut) -> None:
    """Those of two objects are the same bits, and as many as before."""
    seen = item.shown.images
    first, second = blinded(seen), blinded(seen.mapped(lambda tensor: tensor + 1.0))
    for name in ("rgb_BTV3HW", "alpha_BTVHW", "intrinsics_BTV33", "camera_from_world_BTV44"):
        assert torch.equal(getattr(first, name), getattr(second, name)), name
        assert getattr(first, name).shape == getattr(seen, name).shape
    turn = first.camera_from_world_BTV44[0, 0, 0, :3, :3]
    assert torch.equal(turn @ turn.T, torch.eye(3))
    assert torch.linalg.det(turn) == 1.0


def test_the_same_scene_again(item: HeldOut) -> None:
    again = next(held_out(SoupSource(library(), slots=6), SHOWN, count=1))
    assert torch.equal(again.everything.images.rgb_BTV3HW, item.everything.images.rgb_BTV3HW)
    other = next(held_out(SoupSource(library(), slots=6), SHOWN, count=1, seed=1))
    assert not torch.equal(other.shown.images.rgb_BTV3HW, item.shown.images.rgb_BTV3HW)


def test_few_objects_are_spread_over_all() -> None:
    """The last of two lies in the second half, so that no category at the end is missed."""
    source = SoupSource(library(), slots=6)
    every = [item.name for item in held_out(source, SHOWN, count=99)]
    first, last = (item.name for item in held_out(source, SHOWN, count=2))
    assert [first, last] == [every[0], every[len(every) // 2]]


def test_objects_that_do_not_fit_are_left_out() -> None:
    names = [item.name for item in held_out(SoupSource(library(), slots=6), SHOWN, count=99)]
    assert len(names) == len(SoupSource(library(), slots=6))
    assert not any(name.startswith("office_chair") for name in names)


def test_the_truth_is_canonical_whatever_was_learned(item: HeldOut) -> None:
    other = dataclasses.replace(SHOWN, part_order="shuffled", rest="first")
    again = next(held_out(SoupSource(library(), slots=6), other, count=1))
    assert torch.equal(again.shown.truth.center_BP3, item.shown.truth.center_BP3)
    assert torch.equal(again.shown.truth.motion_BTP, item.shown.truth.motion_BTP)
