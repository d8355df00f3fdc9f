"""Two processes train as one with twice the batch."""

import os
import socket
import warnings
from collections.abc import Callable, Iterator
from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
import torch
import torch._dynamo  # Sharding asks for it: once here, not in every forked rank.
from torch.distributed import ProcessGroup

import model.training.objective
import model.training.session
from artgen.core.errors import ModelError
from artgen.progress import silent
from model.batch import Batch
from model.data.items import Source
from model.data.loader import batches
from model.training.art_file import load_art
from model.training.checkpoint import Checkpoint, found_checkpoints, read_checkpoint
from model.training.distributed import PATIENCE, TIMEOUT, Plan, Team, joined, wait_for_leader
from model.training.log import read_lines
from model.training.material import Material
from model.training.run_state import resume
from model.training.session import RESULT, run_session
from model.training.settings import changed
from model.training.train import train
from tests.unit.model.tiny_run import CONFIG, STEPS, exit_status, tiny_run, tiny_supply
from tests.unit.model.tiny_session import TINY, laptop_material

EPS = torch.finfo(torch.float64).eps
CPU = torch.device("cpu")


def port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def join_as(rank: int, world: int, place: str) -> None:
    """Be one rank, in float64, until this process ends."""
    os.environ.update(
        RANK=str(rank),
        LOCAL_RANK=str(rank),
        WORLD_SIZE=str(world),
        MASTER_ADDR="127.0.0.1",
        MASTER_PORT=place,
    )
    torch.set_default_dtype(torch.float64)


def train_as(team: Team, folder: Path) -> None:
    """A rank of a run of the tiny network."""
    run = tiny_run(noise=0.0, team=team)
    resume(run, folder)
    train(run, tiny_supply(team), folder=folder)


def in_processes(world: int, work: Callable[[], object]) -> None:
    """Let every rank do the work, each in a process of its own."""
    place = str(port())

    def ranks() -> None:
        other = os.fork() if world == 2 else 0
        if world == 2 and other == 0:
            torch.set_num_threads(1)
        join_as(int(world == 2 and other == 0), world, place)
        work()
        if world == 2 and other == 0:
            os._exit(0)
        if world == 2 and (status := os.waitstatus_to_exitcode(os.waitpid(other, 0)[1])):
            raise RuntimeError(f"rank 1 ended with {status}")

    assert exit_status(ranks) == 0


def train_with(world: int, folder: Path, *, plan: Plan = "replicas") -> Checkpoint:
    def work() -> None:
        with joined(os.environ, device="cpu", plan=plan) as team:
            train_as(team, folder)

    in_processes(world, work)
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
    assert_same_losses(two, one)


def test_shards_of_two_processes_resume_in_one(tmp_path: Path) -> None:
    """A checkpoint does not know how many processes wrote it."""
    two = train_with(2, tmp_path / "two", plan="shards")
    checkpoints = found_checkpoints(tmp_path / "two")
    checkpoints[-1].unlink()
    assert checkpoints[0].name == "step_00000004.safetensors"
    assert_equal_but_for_roundings(train_with(1, tmp_path / "two"), two)


REAL = changed(
    TINY,
    [
        *("model.trunk.blocks=4", "model.trunk.scope=alternate", "model.trunk.shared_mlp=true"),
        *("model.slot_embedding=shared", "model.planes.tokens=planes", "model.planes.grid=2"),
        *("model.planes.scale=4", "model.images.encoder=conv", "train.steps=2"),
        *("train.rendered=0.5", "train.save_every=1", "train.picture_every=0"),
    ],
)
"""Shaped as `s`; the first update has no rendering, so that its fields and planes get no slope."""


def doubled(source: Source[Any], *args: Any, **place: Any) -> Iterator[Batch]:
    """Batches cast in float32, as ever, handed on in float64."""
    made = batches(source, *args, **place)
    while True:
        torch.set_default_dtype(torch.float32)
        batch = next(made)
        torch.set_default_dtype(torch.float64)
        yield batch.mapped(lambda x: x.double() if x.is_floating_point() else x)


