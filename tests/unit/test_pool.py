"""A process that dies costs its own task alone, after a second try; so does a fault, at once."""

import errno
import os
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from artgen.pool import ATTEMPTS, run_in_processes


@dataclass(frozen=True)
class Sum:
    asset_id: str
    deed: str
    place: str


def _nothing() -> None:
    os.environ["STARTED"] = "1"


def work(task: Sum) -> str:
    tried = Path(task.place) / task.asset_id
    tried.write_text(tried.read_text() + "x" if tried.exists() else "x")
    if task.deed == "die" or (task.deed == "die once" and tried.read_text() == "x"):
        os.kill(os.getpid(), signal.SIGKILL)
    if task.deed == "hang":
        time.sleep(60)
    if task.deed == "raise":
        raise RuntimeError("from a library")
    if task.deed == "fill":
        raise OSError(errno.ENOSPC, "no space left")
    return f"{task.asset_id} {os.environ['STARTED']}"


def outcomes_of(
    tasks: list[Sum],
    *,
    workers: int = 1,
    timeout_s: float = 20.0,
    told: Callable[[str], str] = lambda cause: cause,
) -> Iterator[str]:
    return run_in_processes(
        tasks,
        work,
        workers=workers,
        initializer=_nothing,
        initargs=(),
        timeout_s=timeout_s,
        lost=lambda task, cause: f"{task.asset_id} {told(cause)}",
    )


def test_every_task_has_one_outcome_whatever_its_neighbours_do(tmp_path: Path) -> None:
    deeds = ["work", "die", "work", "die once", "hang", "work"]
    tasks = [Sum(str(k), deed, str(tmp_path)) for k, deed in enumerate(deeds)]
    outcomes = outcomes_of(tasks, workers=2, timeout_s=5.0, told=lambda cause: "lost")
    assert sorted(outcomes) == ["0 1", "1 lost", "2 1", "3 1", "4 lost", "5 1"]
    assert len((tmp_path / "1").read_text()) >= ATTEMPTS
    assert len((tmp_path / "4").read_text()) == ATTEMPTS


def test_a_fault_that_no_one_foresaw_costs_its_own_task_alone(tmp_path: Path) -> None:
    """It once ended the run: the outcomes of all that came after were lost."""
    deeds = ["raise", "work", "work", "raise"]
    tasks = [Sum(str(k), deed, str(tmp_path)) for k, deed in enumerate(deeds)]
    outcomes = outcomes_of(tasks)
    told = "internal fault: RuntimeError('from a library')"
    assert sorted(outcomes) == [f"0 {told}", "1 1", "2 1", f"3 {told}"]
    assert (tmp_path / "0").read_text() == "x"  # The same again would come of a second try.


def test_a_full_disk_ends_the_run(tmp_path: Path) -> None:
    """Every task that follows would fail of it as well."""
    tasks = [Sum("0", "fill", str(tmp_path)), Sum("1", "work", str(tmp_path))]
    outcomes = outcomes_of(tasks)
    with pytest.raises(OSError, match="no space left"):
        list(outcomes)
