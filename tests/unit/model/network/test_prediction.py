"""Laws of predictions: what a type allows, and where shapes are absent."""

import dataclasses

import pytest
import torch

from artgen.core.errors import ModelError
from model.batch import FIXED, PRISMATIC, REVOLUTE
from model.network.prediction import with_types
from tests.unit.model.tiny_art import BEYOND, drawn_batch, drawn_images, drawn_truth, held, made


def test_types_keep_what_they_allow() -> None:
    truth = drawn_truth(1, (4, 4))
    axis, origin = truth.axis_BP3 + 1.0, truth.origin_BP3 + 1.0
    types = torch.tensor([[FIXED, REVOLUTE, PRISMATIC, FIXED]] * 2)
    posed = with_types(truth, axis, origin, types)
    assert torch.equal(posed.axis_BP3[:, 1:3], axis[:, 1:3])
    assert torch.equal(posed.origin_BP3[:, 1], origin[:, 1])
    assert (posed.origin_BP3[:, [0, 2, 3]] == 0.0).all()
    assert (posed.axis_BP3[:, [0, 3]] == 0.0).all()
    assert torch.equal(posed.motion_BTP[..., 1:3], truth.motion_BTP[..., 1:3])
    assert (posed.motion_BTP[..., [0, 3]] == 0.0).all()
    assert (posed.limits_BP2[:, [0, 3]] == 0.0).all()
    assert torch.equal(posed.center_BP3, truth.center_BP3)


def test_posing_as_the_truth_keeps_slopes_of_all_but_types() -> None:
    """Rendering through the true types reaches axes and origins that were decided away."""
    batch = drawn_batch(2)
    said = made(BEYOND)(batch.images, batch.truth.valid_BP)
    posed = said.posed_as(batch.truth)
    assert torch.equal(posed.type_BP, batch.truth.type_BP)
    assert torch.equal(posed.parent_BP, batch.truth.parent_BP)
    turns = batch.truth.type_BP == REVOLUTE
    assert torch.equal(posed.origin_BP3[turns], said.origin_BP3[turns])
    assert posed.origin_BP3.requires_grad


def test_shapes_of_a_network_without_planes_are_refused() -> None:
    art = made(dataclasses.replace(BEYOND, planes=None))
    said = art(drawn_images(3), held((3, 4)))
    with pytest.raises(ModelError, match="predicts articulation alone"):
        said.field()


def test_fields_of_a_fresh_network_are_balls() -> None:
    """The last layer of the distance begins at zero, so every part begins as the paper's ball."""
    said = made(BEYOND)(drawn_images(4), held((3, 4)))
    middle = torch.zeros(2, 4, 1, 3, dtype=torch.float64)
    distance, rgb = said.field()(middle)
    torch.testing.assert_close(distance, torch.full_like(distance, -0.1), rtol=0, atol=1e-15)
    assert ((rgb > 0.0) & (rgb < 1.0)).all()


def test_counts_begin_at_the_base() -> None:
    said = made(BEYOND)(drawn_images(5), held((3, 4)))
    counts = said.count()
    assert counts is not None
    assert said.count_logits_BQ is not None
    certain = torch.zeros_like(said.count_logits_BQ)
    certain[0, 0], certain[1, 3] = 9.0, 9.0
    assert dataclasses.replace(said, count_logits_BQ=certain).count().tolist() == [1, 4]  # type: ignore[union-attr]
    assert dataclasses.replace(said, count_logits_BQ=None).count() is None
