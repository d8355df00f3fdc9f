"""A batch as bytes and back: safetensors, what is no tensor as JSON in front."""

import dataclasses
import json
from collections.abc import Callable, Mapping
from typing import Any

from safetensors.torch import load, save
from torch import Tensor

from model.batch import Articulation, Batch, Images, Rays, TensorBlock

Changes = Mapping[str, Callable[[Tensor], Tensor]]
BLOCKS: Mapping[str, Callable[..., TensorBlock]] = {
    "images": Images,
    "truth": Articulation,
    "rays": Rays,
}


def to_bytes(batch: Batch, changes: Changes) -> bytes:
    """The batch, with the tensors named in `changes` changed, such as `images.rgb_BTV3HW`."""
    tensors: dict[str, Tensor] = {}
    words: dict[str, Any] = {}
    for name, value in _flat(batch, ""):
        if isinstance(value, Tensor):
            kept = changes[name](value) if name in changes else value
            tensors[name] = kept.contiguous()
        else:
            words[name] = value
    head = json.dumps(words).encode()
    return len(head).to_bytes(4, "little") + head + save(tensors)


def from_bytes(data: bytes, changes: Changes) -> Batch:
    """The batch of `to_bytes`, the named tensors changed back."""
    end = 4 + int.from_bytes(data[:4], "little")
    fields: dict[str, dict[str, Any]] = {"": {}}
    for name, value in json.loads(data[4:end]).items():
        _put(fields, name, tuple(value) if isinstance(value, list) else value)
    for name, tensor in load(data[end:]).items():
        _put(fields, name, changes[name](tensor) if name in changes else tensor)
    top = fields.pop("")
    blocks: dict[str, Any] = {name: BLOCKS[name](**held) for name, held in fields.items()}
    return Batch(**top, **blocks)


def _flat(block: TensorBlock, before: str) -> list[tuple[str, object]]:
    found: list[tuple[str, object]] = []
    for field in dataclasses.fields(block):  # type: ignore[arg-type]
        value = getattr(block, field.name)
        if isinstance(value, TensorBlock):
            found += _flat(value, f"{before}{field.name}.")
        elif value is not None:
            found.append((f"{before}{field.name}", value))
    return found


def _put(fields: dict[str, dict[str, Any]], name: str, value: object) -> None:
    block, _, own = name.rpartition(".")
    fields.setdefault(block, {})[own] = value
