"""The Blender process under bad luck: killed, hung, grown, fed nonsense."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import psutil
import pytest

from artgen.core.errors import WorkerError
from artgen.core.jsonio import plain, write_json
from artgen.finish_jobs import RoundJob, write_bodies
from artgen.geometry.solid import box
from artgen.worker import BlenderWorker

pytestmark = pytest.mark.blender


def rounding(folder: Path, copies: int = 1) -> dict[str, str]:
    """A job of `copies` cubes, each of another size, so that none is a twin."""
    bodies = [box((0.1 + k * 1e-6,) * 3).trimesh() for k in range(copies)]
    write_bodies(
        folder / "in.npz", [(b.vertices, b.faces) for b in bodies], radius=[0.004] * copies
    )
    return plain(RoundJob(input=str(folder / "in.npz"), output=str(folder / "out.npz")))


def children_of(worker: BlenderWorker) -> list[psutil.Process]:
    """Processes that write to this worker's log."""
    return [c for c in psutil.Process().children() if _stderr_of(c) == str(worker.log)]


def _stderr_of(child: psutil.Process) -> str:
    try:
        return str(Path(f"/proc/{child.pid}/fd/2").readlink())
    except OSError:
        return ""


def killed_soon(worker: BlenderWorker, times: int) -> threading.Thread:
    """Kill the worker's process as soon as it is there, `times` times."""

    def strike() -> None:
        seen: set[int] = set()
        while len(seen) < times:
            for child in children_of(worker):
                if child.pid not in seen:
                    seen.add(child.pid)
                    os.kill(child.pid, signal.SIGKILL)
            time.sleep(0.01)

    thread = threading.Thread(target=strike, daemon=True)
    thread.start()
    return thread


def test_a_killed_process_is_replaced_and_the_job_done(tmp_path: Path) -> None:
    with BlenderWorker(tmp_path / "log") as worker:
        strike = killed_soon(worker, times=1)
        assert worker.run(rounding(tmp_path), timeout_s=60)["kept_sharp"] == []
        strike.join(timeout=1)
        assert not strike.is_alive()


def test_two_crashes_fail_the_job_and_spare_the_next(tmp_path: Path) -> None:
    with BlenderWorker(tmp_path / "log") as worker:
        killed_soon(worker, times=2)
        with pytest.raises(WorkerError, match=r"'round'.*SIGKILL; tried 2 times.*log"):
            worker.run(rounding(tmp_path), timeout_s=60)
        assert worker.run(rounding(tmp_path), timeout_s=60)["bodies"] == 1


def test_a_fault_inside_a_job_names_the_cause_at_once(blender: BlenderWorker) -> None:
    job = {"kind": "round", "input": "/nowhere/in.npz", "output": "/nowhere/out.npz"}
    with pytest.raises(WorkerError, match=r"FileNotFoundError.*/nowhere/in.npz"):
        blender.run(job, timeout_s=60)


def test_an_unknown_kind_is_a_fault(blender: BlenderWorker) -> None:
    with pytest.raises(WorkerError, match="KeyError: 'dance'"):
        blender.run({"kind": "dance"}, timeout_s=60)


def test_a_hanging_job_is_cut_off(tmp_path: Path) -> None:
    """2,000 different bodies take about a second; a tenth of that must not do."""
    with BlenderWorker(tmp_path / "log") as worker:
        with pytest.raises(WorkerError, match=r"no report after 0\.1 s; tried 2 times"):
            worker.run(rounding(tmp_path, copies=2000), timeout_s=0.1)
        assert worker.run(rounding(tmp_path), timeout_s=60)["bodies"] == 1


def test_a_process_above_its_memory_is_cut_off(tmp_path: Path) -> None:
    """Blender alone takes over 100 MB."""
    with (
        BlenderWorker(tmp_path / "log", memory_limit_mb=50) as worker,
        pytest.raises(WorkerError, match=r"uses \d+ MB, allowed 50 MB; tried 2 times"),
    ):
        worker.run(rounding(tmp_path, copies=2000), timeout_s=60)


def test_stopping_ends_the_process(tmp_path: Path) -> None:
    with BlenderWorker(tmp_path / "log") as worker:
        worker.run(rounding(tmp_path), timeout_s=60)
        (child,) = children_of(worker)
    assert not psutil.pid_exists(child.pid)


def test_the_process_dies_with_the_one_that_started_it(tmp_path: Path) -> None:
    """A killed run must leave no Blender behind that writes into the folder of the next."""
    rounding(tmp_path)
    program = f"""
import os, signal
from pathlib import Path
from artgen.worker import BlenderWorker
worker = BlenderWorker(Path({str(tmp_path / "log")!r}))
worker.run({{"kind": "round", "input": {str(tmp_path / "in.npz")!r},
            "output": {str(tmp_path / "out.npz")!r}}}, timeout_s=60)
print(worker._process.pid, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == -signal.SIGKILL
    orphan = int(done.stdout)
    deadline = time.monotonic() + 10.0
    while psutil.pid_exists(orphan) and psutil.Process(orphan).status() != "zombie":
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_one_job_file_runs_without_a_server(tmp_path: Path) -> None:
    write_json(tmp_path / "job.json", rounding(tmp_path))
    command = [sys.executable, "-m", "blender_scripts.worker", str(tmp_path / "job.json")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["bodies"] == 1


def test_an_equal_job_gives_equal_arrays_in_another_process(
    blender: BlenderWorker, tmp_path: Path
) -> None:
    job = rounding(tmp_path, copies=3)
    blender.run(job, timeout_s=60)
    first = dict(np.load(tmp_path / "out.npz"))
    with BlenderWorker(tmp_path / "log") as other:
        other.run(job, timeout_s=60)
    second = np.load(tmp_path / "out.npz")
    assert all(np.array_equal(first[name], second[name]) for name in first)
