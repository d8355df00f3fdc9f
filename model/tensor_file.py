"""Named tensors beside what they mean, in one safetensors file that shows any damage.

The header holds the schema, the meaning as JSON, and a digest of the tensors; the file appears
whole or not at all.
"""

import hashlib
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save
from torch import Tensor

from artgen.core.errors import ModelError
from artgen.core.jsonio import canonical_json, write_bytes

KEY = "artgen"
"""Of the safetensors header."""


def write_tensors(
    path: Path, tensors: Mapping[str, Tensor], *, schema: str, meaning: Mapping[str, Any]
) -> None:
    """Write the tensors (any device, copied) and their meaning (JSON values)."""
    whole = {name: tensor.detach().cpu().contiguous().clone() for name, tensor in tensors.items()}
    # One key: safetensors writes several in an order that changes from run to run.
    header = canonical_json({"schema": schema, "meaning": meaning, "digest": _digest(whole)})
    # As bytes: safetensors writes files that nobody but their owner may read, and flushes none.
    write_bytes(path, save(whole, metadata={KEY: header}))


def read_tensors(path: Path, *, schema: str) -> tuple[dict[str, Tensor], dict[str, Any]]:
    """The tensors, on the CPU, and their meaning.

    Raises:
        ModelError: no such file, another kind of file or schema, truncated, or changed bytes.
    """
    with _opened(path) as (opened, header):
        _check_schema(path, header.get("schema"), schema)
        tensors = {name: opened.get_tensor(name) for name in opened.keys()}  # noqa: SIM118
    if header.get("digest") != _digest(tensors):
        raise ModelError(
            f"{path}: the weights differ from the digest in the header; the file was damaged or "
            "edited; copy it again, or delete it and use an older one"
        )
    return tensors, header["meaning"]


def read_schema(path: Path) -> str | None:
    """The schema that a file states; None where it states none.

    Raises:
        ModelError: no such file, another kind of file, or truncated.
    """
    with _opened(path) as (_, header):
        stated: str | None = header.get("schema")
    return stated


@contextmanager
def _opened(path: Path) -> Iterator[tuple[Any, dict[str, Any]]]:
    """The open file and its header."""
    if not path.is_file():
        raise ModelError(f"{path}: no such file; expected one that `artgen train` wrote")
    try:
        with safe_open(path, framework="pt") as opened:
            yield opened, json.loads((opened.metadata() or {}).get(KEY, "{}"))
    except (SafetensorError, OSError) as error:
        raise ModelError(
            f"{path}: not a whole safetensors file of {path.stat().st_size} bytes ({error}); it is "
            "truncated or of another kind; copy it again, or delete it and use an older one"
        ) from error


def _check_schema(path: Path, found: str | None, expected: str) -> None:
    if found != expected:
        raise ModelError(
            f"{path}: schema {found!r}, expected {expected!r}; the file is of another kind or of "
            "another version of artgen; use the version that wrote it, or train again"
        )


def _digest(tensors: Mapping[str, Tensor]) -> str:
    """sha256 of names, types, shapes and bytes."""
    total = hashlib.sha256()
    for name in sorted(tensors):
        tensor = tensors[name]
        total.update(f"{name} {tensor.dtype} {tuple(tensor.shape)}\n".encode())
        total.update(tensor.contiguous().reshape(-1).view(torch.uint8).numpy().tobytes())
    return total.hexdigest()
