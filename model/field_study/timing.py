"""How long a computation takes: CPU time of this process, or time on a GPU until it is idle."""

import time
from collections.abc import Callable
from typing import TypeVar

import torch

T = TypeVar("T")

REPEATS = 2


def timed(run: Callable[[], T], device: str, repeats: int = REPEATS) -> tuple[T, float]:
    """What `run` returns, and its least time in ms over some repeats, the first of which warms up;
    other processes' load can only lengthen one."""
    best = float("inf")
    for number in range(repeats):
        started = _clock(device)
        result = run()
        spent = _clock(device) - started
        best = min(best, spent) if number or repeats == 1 else best
    return result, 1e3 * best


def _clock(device: str) -> float:
    if device == "cpu":
        return time.process_time()
    torch.cuda.synchronize(device)
    return time.perf_counter()
