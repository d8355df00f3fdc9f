"""Tasks over processes: outcomes as they come; one that dies or fails costs its own task alone."""

import errno
import logging
import multiprocessing
import signal
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import resource_tracker
from typing import Any, Protocol, TypeVar

from pebble import ProcessExpired, ProcessPool

log = logging.getLogger(__name__)

ATTEMPTS = 2
"""A task whose process died or hung is tried once more in a fresh one."""
BREAKS = 5
"""Rounds of fresh processes before those that keep dying are blamed on their tasks."""
FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""A disk, a quota or a file that is full: every task would fail of it."""


class Task(Protocol):
    """What can be sent to a process: picklable, with a name for messages."""

    @property
    def asset_id(self) -> str:
        """Which asset the task makes."""
        ...


T = TypeVar("T", bound=Task)
Outcome = TypeVar("Outcome")


def run_in_processes(
    tasks: Sequence[T],
    work: Callable[[T], Outcome],
    *,
    workers: int,
    initializer: Callable[..., None],
    initargs: tuple[Any, ...],
    timeout_s: float,
    lost: Callable[[T, str], Outcome],
) -> Iterator[Outcome]:
    """`work(task)` for every task in spawned processes, in the order of completion.

    Args:
        work: a function of a module; turns the expected faults of a task into its outcome.
        initializer: run once in each process with `initargs`.
        timeout_s: a process that works longer on one task is killed.
        lost: the outcome of a task whose process died in every attempt, or that raised what `work`
            did not expect, told the cause.

    Raises:
        OSError: a disk is full; what is made already stays.
    """
    faults: Counter[T] = Counter()
    waiting, breaks = list(tasks), 0
    while waiting:
        pool = ProcessPool(
            max_workers=max(1, min(workers, len(waiting))),
            initializer=initializer,
            initargs=initargs,
            context=multiprocessing.get_context("spawn"),
        )
        again: list[T] = []
        with _stopped_on_faults(pool):
            with _deaf_to_interrupts():
                futures = {
                    pool.schedule(work, args=(task,), timeout=timeout_s): task for task in waiting
                }
            for future in as_completed(futures):
                task = futures[future]
                try:
                    outcome = future.result()
                except (ProcessExpired, TimeoutError) as error:
                    faults[task] += 1
                    cause = str(error)
                except BrokenProcessPool as error:  # A process died before it said what it took.
                    cause = str(error)
                except Exception as error:  # What `work` did not foresee must not end the run.
                    yield lost(task, _unforeseen(task, error))
                    continue
                else:
                    yield outcome
                    continue
                log.warning("%s: %s", task.asset_id, cause)
                if faults[task] < ATTEMPTS and breaks < BREAKS:
                    again.append(task)
                else:
                    yield lost(task, f"its process died {ATTEMPTS} times: {cause}")
        waiting, breaks = again, breaks + 1


def _unforeseen(task: Task, error: Exception) -> str:
    """The cause that is told; a full disk, of which every task would fail, is raised."""
    if isinstance(error, OSError) and error.errno in FULL:
        raise error
    log.warning("%s: internal fault", task.asset_id, exc_info=error)
    return f"internal fault: {error!r}"


@contextmanager
def _stopped_on_faults(pool: ProcessPool) -> Iterator[None]:
    """Close the pool at the end; on a fault kill its processes, one that just starts included."""
    try:
        yield
        pool.close()
        pool.join()
    except BaseException:
        pool.stop()
        pool.join()
        for child in multiprocessing.active_children():
            child.kill()
            child.join()
        raise


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Threads begun here, and the processes they start, do not hear Ctrl-C: we stop them ourselves.

    A signal mask is inherited, so even a process that is still importing prints no traceback. The
    resource tracker of multiprocessing unblocks the signal when it starts, so it starts before.
    """
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
