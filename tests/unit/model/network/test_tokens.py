"""Laws of tokens: which pixels and which ray a patch holds, and how states and slots are told."""

import dataclasses
from typing import Literal

import numpy as np
import pytest
import torch

from model.config import PlaneConfig
from model.network.tokens import PLANES, ImageTokenizer, SlotTokens, patches
from tests.unit.model.tiny_art import (
    BEYOND,
    SLOTS,
    STATES,
    TINY,
    VIEWS,
    drawn_images,
)

EPS64 = torch.finfo(torch.float64).eps


def tokenizer(**changes: object) -> ImageTokenizer:
    torch.manual_seed(0)
    config = dataclasses.replace(TINY.images, **changes)  # type: ignore[arg-type]
    return ImageTokenizer(config, 16).double()


def test_patches_are_squares_row_by_row() -> None:
    """Against loops."""
    pixels = torch.arange(2 * 3 * 2 * 36.0).reshape(2, 3, 2, 6, 6)
    cut = patches(pixels, 3)
    for row in range(2):
        for column in range(2):
            rows, columns = slice(3 * row, 3 * row + 3), slice(3 * column, 3 * column + 3)
            expected = pixels[..., rows, columns].flatten(2)
            assert torch.equal(cut[:, :, 2 * row + column], expected)


def test_a_pixel_changes_its_own_patch_and_no_other() -> None:
    images = drawn_images(1)
    rgb = images.rgb_BTV3HW.clone()
    rgb[1, 0, 2, :, 5, 2] = 0.5
    layer = tokenizer()
    before, after = layer(images), layer(dataclasses.replace(images, rgb_BTV3HW=rgb))
    assert before.shape == (2, STATES * VIEWS, 4, 16)
    changed = (before != after).any(dim=-1).nonzero().tolist()
    # State 0, view 2 is frame 2; row 5 of 8 and column 2 lie in the lower left patch of four.
    assert changed == [[1, 2, 2]]


@pytest.mark.parametrize("rays", ["patch", "pixel"])
def test_rays_go_through_the_pixels_they_stand_for(rays: Literal["patch", "pixel"]) -> None:
    """A point on the ray projects to the middle of the patch, or of the pixel."""
    images = drawn_images(2)
    coded = tokenizer(rays=rays)._rays(images)
    per_patch = 1 if rays == "patch" else 16
    assert coded.shape == (2, STATES * VIEWS, 4, 6 * per_patch)
    frame, patch, pixel = 4, 3, per_patch - 1
    ray = coded[1, frame, patch].reshape(6, per_patch)[:, pixel].numpy()
    direction, moment = ray[:3], ray[3:]
    # The point of the line nearest to the middle of the object is d x m; two radii further on lies
    # in front of the camera, which stands three radii away.
    point = np.cross(direction, moment) + 0.5 * direction
    state, view = divmod(frame, VIEWS)
    seen = images.camera_from_world_BTV44[1, state, view].numpy() @ [*point, 1.0]
    projected = images.intrinsics_BTV33[1, state, view].numpy() @ seen[:3]
    middle = (6.0, 6.0) if rays == "patch" else (7.5, 7.5)
    assert seen[2] > 0.0
    # Coordinates of some 10 px, a dozen float64 operations.
    np.testing.assert_allclose(projected[:2] / projected[2], middle, rtol=0, atol=1e3 * EPS64)
    assert np.linalg.norm(direction) == pytest.approx(1.0, abs=4 * EPS64)


def test_rays_keep_their_digits_in_reduced_precision() -> None:
    """Under autocast, a matrix product in bfloat16 would turn rays by a fifth of a patch."""
    images, layer = drawn_images(3, dtype=torch.float32), tokenizer().float()
    exact = layer._rays(images)
    with torch.autocast("cpu", torch.bfloat16):
        assert torch.equal(layer._rays(images), exact)


def test_states_are_told_apart_and_views_are_not() -> None:
    images = drawn_images(4)
    same = images.mapped(lambda tensor: tensor[:, :1, :1].expand_as(tensor))
    tokens = tokenizer()(same).reshape(2, STATES, VIEWS, 4, 16)
    assert torch.equal(tokens[:, :, 0], tokens[:, :, 1])
    assert (tokens[:, 0] != tokens[:, 1]).any(dim=-1).all()


def test_the_mask_is_seen_only_where_so_asked() -> None:
    images = drawn_images(5)
    blank = dataclasses.replace(images, alpha_BTVHW=images.alpha_BTVHW * 0.0)
    assert torch.equal(tokenizer()(images), tokenizer()(blank))
    assert (tokenizer(alpha=True)(images) != tokenizer(alpha=True)(blank)).any(dim=-1).all()


