"""Two processes train as one with twice the batch."""

import os
import socket
from pathlib import Path

import pytest
import torch

from artgen.core.errors import ModelError
from model.training.checkpoint import Checkpoint, found_checkpoints, read_checkpoint
from model.training.distributed import Plan, joined
from model.training.log import read_lines
from model.training.run_state import resume
from model.training.train import train
from tests.unit.model.tiny_run import CONFIG, STEPS, exit_status, tiny_run, tiny_supply

EPS = torch.finfo(torch.float64).eps


def port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def train_as(rank: int, world: int, *, place: str, plan: Plan, folder: Path) -> None:
    """One rank of a run in float64."""
    os.environ.update(
        RANK=str(rank),
        LOCAL_RANK=str(rank),
        WORLD_SIZE=str(world),
        MASTER_ADDR="127.0.0.1",
        MASTER_PORT=place,
    )
    torch.set_default_dtype(torch.float64)
    with joined(os.environ, device="cpu", plan=plan) as team:
        run = tiny_run(noise=0.0, team=team)
        resume(run, folder)
        train(run, tiny_supply(team), folder=folder)


def train_with(world: int, folder: Path, *, plan: Plan = "replicas") -> Checkpoint:
    place = str(port())

    def ranks() -> None:
        statuses = []
        if world == 2:
            other = os.fork()
            if other == 0:
                torch.set_num_threads(1)
                train_as(1, world, place=place, plan=plan, folder=folder)
                os._exit(0)
        train_as(0, world, place=place, plan=plan, folder=folder)
        if world == 2:
            statuses.append(os.waitstatus_to_exitcode(os.waitpid(other, 0)[1]))
        if any(statuses):
            raise RuntimeError(f"rank 1 ended with {statuses}")

    assert exit_status(ranks) == 0
    return read_checkpoint(found_checkpoints(folder)[-1])


def assert_equal_but_for_roundings(a: Checkpoint, b: Checkpoint) -> None:
    """Gradients differ by the roundings of sums in another order: at most 100 eps, as no summand
    exceeds 10 and a handful are summed. AdamW divides by the gradient's own size or, where that is
    smaller, by its eps of 1e-8: one update moves apart by at most rate * 100 eps / 1e-8, and the
    next gradients by as much again. Six updates at 0.01: 6 * 2 * 0.01 * 2.2e-6 = 2.7e-7."""
    bound = STEPS * 2 * CONFIG.learning_rate * 100 * EPS / 1e-8
    assert (a.step, a.cursor) == (b.step, b.cursor)
    for name in b.weights:
        assert torch.allclose(a.weights[name], b.weights[name], rtol=0.0, atol=bound)
        assert torch.allclose(a.average[name], b.average[name], rtol=0.0, atol=bound)


@pytest.mark.parametrize("plan", ["replicas", "shards"])
def test_two_processes_equal_one_with_the_whole_batch(tmp_path: Path, plan: Plan) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    assert_equal_but_for_roundings(train_with(2, two, plan=plan), train_with(1, one))
    for ours, theirs in zip(
        read_lines(two / "log.jsonl"), read_lines(one / "log.jsonl"), strict=True
    ):
        for key in ("step", "base", "door", "total", "gradient", "rate"):
            assert ours[key] == pytest.approx(theirs[key], rel=1e-5)


def test_shards_of_two_processes_resume_in_one(tmp_path: Path) -> None:
    """A checkpoint does not know how many processes wrote it."""
    two = train_with(2, tmp_path / "two", plan="shards")
    checkpoints = found_checkpoints(tmp_path / "two")
    checkpoints[-1].unlink()
    assert checkpoints[0].name == "step_00000004.safetensors"
    assert_equal_but_for_roundings(train_with(1, tmp_path / "two"), two)


def test_one_process_alone_is_a_team(tmp_path: Path) -> None:
    with joined({}, device="cpu") as team:
        assert (team.rank, team.world, team.leads) == (0, 1, True)


def test_a_missing_gpu_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    with pytest.raises(ModelError, match="no GPU"), joined({}, device="cuda"):
        pass
