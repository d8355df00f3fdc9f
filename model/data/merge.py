"""Blocks of tensors put together along their first axis."""

import dataclasses
from collections.abc import Sequence
from typing import TypeVar

import torch
from torch import Tensor

from model.batch import TensorBlock

Block = TypeVar("Block", bound=TensorBlock)


def merged(blocks: Sequence[Block]) -> Block:
    """The items of all blocks, in order; what is no tensor and no tuple of strings must agree."""
    first = blocks[0]
    if len(blocks) == 1:
        return first
    changed: dict[str, object] = {}
    for field in dataclasses.fields(first):  # type: ignore[arg-type]
        values = [getattr(block, field.name) for block in blocks]
        changed[field.name] = _merged_values(values)
    return dataclasses.replace(first, **changed)  # type: ignore[type-var]


def chosen(block: Block, rows: Sequence[int]) -> Block:
    """Some items of a block, in the order of `rows`."""
    index = torch.tensor(rows, dtype=torch.int64)
    picked = block.mapped(lambda tensor: tensor[index.to(tensor.device)])
    words = {
        field.name: tuple(getattr(block, field.name)[k] for k in rows)
        for field in dataclasses.fields(block)  # type: ignore[arg-type]
        if _is_words(getattr(block, field.name))
    }
    return dataclasses.replace(picked, **words)  # type: ignore[type-var]


def _is_words(value: object) -> bool:
    return isinstance(value, tuple) and bool(value) and isinstance(value[0], str)


def _merged_values(values: list[object]) -> object:
    first = values[0]
    if isinstance(first, Tensor):
        return torch.cat([value for value in values if isinstance(value, Tensor)])
    if isinstance(first, TensorBlock):
        return merged([value for value in values if isinstance(value, TensorBlock)])
    if _is_words(first):
        return tuple(word for value in values if isinstance(value, tuple) for word in value)
    return first
