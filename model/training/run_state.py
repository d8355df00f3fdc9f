"""The state of a training run between two updates, to and from a checkpoint."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from artgen.core.errors import ModelError
from model.training.checkpoint import Checkpoint, check_weights, found_checkpoints, read_checkpoint
from model.training.distributed import Team, local, share_of, shared, whole
from model.training.schedule import TrainConfig


@dataclass(kw_only=True)
class Run:
    """A training run between two updates.

    Attributes:
        objective: (batch, moment) -> losses by term, their sum under "total".
        held: the same module as the team holds it.
        average: moving average of what `trained_state` names.
        items: training items a batch, over all ranks.
        settings: the whole configuration as JSON values, for checkpoints.
        step: updates made.
        cursor: training items consumed by all ranks.
        seconds: time spent on updates so far.
    """

    config: TrainConfig
    team: Team
    objective: nn.Module
    held: nn.Module
    optimizer: torch.optim.AdamW
    average: dict[str, Tensor]
    items: int
    settings: Mapping[str, Any] = field(default_factory=dict)
    step: int = 0
    cursor: int = 0
    seconds: float = 0.0


def begun(
    objective: nn.Module,
    config: TrainConfig,
    *,
    items: int,
    team: Team | None = None,
    settings: Mapping[str, Any] | None = None,
) -> Run:
    """A run before its first update."""
    team = team or Team()
    objective.to(team.device)
    held = shared(objective, team)
    return Run(
        config=config,
        team=team,
        objective=objective,
        held=held,
        optimizer=_optimizer(objective, config, team),
        average={name: tensor.clone() for name, tensor in trained_state(objective).items()},
        items=items,
        settings=settings or {},
    )


def _optimizer(objective: nn.Module, config: TrainConfig, team: Team) -> torch.optim.AdamW:
    trained = [weight for weight in objective.parameters() if weight.requires_grad]
    groups = [
        {"params": [w for w in trained if w.ndim >= 2], "weight_decay": config.weight_decay},
        {"params": [w for w in trained if w.ndim < 2], "weight_decay": 0.0},
    ]
    return torch.optim.AdamW(
        [group for group in groups if group["params"]],
        lr=config.learning_rate,
        betas=config.betas,
        fused=team.device.type == "cuda",
    )


def trained_state(module: nn.Module) -> dict[str, Tensor]:
    """Weights and buffers by name, without sub-modules whose weights are all frozen."""
    frozen = tuple(
        f"{name}."
        for name, child in module.named_modules()
        if name and (weights := list(child.parameters()))
        if not any(weight.requires_grad for weight in weights)
    )
    return {
        name: tensor.detach()
        for name, tensor in module.state_dict().items()
        if not name.startswith(frozen)
    }


def follow(run: Run) -> None:
    """Move the average towards the weights; early on it follows faster."""
    decay = min(run.config.ema_decay, (1.0 + run.step) / (10.0 + run.step))
    averages, weights = [], []
    for name, tensor in trained_state(run.objective).items():
        average = local(run.average[name])
        if tensor.is_floating_point():
            averages.append(average)
            weights.append(local(tensor))
        else:
            average.copy_(local(tensor))
    torch._foreach_lerp_(averages, weights, 1.0 - decay)


def _names(run: Run) -> dict[Tensor, str]:
    return {weight: name for name, weight in run.objective.named_parameters()}


def snapshot(run: Run, *, note: str = "") -> Checkpoint:
    """The run as a checkpoint; with shards every rank must ask at once."""
    names = _names(run)
    return Checkpoint(
        weights={name: whole(tensor) for name, tensor in trained_state(run.objective).items()},
        average={name: whole(tensor) for name, tensor in run.average.items()},
        moments={
            names[weight]: {kind: whole(value) for kind, value in kinds.items()}
            for weight, kinds in run.optimizer.state.items()
        },
        step=run.step,
        cursor=run.cursor,
        seconds=run.seconds,
        config=run.settings,
        note=note,
    )


def restore(run: Run, checkpoint: Checkpoint, path: Path) -> None:
    """Put a begun run where a checkpoint left it; `path` is for messages.

    Raises:
        ModelError: its weights do not fit the run's network.
    """
    state = trained_state(run.objective)
    check_weights(path, checkpoint.weights, state)
    check_weights(path, checkpoint.average, state)
    for name, tensor in state.items():
        local(tensor).copy_(local(share_of(checkpoint.weights[name], tensor)))
        local(run.average[name]).copy_(local(share_of(checkpoint.average[name], tensor)))
    _restore_moments(run, checkpoint)
    run.step, run.cursor, run.seconds = checkpoint.step, checkpoint.cursor, checkpoint.seconds


def resume(run: Run, folder: Path) -> None:
    """Put a begun run where the folder's newest checkpoint left it; unchanged where there is none.

    Raises:
        ModelError: that file is damaged, or was made under other settings.
    """
    found = found_checkpoints(folder)
    if not found:
        return
    checkpoint = read_checkpoint(found[-1])
    if changed := differences(checkpoint.config, run.settings):
        raise ModelError(
            f"{found[-1]}: was made under other settings: {'; '.join(changed[:5])}; give the same "
            "ones to resume, or choose another folder"
        )
    restore(run, checkpoint, found[-1])


def differences(theirs: object, ours: object, where: str = "") -> list[str]:
    """Where two JSON values differ, as `key: theirs, now ours`."""
    if isinstance(theirs, Mapping) and isinstance(ours, Mapping):
        return [
            line
            for key in sorted({*theirs, *ours})
            for line in differences(theirs.get(key), ours.get(key), f"{where}.{key}".lstrip("."))
        ]
    return [] if theirs == ours else [f"{where} {theirs!r}, now {ours!r}"]


def _restore_moments(run: Run, checkpoint: Checkpoint) -> None:
    names = _names(run)
    ordered = [weight for group in run.optimizer.param_groups for weight in group["params"]]
    state = {
        index: {
            kind: share_of(value, weight) if value.ndim else value
            for kind, value in checkpoint.moments[names[weight]].items()
        }
        for index, weight in enumerate(ordered)
        if names[weight] in checkpoint.moments
    }
    groups = run.optimizer.state_dict()["param_groups"]
    run.optimizer.load_state_dict({"state": state, "param_groups": groups})
