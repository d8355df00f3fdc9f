"""Slopes of the losses: right, none for empty slots, and each number is taught by its own terms."""

import dataclasses
from typing import Any

import pytest
import torch
from torch import Tensor

from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation
from model.config import LossWeights
from model.training.losses import (
    articulation_terms,
    image_terms,
    losses,
    mean,
    part_perceptual,
)
from tests.unit.model.tiny_art import drawn_batch, drawn_truth
from tests.unit.model.training.exact import (
    ALL,
    batch_of,
    from_leaves,
    leaves,
    patches_of,
    seen,
)


@pytest.mark.parametrize(
    "reading",
    [
        {},
        {"origin_to": "line", "axis_sign": "free"},
        {"motion_as": "paths", "unmoved": 0.1},
        {"origin_to": "line", "axis_sign": "free", "motion_as": "paths"},
    ],
)
def test_slopes_of_the_articulation_terms_are_right(reading: dict[str, Any]) -> None:
    truth = drawn_truth(3)
    weights = LossWeights(**reading)
    numbers = leaves(truth, 3)
    names = list(numbers)

    def terms(*values: Tensor) -> tuple[Tensor, ...]:
        said = from_leaves(truth, dict(zip(names, values, strict=True)))
        return tuple(articulation_terms(said, truth, weights).values())

    assert torch.autograd.gradcheck(terms, [numbers[name].requires_grad_() for name in names])


def test_slopes_of_the_image_terms_are_right() -> None:
    batch = drawn_batch(4, rays=3)
    rays = batch.rays
    assert rays is not None
    right = seen(rays)
    names = ["part_rgb_BPR3", "part_alpha_BPR", "rgb_BR3", "alpha_BR", "distance_BR"]

    def terms(*values: Tensor) -> tuple[Tensor, ...]:
        rendered = dataclasses.replace(right, **dict(zip(names, values, strict=True)))
        return tuple(image_terms(rendered, rays, batch.truth.valid_BP).values())

    inputs = [(getattr(right, name) * 0.9 + 0.01).requires_grad_() for name in names]
    assert torch.autograd.gradcheck(terms, inputs)


def test_slopes_of_the_perceptual_term_are_right() -> None:
    batch = drawn_batch(4, rays=8)
    rays = patches_of(batch.rays, 2, 2)
    right = seen(rays)

    def term(part_rgb: Tensor) -> Tensor:
        rendered = dataclasses.replace(right, part_rgb_BPR3=part_rgb)
        return part_perceptual(rendered, rays, batch.truth.valid_BP, _unlike)

    assert torch.autograd.gradcheck(term, [(0.9 * right.part_rgb_BPR3 + 0.01).requires_grad_()])


def _unlike(ours: Tensor, theirs: Tensor) -> Tensor:
    """Differences of neighboring pixels, so that it matters which lies beside which."""
    return (ours.diff(dim=-1) - theirs.diff(dim=-1)).square().sum(dim=(1, 2, 3))


def slopes(truth: Articulation, weights: LossWeights = ALL) -> dict[str, Tensor]:
    numbers = {name: tensor.requires_grad_() for name, tensor in leaves(truth, 5).items()}
    losses(from_leaves(truth, numbers), batch_of(truth), weights)["total"].backward()
    return {
        name: torch.zeros_like(tensor) if tensor.grad is None else tensor.grad
        for name, tensor in numbers.items()
    }


def test_empty_slots_get_no_slope_and_full_ones_do() -> None:
    truth = drawn_truth(6, (2, 4))
    for name, slope in slopes(truth).items():
        if name != "count_logits_BQ":
            by_slot = slope.transpose(1, 2) if name == "motion_BTP" else slope
            assert (by_slot[0, 2:] == 0.0).all(), name
            assert (by_slot[1, 3] != 0.0).any() or name == "origin_BP3", name


def test_what_empty_slots_hold_in_the_truth_changes_nothing() -> None:
    truth = drawn_truth(7, (2, 3))
    spoilt = truth.mapped(lambda t: torch.where(_spread(truth.valid_BP, t), t, t * 0 + 1))
    numbers = leaves(truth, 7)
    both = [
        losses(
            from_leaves(truth, numbers),
            batch_of(dataclasses.replace(t, valid_BP=truth.valid_BP)),
            ALL,
        )
        for t in (truth, spoilt)
    ]
    assert {name: float(term) for name, term in both[0].items()} == {
        name: float(term) for name, term in both[1].items()
    }


def _spread(valid_BP: Tensor, tensor: Tensor) -> Tensor:
    """The mask in the shape of a tensor with a slot dimension."""
    if tensor.dim() == 3 and tensor.shape[2] == valid_BP.shape[1] and tensor.shape[1] == 2:
        return valid_BP[:, None].expand_as(tensor)
    while valid_BP.dim() < tensor.dim():
        valid_BP = valid_BP[..., None]
    return valid_BP.expand_as(tensor)


def test_base_learns_its_box_alone() -> None:
    truth = drawn_truth(8)
    for name, slope in slopes(truth).items():
        if name not in ("center_BP3", "size_BP3", "count_logits_BQ"):
            base = slope[..., 0] if name == "motion_BTP" else slope[:, 0]
            assert (base == 0.0).all(), name


def test_axis_points_are_learned_where_parts_turn() -> None:
    """A prismatic part has no axis point; its direction is learned all the same."""
    truth = drawn_truth(9, (4, 4))
    found = slopes(truth)
    turns, slides = truth.type_BP == REVOLUTE, truth.type_BP == PRISMATIC
    assert turns.any()
    assert slides.any()
    assert (found["origin_BP3"][turns] != 0.0).all()
    assert (found["origin_BP3"][~turns] == 0.0).all()
    assert (found["axis_BP3"][turns | slides] != 0.0).all()
    assert (found["axis_BP3"][truth.type_BP == FIXED] == 0.0).all()


def test_parts_that_do_not_move_teach_no_axis_where_so_asked() -> None:
    truth = drawn_truth(10, (4, 4))
    still = truth.motion_BTP.clone()
    still[:, :, 1] = 0.2
    truth = dataclasses.replace(truth, motion_BTP=still)
    taught = slopes(truth, dataclasses.replace(ALL, unmoved=0.001))
    for name in ("axis_BP3", "origin_BP3"):
        assert (taught[name][:, 1] == 0.0).all(), name
        assert (taught[name][:, 2:] != 0.0).any(), name
    assert (slopes(truth)["axis_BP3"][:, 1] != 0.0).all()
    assert (taught["motion_BTP"][:, :, 1] != 0.0).all()


def test_a_term_without_anything_to_apply_to_is_zero_with_a_slope_of_zero() -> None:
    truth = drawn_truth(14, (1, 1))
    found = slopes(truth)
    assert all(slope.isfinite().all() for slope in found.values())
    assert (found["type_logits_BP2"] == 0.0).all()
    values = torch.ones(3, requires_grad=True)
    nothing = mean(values, torch.zeros(3, dtype=torch.bool))
    nothing.backward()
    assert float(nothing.detach()) == 0.0
    assert values.grad is not None
    assert (values.grad == 0.0).all()
