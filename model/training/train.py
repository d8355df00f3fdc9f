"""The training loop as functions: gradients of some batches, one update, checkpoints, the log.

It trains any module that maps (batch, moment) to a table of losses with a "total".
"""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from artgen.progress import Show, silent
from model.batch import Batch
from model.training.checkpoint import checkpoint_path, prune, write_checkpoint
from model.training.distributed import averaged, local, meeting, wait_for_all, whole
from model.training.log import TrainLog
from model.training.run_state import Run, follow, snapshot
from model.training.schedule import Moment, moment_at, rate_at

Supply = Callable[[Moment, int], Iterator[Batch]]
"""Endless batches for a moment of the schedule, from a cursor on."""
Draw = Callable[[Moment], NDArray[np.uint8]]
"""A picture of what the network makes at a moment, (H, W, 3) sRGB."""


@dataclass(frozen=True, kw_only=True)
class Measured:
    """What one update saw: losses by term and length of the gradient, means over all ranks."""

    terms: Mapping[str, float]
    gradient: float


def train(
    run: Run,
    supply: Supply,
    *,
    folder: Path,
    show: Show = silent,
    draw: Draw | None = None,
) -> None:
    """Update until the last step; leaves checkpoints and the log in `folder`.

    Raises:
        ModelError: a loss or gradient that is not finite, or the data ran out; in the first case
            the weights before the failed update are saved.
    """
    log = TrainLog(folder, step=run.step) if run.team.leads else None
    try:
        with (show if log else silent)("steps", run.config.steps - run.step) as advance:
            for moment, measured in _updates(run, supply, folder):
                _record(run, moment, measured, log=log, draw=draw)
                if run.step % run.config.save_every == 0 or run.step == run.config.steps:
                    save(run, folder)
                advance(f"loss {measured.terms['total']:.4g}")
    finally:
        if log is not None:
            log.close()


def _updates(run: Run, supply: Supply, folder: Path) -> Iterator[tuple[Moment, Measured]]:
    """Make updates one by one; a new size of images opens the data anew."""
    size, batches = 0, iter(())  # type: tuple[int, Iterator[Batch]]
    while run.step < run.config.steps:
        started = time.perf_counter()
        moment = moment_at(run.config, run.step)
        if moment.target_px != size:
            size, batches = moment.target_px, supply(moment, run.cursor)
        chosen = list(islice(batches, run.config.accumulation))
        if len(chosen) < run.config.accumulation:
            raise ModelError(f"training data ended at step {run.step}; expected an endless supply")
        measured = accumulate(run, chosen, moment)
        if faults := _faults(run, measured):
            raise _stopped(run, folder, faults, chosen)
        update(run, measured)
        run.seconds += time.perf_counter() - started
        yield moment, measured


def accumulate(run: Run, batches: Sequence[Batch], moment: Moment) -> Measured:
    """Leave the mean gradient of the batches over all ranks in the weights."""
    torch.manual_seed(_seed(run))
    sums: dict[str, Tensor] = {}
    for index, batch in enumerate(batches):
        with meeting(run.held, now=index == len(batches) - 1):
            losses: dict[str, Tensor] = run.held(batch.to(run.team.device), moment)
            (losses["total"] / len(batches)).backward()  # type: ignore[no-untyped-call]
        for name, value in losses.items():
            sums[name] = sums.get(name, torch.zeros_like(value)) + value.detach() / len(batches)
    length = whole(torch.nn.utils.get_total_norm(_gradients(run)))
    means = averaged(torch.stack([sums[name].float() for name in sorted(sums)]), run.team)
    terms = dict(zip(sorted(sums), means.tolist(), strict=True))
    return Measured(terms=terms, gradient=float(length))


def _gradients(run: Run) -> list[Tensor]:
    return [weight.grad for weight in run.objective.parameters() if weight.grad is not None]


def _seed(run: Run) -> int:
    """Of every draw that one update makes on one rank; the address stands for the state."""
    stream = Stream(run.config.seed, "training", run.step, run.team.rank)
    return int(stream.generator().integers(2**63))


def update(run: Run, measured: Measured) -> None:
    """Clip the gradients that `accumulate` left, apply them, and move on."""
    if measured.gradient > run.config.clip_norm:
        scale = run.config.clip_norm / measured.gradient
        torch._foreach_mul_([local(gradient) for gradient in _gradients(run)], scale)
    for group in run.optimizer.param_groups:
        group["lr"] = rate_at(run.config, run.step)
    run.optimizer.step()
    run.optimizer.zero_grad(set_to_none=True)
    follow(run)
    run.step += 1
    run.cursor += run.items * run.config.accumulation


def save(run: Run, folder: Path, *, note: str = "") -> Path:
    """Write a checkpoint, drop the oldest; every rank must come here."""
    checkpoint = snapshot(run, note=note)
    path = checkpoint_path(folder, run.step)
    if run.team.leads:
        write_checkpoint(path, checkpoint)
        prune(folder, run.config.keep)
    wait_for_all(run.team)
    return path


def _faults(run: Run, measured: Measured) -> str:
    """Which terms are not finite, or which weights' gradients; empty if all is well."""
    bad = [
        f"loss term {name} is {value}"
        for name, value in measured.terms.items()
        if not math.isfinite(value) and name != "total"
    ]
    if not bad and not math.isfinite(measured.terms["total"]):
        bad = [f"the total loss is {measured.terms['total']} though every term is finite"]
    if not bad and not math.isfinite(measured.gradient):
        names = [
            name
            for name, weight in run.objective.named_parameters()
            if weight.grad is not None and not bool(torch.isfinite(whole(weight.grad)).all())
        ]
        bad = [f"the losses are finite, but not the gradients of {', '.join(names[:3])}"]
    return "; ".join(bad)


def _stopped(run: Run, folder: Path, faults: str, batches: Sequence[Batch]) -> ModelError:
    """Save the weights as they were before the failed update, and say what happened."""
    path = folder / "stopped" / f"step_{run.step:08d}.safetensors"
    checkpoint = snapshot(run, note=faults)
    if run.team.leads:
        write_checkpoint(path, checkpoint)
    names = ", ".join(name for batch in batches for name in batch.asset_ids)
    return ModelError(
        f"training stopped at step {run.step}: {faults}; the weights before it are in {path}; "
        f"objects of the step: {names or 'not named'}. Look at those objects, lower the learning "
        "rate, or lower the weight of that term, and train into a new folder from these weights: "
        f"--start {path}"
    )


def _record(
    run: Run,
    moment: Moment,
    measured: Measured,
    *,
    log: TrainLog | None,
    draw: Draw | None,
) -> None:
    """Write what is due after this update, on the rank that leads."""
    config = run.config
    if log is not None and (run.step % config.log_every == 0 or run.step == config.steps):
        values = {
            **measured.terms,
            "gradient": measured.gradient,
            "rate": rate_at(config, moment.step),
            "inverse_beta": moment.inverse_beta,
            "seconds": run.seconds,
        }
        log.write(run.step, values)
    due = config.picture_every and run.step % config.picture_every == 0
    if log is not None and draw is not None and due:
        log.picture(run.step, draw(moment))
