"""A trained network in one file, to ship: weights, settings and model card."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Literal

import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.config import Config
from model.network.art import Art
from model.tensor_file import read_tensors, write_tensors
from model.training.checkpoint import check_weights
from model.training.run_state import trained_state

SCHEMA = "artgen-art/1"
Stored = Literal["float32", "float16"]
SHIPPED_BYTES = 29_000_000
"""Of weights; the header takes some thousand more."""


@dataclass(frozen=True, kw_only=True)
class ModelCard:
    """Where weights come from and what they can do.

    Attributes:
        data: what it was trained on: categories, seeds, objects, sources.
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
        encoder: where a frozen encoder's weights lie on this machine, as `ImageTokens.encoder`;
            as the settings say if not given.

    Raises:
        ModelError: missing, truncated, damaged, of another schema or network; or the encoder's
            weights are not those that it was trained with.
    """
    tensors, meaning = read_tensors(path, schema=SCHEMA)
    config = Config.from_json(json.dumps(meaning["config"]))
    if encoder is not None:
        images = replace(config.model.images, encoder=encoder)
        config = replace(config, model=replace(config.model, images=images))
    art = Art(config.model)
    if art.encoder_identity != meaning["encoder"]:
        raise ModelError(
            f"{path}: was trained with the encoder {meaning['encoder']!r}, found "
            f"{art.encoder_identity!r}; name the folder or file of those weights"
        )
    load_weights(art, tensors, path)
    return art.eval(), config, _card(path, meaning["card"])


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
