"""Checkpoints of a training run: everything that the next update depends on.

Weights, their moving average, AdamW's moments, the step and the sampler's cursor are stored. Random
states are not: every draw of update k follows from (seed, k, rank), so the step stands for them.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from torch import Tensor

from artgen.core.errors import ModelError
from model.tensor_file import read_tensors, write_tensors

SCHEMA = "artgen-training/1"
NAME = re.compile(r"step_(\d{8})\.safetensors")


@dataclass(frozen=True, kw_only=True)
class Checkpoint:
    """A training run between two updates, on the CPU.

    Attributes:
        weights: of the network by name, frozen ones left out.
        average: their moving average.
        moments: AdamW's state, by weight's name and then by kind.
        step: updates made.
        cursor: training items consumed by all ranks.
        seconds: time spent so far.
        config: of the run, JSON.
        note: why it was written where that is not routine.
    """

    weights: Mapping[str, Tensor]
    average: Mapping[str, Tensor]
    moments: Mapping[str, Mapping[str, Tensor]]
    step: int
    cursor: int
    seconds: float
    config: Mapping[str, Any]
    note: str = ""


def checkpoint_path(folder: Path, step: int) -> Path:
    """Where a run's folder keeps the checkpoint after `step` updates."""
    return folder / "checkpoints" / f"step_{step:08d}.safetensors"


def write_checkpoint(path: Path, checkpoint: Checkpoint) -> None:
    """Write it whole or not at all."""
    tensors = {
        **{f"weights.{name}": tensor for name, tensor in checkpoint.weights.items()},
        **{f"average.{name}": tensor for name, tensor in checkpoint.average.items()},
        **{
            f"moments.{kind}.{name}": tensor
            for name, kinds in checkpoint.moments.items()
            for kind, tensor in kinds.items()
        },
    }
    meaning = {
        "step": checkpoint.step,
        "cursor": checkpoint.cursor,
        "seconds": checkpoint.seconds,
        "config": checkpoint.config,
        "note": checkpoint.note,
    }
    write_tensors(path, tensors, schema=SCHEMA, meaning=meaning)


def read_checkpoint(path: Path) -> Checkpoint:
    """The checkpoint in a file.

    Raises:
        ModelError: missing, truncated, damaged, or of another schema.
    """
    tensors, meaning = read_tensors(path, schema=SCHEMA)
    moments: dict[str, dict[str, Tensor]] = {}
    for key, tensor in _below(tensors, "moments.").items():
        kind, name = key.split(".", 1)
        moments.setdefault(name, {})[kind] = tensor
    return Checkpoint(
        weights=_below(tensors, "weights."),
        average=_below(tensors, "average."),
        moments=moments,
        step=int(meaning["step"]),
        cursor=int(meaning["cursor"]),
        seconds=float(meaning["seconds"]),
        config=meaning["config"],
        note=meaning["note"],
    )


def _below(tensors: Mapping[str, Tensor], prefix: str) -> dict[str, Tensor]:
    return {
        name.removeprefix(prefix): tensor
        for name, tensor in tensors.items()
        if name.startswith(prefix)
    }


def found_checkpoints(folder: Path) -> list[Path]:
    """Checkpoints of a run's folder, oldest first."""
    found = (folder / "checkpoints").glob("step_*")
    return sorted(path for path in found if NAME.fullmatch(path.name))


def prune(folder: Path, keep: int) -> None:
    """Delete all but the newest checkpoints."""
    for path in found_checkpoints(folder)[:-keep]:
        path.unlink()


def check_weights(path: Path, found: Mapping[str, Tensor], expected: Mapping[str, Tensor]) -> None:
    """Raise ModelError unless both have the same names and shapes."""
    for name in sorted({*found, *expected}):
        ours = tuple(expected[name].shape) if name in expected else None
        theirs = tuple(found[name].shape) if name in found else None
        if ours != theirs:
            raise ModelError(
                f"{path}: weight {name} has shape {theirs}, the network of this configuration "
                f"expects {ours} (None: absent); use the configuration that the file was made with"
            )
