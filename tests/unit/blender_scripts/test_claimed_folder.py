"""Folders that appear whole: one winner of a race, nothing left behind, even by kill -9."""

import multiprocessing
import os
import signal
import socket
from multiprocessing.synchronize import Barrier, Event
from pathlib import Path

import pytest

from blender_scripts.claimed_folder import LOCK, claimed, publish, sweep

FILES = {f"{k}.bin": bytes([k]) * 1000 for k in range(20)}
SPAWN = multiprocessing.get_context("spawn")


def fill(folder: Path) -> None:
    for name, data in FILES.items():
        (folder / name).write_bytes(data)


def is_whole(folder: Path) -> bool:
    try:
        return {path.name: path.read_bytes() for path in folder.iterdir()} == FILES
    except FileNotFoundError:  # Another task just removes it.
        return False


def race(folder: Path, start: Barrier) -> None:
    with claimed(folder) as partial:
        fill(partial)
        start.wait()
        publish(partial, folder, taken=lambda: is_whole(folder))


@pytest.mark.parametrize("before", ["nothing", "empty", "damaged"])
def test_of_tasks_that_race_one_wins_and_all_succeed(tmp_path: Path, before: str) -> None:
    folder = tmp_path / "item"
    if before != "nothing":
        folder.mkdir()
    if before == "damaged":
        (folder / "3.bin").write_bytes(b"half")
    start = SPAWN.Barrier(3)
    tasks = [SPAWN.Process(target=race, args=(folder, start)) for _ in range(3)]
    for task in tasks:
        task.start()
    for task in tasks:
        task.join()
    assert [task.exitcode for task in tasks] == [0, 0, 0]
    assert is_whole(folder)
    assert list(tmp_path.iterdir()) == [folder]


def linger(folder: Path, half: Event) -> None:
    with claimed(folder) as partial:
        (partial / "0.bin").write_bytes(FILES["0.bin"])
        half.set()
        signal.pause()


def test_what_a_killed_task_left_is_swept_and_what_a_live_one_uses_is_not(tmp_path: Path) -> None:
    folder, half = tmp_path / "item", SPAWN.Event()
    task = SPAWN.Process(target=linger, args=(folder, half))
    task.start()
    half.wait()
    (hidden,) = tmp_path.iterdir()
    assert hidden.name.startswith(f".item.{socket.gethostname()}.")
    sweep(tmp_path, "item")
    assert list(tmp_path.iterdir()) == [hidden]
    os.kill(task.pid or 0, signal.SIGKILL)
    task.join()
    assert list(tmp_path.iterdir()) == [hidden]
    sweep(tmp_path, "item2")
    assert list(tmp_path.iterdir()) == [hidden]
    sweep(tmp_path, "item")
    assert not list(tmp_path.iterdir())


def test_other_machines_folders_are_left_alone(tmp_path: Path) -> None:
    """Whether their locks are held cannot be seen from here on every file system."""
    other = tmp_path / ".item.elsewhere.abc.partial"
    other.mkdir()
    (other / LOCK).touch()
    sweep(tmp_path, "item")
    assert other.is_dir()


def fail(folder: Path) -> None:
    with claimed(folder) as partial:
        fill(partial)
        raise ZeroDivisionError


def test_a_fault_leaves_nothing_behind(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError):
        fail(tmp_path / "item")
    assert not list(tmp_path.iterdir())