def session_with(
    world: int, folder: Path, material: Material, *, plan: Plan = "replicas"
) -> list[Checkpoint]:
    """Both checkpoints of a whole session, samples along rays at their middles."""

    def work() -> None:
        warnings.filterwarnings("error", message=".*returned a view tensor")
        model.training.session.batches = doubled  # type: ignore[assignment]
        model.training.objective._generator = lambda device: None  # type: ignore[assignment]
        world_of = {"environment": os.environ, "device": "cpu", "plan": plan, "show": silent}
        run_session(REAL, material, folder, **world_of)  # type: ignore[arg-type]

    in_processes(world, work)
    return [read_checkpoint(path) for path in found_checkpoints(folder)]


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Material, list[Checkpoint]]:
    """One process with two laptops, so that both ranks of two have as many parts to average."""
    folder = tmp_path_factory.mktemp("alone")
    material = laptop_material(folder)
    return folder / "run", material, session_with(1, folder / "run", material)


@pytest.mark.parametrize("plan", ["replicas", "shards"])
def test_two_processes_train_the_real_network_as_one_does(
    tmp_path: Path, alone: tuple[Path, Material, list[Checkpoint]], plan: Plan
) -> None:
    """Gradients of length 1 at most after clipping, sums of some thousand products in another
    order: 1000 eps apart at most (seen: 8). By the argument above, two updates at the peak rate
    then move weights apart by 2 * 2 * rate * 1000 eps / 1e-8, a fifty-thousandth of an update."""
    place, material, one = alone
    two = session_with(2, tmp_path, material, plan=plan)
    for ours, theirs in zip(two, one, strict=True):
        assert ours.moments.keys() == theirs.moments.keys()
        bound = 4 * REAL.train.learning_rate * 1000 * EPS / 1e-8
        for name, weight in theirs.weights.items():
            assert torch.allclose(ours.weights[name], weight, rtol=0.0, atol=bound), name
            average = theirs.average[name]
            assert torch.allclose(ours.average[name], average, rtol=0.0, atol=bound), name
    for name, kinds in one[0].moments.items():
        ours = two[0].moments[name]["exp_avg"]
        assert torch.allclose(ours, kinds["exp_avg"], rtol=0.0, atol=1000 * EPS), name
    assert_same_losses(tmp_path, place)
    art, config, _ = load_art(tmp_path / RESULT)
    assert config == REAL
    shipped = {f"art.{name}": value for name, value in art.state_dict().items()}
    for name, average in two[-1].average.items():
        assert torch.equal(shipped[name], average.to(shipped[name].dtype)), name


def assert_same_losses(one: Path, other: Path) -> None:
    """Line by line; the log holds float32."""
    lines = [read_lines(folder / "log.jsonl") for folder in (one, other)]
    for ours, theirs in zip(*lines, strict=True):
        assert ours.keys() == theirs.keys()
        for key in ours.keys() - {"seconds"}:
            assert ours[key] == pytest.approx(theirs[key], rel=1e-5)


def test_ranks_wait_for_the_leader_longer_than_for_each_other() -> None:
    """Making thousands of objects takes it longer than the limit at which a rank counts as dead."""

    def limit(group: ProcessGroup | None) -> timedelta | None:
        return None if group is None else group._get_backend(CPU).options._timeout

    def work() -> None:
        with joined(os.environ, device="cpu") as team:
            assert limit(team.patient) == PATIENCE
            assert limit(torch.distributed.group.WORLD) == TIMEOUT
            wait_for_leader(team)

    in_processes(2, work)
    wait_for_leader(Team())


def test_one_process_alone_is_a_team(tmp_path: Path) -> None:
    with joined({}, device="cpu") as team:
        assert (team.rank, team.world, team.leads) == (0, 1, True)


def test_a_missing_gpu_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    with pytest.raises(ModelError, match="no GPU"), joined({}, device="cuda"):
        pass
