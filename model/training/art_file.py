"""A trained network in one file, to ship: weights, settings and model card.

The checkpoints of a training run are read as well: as the network of their averaged weights.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.config import Config
from model.network.art import Art
from model.tensor_file import read_schema, read_tensors, write_tensors
from model.training import checkpoint
from model.training.checkpoint import check_weights, read_checkpoint
from model.training.run_state import trained_state

SCHEMA = "artgen-art/1"
Stored = Literal["float32", "float16"]
SHIPPED_BYTES = 29_000_000
"""Of weights; the header takes some thousand more."""


@dataclass(frozen=True, kw_only=True)
class ModelCard:
    """Where weights come from and what they can do.

    Attributes:
        data: what it was trained on: categories, seeds, objects, sources; `begun_with` has the same
            of the file whose weights it began with.
        steps: updates.
        hours: of training, wall clock.
        hardware: what it was trained on.
        metrics: measured on held-out objects; not measured ones are left out.
        limits: what it cannot do, one sentence each.
    """

    data: Mapping[str, object] = field(default_factory=dict)
    steps: int = 0
    hours: float = 0.0
    hardware: str = ""
    metrics: Mapping[str, float] = field(default_factory=dict)
    limits: tuple[str, ...] = ()


def save_art(
    path: Path,
    art: Art,
    config: Config,
    card: ModelCard,
    *,
    weights: Mapping[str, Tensor] | None = None,
    stored: Stored = "float32",
) -> None:
    """Write the network; a frozen encoder's weights stay in the files they came from.

    Args:
        weights: by name, instead of the network's own, such as their moving average.
        stored: type of the weights in the file; float16 halves it and rounds them to 11 bits.
    """
    state = trained_state(art)
    chosen = state if weights is None else weights
    check_weights(path, chosen, state)
    kind = getattr(torch, stored)
    written = {
        name: tensor.to(kind) if tensor.is_floating_point() else tensor
        for name, tensor in chosen.items()
    }
    meaning = {
        "config": json.loads(config.to_json()),
        "card": asdict(card),
        "encoder": art.encoder_identity,
    }
    write_tensors(path, written, schema=SCHEMA, meaning=meaning)


def load_art(path: Path, *, encoder: str | None = None) -> tuple[Art, Config, ModelCard]:
    """The network of a file, for inference, in float32 on the CPU.

    Args:
        path: of what `save_art` wrote, or of a checkpoint of `artgen train`.
        encoder: where a frozen encoder's weights lie on this machine, as `ImageTokens.encoder`;
            as the settings say if not given.

    Raises:
        ModelError: missing, truncated, damaged, of another schema or network; or the encoder's
            weights are not those that it was trained with.
    """
    stored = READERS.get(read_schema(path) or "", _shipped)(path)
    config = Config.from_json(json.dumps(stored.config))
    if encoder is not None:
        images = replace(config.model.images, encoder=encoder)
        config = replace(config, model=replace(config.model, images=images))
    art = Art(config.model)
    if art.encoder_identity != stored.encoder:
        raise ModelError(
            f"{path}: was trained with the encoder {stored.encoder!r}, found "
            f"{art.encoder_identity!r}; name the folder or file of those weights"
        )
    load_weights(art, stored.weights, path)
    return art.eval(), config, stored.card


@dataclass(frozen=True, kw_only=True)
class _Stored:
    """What a file holds; the configuration as JSON values."""

    weights: Mapping[str, Tensor]
    config: Mapping[str, Any]
    encoder: str
    card: ModelCard


def _shipped(path: Path) -> _Stored:
    tensors, meaning = read_tensors(path, schema=SCHEMA)
    card = _card(path, meaning["card"])
    return _Stored(weights=tensors, config=meaning["config"], encoder=meaning["encoder"], card=card)


def _averaged(path: Path) -> _Stored:
    """The moving average in a checkpoint, as far as training had come."""
    found = read_checkpoint(path)
    config = found.config.get("config")
    if config is None:
        raise ModelError(
            f"{path}: a checkpoint that does not state its network; give one of `artgen train`"
        )
    limits = [f"Read from a checkpoint: {found.step} of {config['train']['steps']} updates."]
    if found.note:
        limits.append(f"Training stopped there: {found.note}.")
    return _Stored(
        weights=network_weights(found.average),
        config=config,
        encoder=found.config.get("inputs", {}).get("encoder", ""),
        card=ModelCard(
            data={"seen": found.cursor},
            steps=found.step,
            hours=found.seconds / 3600.0,
            limits=tuple(limits),
        ),
    )


READERS: Mapping[str, Callable[[Path], _Stored]] = {
    SCHEMA: _shipped,
    checkpoint.SCHEMA: _averaged,
}
"""By the schema that a file states."""


def network_weights(state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Weights by the network's own names, out of those of what training minimizes."""
    return {name.removeprefix("art."): tensor for name, tensor in state.items()}


def stored_type(weights: Mapping[str, Tensor]) -> Stored:
    """The larger type of weights with which a file stays below 30 MB, if any does."""
    numbers = sum(value.numel() for value in weights.values())
    return "float32" if 4 * numbers < SHIPPED_BYTES else "float16"


def load_weights(art: Art, tensors: Mapping[str, Tensor], path: Path) -> None:
    """Put weights by name into a network; `path` is for messages.

    Raises:
        ModelError: names or shapes are not the network's.
    """
    state = trained_state(art)
    check_weights(path, tensors, state)
    for name, tensor in state.items():
        tensor.copy_(tensors[name])


def _card(path: Path, found: Mapping[str, object]) -> ModelCard:
    try:
        card = ModelCard(**found)  # type: ignore[arg-type]
    except TypeError as error:
        raise ModelError(f"{path}: its model card is of another version ({error})") from error
    return ModelCard(**{**asdict(card), "limits": tuple(card.limits)})


def carded(card: ModelCard, *, metrics: Path | None, limits: tuple[str, ...] = ()) -> ModelCard:
    """The card with the means of an evaluation, and with further limits.

    Args:
        metrics: evaluation.json of `artgen evaluate`.

    Raises:
        ModelError: that file is missing or of another kind.
    """
    measured = dict(card.metrics)
    if metrics is not None:
        measured |= _means(metrics)
    return replace(card, metrics=measured, limits=(*card.limits, *limits))


def _means(path: Path) -> dict[str, float]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        overall = found["summary"]["overall"]
        means = {name: entry["mean"] for name, entry in overall.items()}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ModelError(
            f"{path}: cannot be read as an evaluation ({error!r}); give the evaluation.json that "
            "`artgen evaluate` writes"
        ) from error
    return {name: float(mean) for name, mean in means.items() if mean is not None}