@pytest.mark.parametrize(
    ("changes", "numbers"),
    [
        ({}, 3 * 16 + 6 + 5),
        ({"alpha": True}, 4 * 16 + 6 + 5),
        ({"rays": "pixel"}, 3 * 16 + 6 * 16 + 5),
        ({"ray_octaves": 3}, 3 * 16 + 6 * 7 + 5),
        ({"encoder": "conv"}, 3 * 16 + 6 + 5 + 64),
    ],
)
def test_a_token_concatenates_what_the_settings_name(
    changes: dict[str, object], numbers: int
) -> None:
    layer = tokenizer(**changes)
    assert layer.project.in_features == numbers
    assert layer(drawn_images(6)).shape == (2, STATES * VIEWS, 4, 16)


@pytest.mark.parametrize("encoder", ["none", "conv"])
def test_the_blind_see_cameras_and_no_pixel(encoder: str) -> None:
    one, other = drawn_images(5), drawn_images(6)
    same_cameras = dataclasses.replace(
        one, rgb_BTV3HW=other.rgb_BTV3HW, alpha_BTVHW=1.0 - one.alpha_BTVHW
    )
    layer = tokenizer(alpha=True, encoder=encoder, blind=True)
    assert torch.equal(layer(one), layer(same_cameras))
    assert not torch.equal(layer(one), layer(other))
    sees = tokenizer(alpha=True, encoder=encoder)
    assert not torch.equal(sees(one), sees(same_cameras))


def test_slopes_of_image_tokens_are_right() -> None:
    images = drawn_images(7, objects=1, states=1, views=1)
    layer = tokenizer(encoder="conv")
    rgb = images.rgb_BTV3HW.clone().requires_grad_()
    assert torch.autograd.gradcheck(
        lambda x: layer(dataclasses.replace(images, rgb_BTV3HW=x)), rgb, fast_mode=True
    )


def slots_of(**changes: object) -> SlotTokens:
    torch.manual_seed(0)
    tokens = SlotTokens(dataclasses.replace(BEYOND, **changes))  # type: ignore[arg-type]
    for weights in tokens.parameters():
        torch.nn.init.normal_(weights)
    return tokens


@pytest.mark.parametrize(
    ("changes", "count"),
    [
        ({}, 1 + STATES + PLANES * 4),
        ({"motion": "vector"}, 1 + PLANES * 4),
        ({"motion": "vector", "slot_vector": "mean"}, PLANES * 4),
        ({"planes": None}, 1 + STATES),
        ({"planes": None, "slot_vector": "mean", "motion": "vector"}, 1),
        ({"planes": dataclasses.replace(TINY.planes, tokens="one")}, 1 + STATES),  # type: ignore[type-var]
    ],
)
def test_a_slot_has_the_tokens_the_settings_name(changes: dict[str, object], count: int) -> None:
    tokens = slots_of(**changes)
    made = tokens(2, 3, torch.randn(STATES, 5))
    assert made.shape == (2, 3, count, 16)
    vector, by_state, places = tokens.split(made)
    assert vector.shape == (2, 3, 16)
    assert (by_state is None) == (changes.get("motion") == "vector")
    if by_state is not None:
        assert by_state.shape == (2, 3, STATES, 16)
        assert torch.equal(made[:, :, 1 : 1 + STATES], by_state)
    if places is not None:
        assert torch.equal(places, made[:, :, -PLANES * 4 :])


def test_without_a_token_of_its_own_a_slots_vector_is_the_mean() -> None:
    tokens = slots_of(motion="vector", slot_vector="mean")
    made = tokens(1, 2, torch.randn(STATES, 5))
    vector, _, places = tokens.split(made)
    assert places is not None
    assert torch.equal(vector, places.mean(dim=2))


def test_shared_slots_differ_by_one_vector() -> None:
    tokens = slots_of(slot_embedding="shared", motion="vector")
    made = tokens(1, SLOTS, torch.randn(STATES, 5))[0]
    apart = made - made[:1]
    # The difference of two sums is exact to an eps of their size, some 4.
    torch.testing.assert_close(apart, apart[:, :1].expand_as(apart), rtol=0, atol=2e-6)
    separate = slots_of(motion="vector")(1, SLOTS, torch.randn(STATES, 5))[0]
    own = separate - separate[:1]
    assert (own[1:] - own[1:, :1]).abs().max() > 0.1


def test_the_papers_slot_has_3456_plane_tokens() -> None:
    """6 x 24 x 24."""
    with torch.device("meta"):
        tokens = SlotTokens(dataclasses.replace(TINY, planes=PlaneConfig()))
    assert tokens.places == 3456
