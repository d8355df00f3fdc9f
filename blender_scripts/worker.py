"""The job loop: one JSON job per line in, one JSON report per line out.

    python -m blender_scripts.worker --serve THREADS    jobs on stdin, reports on stdout
    python -m blender_scripts.worker JOB.json           one job, report on stdout
    blender -b --python-use-system-env -P blender_scripts/worker.py -- JOB.json

Blender talks on stdout as it likes, so file descriptor 1 is turned to stderr and the reports keep a
private copy of the real one.
"""

from blender_scripts.cores import widen  # isort: skip  (before bpy counts the cores)
import bpy  # isort: skip  (first: libraries that load another Embree before it break it)

import ctypes
import json
import logging
import os
import signal
import sys
import time
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TextIO

from blender_scripts import bevel, gltf, render
from blender_scripts.reports import private_stdout

log = logging.getLogger("blender_scripts.worker")

JOBS: Mapping[str, Callable[[Mapping[str, Any], int], dict[str, Any]]] = {
    "gltf": gltf.run,
    "render": render.run,
    "round": bevel.run,
}
"""Kind of job to what runs it: (job, render threads) -> report."""

PR_SET_PDEATHSIG = 1


def main(argv: list[str]) -> int:
    """Serve or run one job; 0, or 1 when the one job failed."""
    logging.basicConfig(level=logging.INFO, format="%(name)s: %(message)s")
    widen()
    arguments = argv[argv.index("--") + 1 :] if "--" in argv else argv[1:]
    reports = private_stdout()
    if arguments[0] == "--serve":
        die_with_parent()
        serve(sys.stdin, reports, int(arguments[1]))
        return 0
    report = execute(Path(arguments[0]).read_text(), os.cpu_count() or 1)
    print(json.dumps(report), file=reports, flush=True)
    return 0 if report["ok"] else 1


def die_with_parent() -> None:
    """Ask Linux to kill this process when the one that started it dies, even by kill -9."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def serve(jobs: TextIO, reports: TextIO, threads: int) -> None:
    """Report `ready`, then answer every line until the input ends."""
    print(json.dumps({"ok": True, "ready": bpy.app.version_string}), file=reports, flush=True)
    for line in jobs:
        print(json.dumps(execute(line, threads)), file=reports, flush=True)


def execute(text: str, threads: int) -> dict[str, Any]:
    """The report of one job: what it returned and its seconds, or the error in one line."""
    started = time.perf_counter()
    try:
        job = json.loads(text)
        result = JOBS[job["kind"]](job, threads)
    except Exception as error:
        log.exception("job failed")
        place = traceback.extract_tb(error.__traceback__)[-1]
        cause = f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"
        return {"ok": False, "error": cause}
    return {"ok": True, "seconds": time.perf_counter() - started, **result}


if __name__ == "__main__":
    sys.exit(main(sys.argv))
