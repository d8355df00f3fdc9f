"""Progress of long work: a bar with counts, rate and ETA on a terminal, a line now and then
elsewhere."""

import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

PLAIN_INTERVAL_S = 15.0
"""Seconds between lines when the output is not a terminal."""


Show = Callable[[str, int], AbstractContextManager[Callable[[str], None]]]
"""`progress`, or `silent`: what long work takes to report on itself."""


@contextmanager
def silent(title: str, total: int) -> Iterator[Callable[[str], None]]:
    """As `progress`, but nothing is shown."""
    yield lambda note: None


@contextmanager
def progress(title: str, total: int) -> Iterator[Callable[[str], None]]:
    """Yield a function to call once per finished item with a word about it."""
    console = Console(stderr=True)
    if console.is_terminal:
        with _bar(console) as bar:
            task = bar.add_task(title, total=total, rate="", note="")
            started = time.perf_counter()

            def advance(note: str) -> None:
                done = bar.tasks[0].completed + 1
                rate = 60.0 * done / (time.perf_counter() - started)
                bar.update(task, advance=1, rate=f"{rate:.1f}/min", note=note)

            yield advance
    else:
        yield _plain(console, title, total)


def _bar(console: Console) -> Progress:
    return Progress(
        TextColumn("{task.description:<10}"),
        BarColumn(bar_width=30),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeElapsedColumn(),
        TextColumn("ETA"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[note]}", markup=False),
        console=console,
    )


def _plain(console: Console, title: str, total: int) -> Callable[[str], None]:
    started = time.perf_counter()
    done, spoken = 0, started

    def advance(note: str) -> None:
        nonlocal done, spoken
        done += 1
        now = time.perf_counter()
        if done < total and now - spoken < PLAIN_INTERVAL_S:
            return
        spoken = now
        rate = done / max(now - started, 1e-9)
        left = (total - done) / rate
        console.print(
            f"{title}: {done}/{total}, {60.0 * rate:.1f}/min, ETA {left:.0f} s, last {note}",
            highlight=False,
            markup=False,  # Notes hold paths, which may hold brackets.
            soft_wrap=True,
        )

    return advance
