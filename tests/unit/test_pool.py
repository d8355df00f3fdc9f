"""A process that dies costs its own task alone, after a second try."""

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

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
    return f"{task.asset_id} {os.environ['STARTED']}"


def test_every_task_has_one_outcome_whatever_its_neighbours_do(tmp_path: Path) -> None:
    deeds = ["work", "die", "work", "die once", "hang", "work"]
    tasks = [Sum(str(k), deed, str(tmp_path)) for k, deed in enumerate(deeds)]
    outcomes = run_in_processes(
        tasks,
        work,
        workers=2,
        initializer=_nothing,
        initargs=(),
        timeout_s=5.0,
        lost=lambda task, cause: f"{task.asset_id} lost",
    )
    assert sorted(outcomes) == ["0 1", "1 lost", "2 1", "3 1", "4 lost", "5 1"]
    assert len((tmp_path / "1").read_text()) >= ATTEMPTS
    assert len((tmp_path / "4").read_text()) == ATTEMPTS
