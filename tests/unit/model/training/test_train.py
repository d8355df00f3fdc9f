"""The training loop: it learns, resumes to the bit, and stops where numbers fail."""

import dataclasses
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.batch import Batch
from model.training.checkpoint import Checkpoint, found_checkpoints, read_checkpoint
from model.training.log import read_lines
from model.training.run_state import begun
from model.training.schedule import Moment, moment_at
from model.training.train import accumulate, train, update
from tests.unit.model.tiny_run import (
    CONFIG,
    ITEMS,
    STEPS,
    TinyObjective,
    exit_status,
    tiny_batch,
    tiny_run,
    tiny_supply,
    trained,
)


def assert_same_bits(a: Checkpoint, b: Checkpoint) -> None:
    assert (a.step, a.cursor) == (b.step, b.cursor)
    for name in a.weights:
        assert torch.equal(a.weights[name], b.weights[name])
        assert torch.equal(a.average[name], b.average[name])
    assert a.moments.keys() == b.moments.keys()
    for name, kinds in a.moments.items():
        for kind, value in kinds.items():
            assert torch.equal(value, b.moments[name][kind])


@pytest.mark.parametrize("killed_at", range(STEPS))
def test_a_run_killed_at_any_step_resumes_to_equal_bits(tmp_path: Path, killed_at: int) -> None:
    def killing(moment: Moment, cursor: int) -> Iterator[Batch]:
        for batch in tiny_supply()(moment, cursor):
            if batch.asset_ids[0] == f"box_{killed_at * ITEMS * CONFIG.accumulation}":
                os.kill(os.getpid(), signal.SIGKILL)
            yield batch

    killed = exit_status(lambda: train(tiny_run(), killing, folder=tmp_path / "killed"))
    assert killed == -signal.SIGKILL
    assert_same_bits(trained(tmp_path / "killed"), trained(tmp_path / "whole"))
    steps = [line["step"] for line in read_lines(tmp_path / "killed" / "log.jsonl")]
    assert steps == list(range(1, STEPS + 1))


def test_a_run_killed_while_it_saves_resumes_to_equal_bits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flushed = list[int]()

    def half_flushed(file: int) -> None:
        flushed.append(file)
        if len(flushed) == 2:
            os.ftruncate(file, os.fstat(file).st_size // 2)
            os.kill(os.getpid(), signal.SIGKILL)

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", half_flushed)
        assert exit_status(lambda: trained(tmp_path / "killed")) == -signal.SIGKILL
    assert [path.name for path in found_checkpoints(tmp_path / "killed")] == [
        "step_00000002.safetensors"
    ]
    assert list((tmp_path / "killed" / "checkpoints").glob("step_00000004*"))
    assert_same_bits(trained(tmp_path / "killed"), trained(tmp_path / "whole"))


def test_a_finished_run_makes_no_more_updates(tmp_path: Path) -> None:
    first = trained(tmp_path)
    assert_same_bits(trained(tmp_path), first)


def test_other_settings_do_not_resume(tmp_path: Path) -> None:
    trained(tmp_path)
    with pytest.raises(ModelError, match=r"train\.steps 6, now 7"):
        trained(tmp_path, dataclasses.replace(CONFIG, steps=7))


def test_accumulated_batches_equal_one_large_batch() -> None:
    """The mean of two batches' mean losses is the mean over both: float64 sums of 8 numbers in
    another order differ by 8 eps of the largest, here below 10."""
    torch.set_default_dtype(torch.float64)
    try:
        halves = [tiny_batch(0, first=0, count=2), tiny_batch(0, first=2, count=2)]
        moment = moment_at(CONFIG, 0)
        one, two = tiny_run(noise=0.0), tiny_run(noise=0.0)
        measured = accumulate(one, [tiny_batch(0)], moment), accumulate(two, halves, moment)
    finally:
        torch.set_default_dtype(torch.float32)
    bound = 8 * 10 * torch.finfo(torch.float64).eps
    assert measured[0].terms == pytest.approx(measured[1].terms, abs=bound)
    for a, b in zip(one.objective.parameters(), two.objective.parameters(), strict=True):
        if a.grad is not None and b.grad is not None:
            assert torch.allclose(a.grad, b.grad, rtol=0.0, atol=bound)


def test_gradients_are_clipped_to_the_stated_length() -> None:
    """After one update AdamW's first moment is (1 - 0.9) times the clipped gradient, whose length
    is exact to the roundings of some hundred float32 squares."""
    run = tiny_run(noise=0.0)
    measured = accumulate(run, [tiny_batch(0)], moment_at(CONFIG, 0))
    assert measured.gradient > CONFIG.clip_norm
    update(run, measured)
    moments = [state["exp_avg"].double() for state in run.optimizer.state.values()]
    length = sum(float(moment.square().sum()) for moment in moments) ** 0.5
    assert length == pytest.approx(0.1 * CONFIG.clip_norm, rel=1e-5)


def test_the_average_follows_the_weights_by_its_decay() -> None:
    """After one update from equal starts: average = old + (1 - d) (new - old), d = min(decay,
    1 / 10); one float32 rounding each of values below 1."""
    run = tiny_run()
    before = {name: value.clone() for name, value in run.objective.state_dict().items()}
    update(run, accumulate(run, [tiny_batch(0)], moment_at(CONFIG, 0)))
    for name, new in run.objective.state_dict().items():
        expected = before[name] + 0.9 * (new - before[name])
        assert torch.allclose(run.average[name], expected, rtol=0.0, atol=4e-7)


class Failing(TinyObjective):
    """Its door term, or only the gradient of that, turns into no number at step 3."""

    def __init__(self, *, in_gradient: bool) -> None:
        super().__init__()
        self.in_gradient = in_gradient

    def forward(self, batch: Batch, moment: Moment) -> dict[str, Tensor]:
        losses = super().forward(batch, moment)
        bias = self.get_parameter("blocks.0.bias")
        if moment.step == 3:
            zero = 0.0 * bias.sum()
            fault = zero.abs().sqrt() if self.in_gradient else zero / zero
            losses |= {"door": losses["door"] + fault, "total": losses["total"] + fault}
        return losses


@pytest.mark.parametrize(
    ("in_gradient", "said"),
    [(False, "loss term door is nan"), (True, r"not the gradients of blocks\.0\.bias")],
)
def test_what_is_no_number_stops_saves_and_is_named(
    tmp_path: Path, in_gradient: bool, said: str
) -> None:
    torch.manual_seed(0)
    run = begun(Failing(in_gradient=in_gradient), CONFIG, items=ITEMS)
    with pytest.raises(ModelError, match=said) as caught:
        train(run, tiny_supply(), folder=tmp_path)
    assert "box_24" in str(caught.value)
    saved = read_checkpoint(tmp_path / "stopped" / "step_00000003.safetensors")
    assert saved.step == 3
    assert all(bool(torch.isfinite(weight).all()) for weight in saved.weights.values())
    assert [path.name for path in found_checkpoints(tmp_path)] == ["step_00000002.safetensors"]


def test_data_that_end_are_an_error(tmp_path: Path) -> None:
    def short(moment: Moment, cursor: int) -> Iterator[Batch]:
        yield tiny_batch(cursor)

    with pytest.raises(ModelError, match="ended at step 0"):
        train(tiny_run(), short, folder=tmp_path)
