"""Small objects, settings and batches that the tests of training data share."""

import dataclasses
from functools import cache

import torch

from model.batch import TensorBlock
from model.data.config import DataConfig
from model.data.library import Library, packed
from model.data.soup import Soup, seed_soup

COARSE = 0.01
"""Radii; fewer triangles than a library has, so that tests are quick."""
CONFIG = DataConfig(
    seed=5,
    batch=4,
    slots=6,
    views=2,
    input_px=24,
    render_px=32,
    target_px=40,
    rays=96,
)


@cache
def soup(category: str, index: int = 0) -> Soup:
    """An object at a seed of the tests' own."""
    return seed_soup(category, 23, index, tolerance=COARSE)


@cache
def library() -> Library:
    """Three cabinets, a laptop, a box and an office chair, which has more parts than slots."""
    soups = [soup("cabinet", k) for k in range(3)]
    return packed([*soups, soup("laptop"), soup("cardboard_box"), soup("office_chair")])


def assert_equal(a: TensorBlock, b: TensorBlock) -> None:
    """Two blocks hold the same bits."""
    for field in dataclasses.fields(a):  # type: ignore[arg-type]
        one, other = getattr(a, field.name), getattr(b, field.name)
        if isinstance(one, torch.Tensor):
            assert torch.equal(one, other), field.name
        elif isinstance(one, TensorBlock):
            assert_equal(one, other)
        else:
            assert one == other, field.name
