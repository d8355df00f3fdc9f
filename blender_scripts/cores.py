"""How many cores Blender believes in; import it before `bpy`.

Blender's thread pool counts the cores once, when `bpy` is imported, and keeps a thread spinning on
each that Cycles was not given: a render with one thread on two cores then burns twice the CPU time.
So a worker shows itself as many cores as it has threads during that import, and takes all of them
back afterwards; which core it runs on stays the scheduler's choice.
"""

import os
import sys
from pathlib import Path


def _narrowed() -> set[int]:
    """The cores of a worker that serves, which from here on sees one core for each thread."""
    if sys.argv[1:2] != ["--serve"] or sys.platform != "linux":
        return set()
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(cores)[: max(1, int(sys.argv[2]))])
    return cores


_CORES = _narrowed()


def widen() -> None:
    """Give every thread of this process the cores that it had before this module was imported."""
    for thread in Path("/proc/self/task").iterdir() if _CORES else ():
        os.sched_setaffinity(int(thread.name), _CORES)
