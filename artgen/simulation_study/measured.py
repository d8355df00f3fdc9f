"""One measurement: a setting's error against a trusted reference, and its price."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

T = TypeVar("T")

REPEATS = 3


@dataclass(frozen=True, kw_only=True)
class Measured:
    """One row of a study.

    Attributes:
        scene: what was simulated or swept.
        setting: what was varied, in words and numbers.
        step: the number that shrinks towards the truth (time step s, poses, pieces), or 0.
        error: against the reference, in `unit`.
        cpu_ms: CPU time of one run.
    """

    scene: str
    setting: str
    step: float
    error: float
    unit: str
    cpu_ms: float


def timed(run: Callable[[], T], repeats: int = REPEATS) -> tuple[T, float]:
    """What `run` returns, and its least CPU time in ms over some repeats; other processes' load
    can only lengthen one."""
    best = float("inf")
    for _ in range(repeats):
        started = time.process_time()
        result = run()
        best = min(best, time.process_time() - started)
    return result, 1e3 * best
