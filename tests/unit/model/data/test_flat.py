"""Bytes and back are the same batch, to the bit."""

import dataclasses

import torch

from model.data.flat import from_bytes, to_bytes
from tests.unit.model.data.small import assert_equal
from tests.unit.model.tiny_art import drawn_batch


def test_a_batch_comes_back_to_the_bit() -> None:
    batch = dataclasses.replace(
        drawn_batch(3, rays=8), asset_ids=("laptop_000001", "lade_ä"), categories=("laptop", "Lade")
    )
    assert_equal(from_bytes(to_bytes(batch, {}), {}), batch)
    alone = dataclasses.replace(batch, rays=None)
    assert from_bytes(to_bytes(alone, {}), {}).rays is None


def test_named_tensors_are_kept_changed() -> None:
    batch = drawn_batch(3, rays=8)
    name = "truth.size_BP3"
    data = to_bytes(batch, {name: torch.Tensor.half})
    back = from_bytes(data, {name: torch.Tensor.double})
    assert torch.equal(back.truth.size_BP3, batch.truth.size_BP3.half().double())
    assert torch.equal(back.truth.center_BP3, batch.truth.center_BP3)
