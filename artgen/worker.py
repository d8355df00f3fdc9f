"""BlenderWorker: a Blender process that takes one job after another, watched and replaced."""

import json
import logging
import os
import selectors
import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import psutil

from artgen.core.errors import WorkerError
from artgen.core.jsonio import canonical_json

log = logging.getLogger(__name__)

RECYCLE_AFTER = 100
"""Jobs a process serves; memory was flat over 200 (399 to 401 MB), so this is caution."""
ATTEMPTS = 2
"""A job whose process died, hung or grew too big is tried once more in a fresh process."""
START_TIMEOUT_S = 120.0
"""Importing Blender takes 1.7 s warm; a cold disk and a busy machine take much longer."""
WATCH_EVERY_S = 0.1
DENOISER = {"OIDN_SET_AFFINITY": "0"}
"""OIDN pins its threads to the first cores unless told not to, so that all workers share one core;
and it takes all cores unless told how many, whatever Cycles is given."""
LOG_TAIL = 1500
"""Characters of the log that an error message quotes."""


class _Casualty(Exception):
    """The process died, hung or outgrew its limit; the job may be innocent."""


class BlenderWorker:
    """Runs jobs in a Blender process that is started when first needed.

    Args:
        log: file that receives Blender's own output; appended to.
        threads: render threads of the process.
        memory_limit_mb: resident size above which the process is killed.

    Start it from a thread that outlives it: Linux kills the process when that thread ends.
    """

    def __init__(self, log: Path, *, threads: int = 1, memory_limit_mb: float = 2000.0) -> None:
        self.log = log
        self.threads = threads
        self.memory_limit_mb = memory_limit_mb
        self._process: subprocess.Popen[bytes] | None = None
        self._served = 0
        self._pending = b""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()

    def run(self, job: Mapping[str, Any], *, timeout_s: float) -> dict[str, Any]:
        """The report of `job`, which must hold its `kind`.

        Raises:
            WorkerError: the job reported a fault, or killed its process twice.
        """
        line = canonical_json(job).encode() + b"\n"
        for attempt in range(1, ATTEMPTS + 1):
            try:
                report = self._attempt(line, timeout_s)
            except _Casualty as casualty:
                self.stop()
                log.warning("job %s, attempt %d: %s", job.get("kind"), attempt, casualty)
                cause = f"{casualty}; tried {attempt} times"
                continue
            except BaseException:
                self.stop()  # The report of a job that nobody waits for must not answer the next.
                raise
            if report["ok"]:
                return report
            self.stop()
            raise WorkerError(self._message(job, str(report["error"])))
        raise WorkerError(self._message(job, cause))

    def stop(self) -> None:
        """Kill the process, if there is one."""
        process, self._process, self._pending = self._process, None, b""
        if process is None:
            return
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                pipe.close()

    def _attempt(self, line: bytes, timeout_s: float) -> dict[str, Any]:
        if self._process is not None and self._served >= RECYCLE_AFTER:
            self.stop()
        process = self._process or self._start()
        self._served += 1
        if process.stdin is None:
            raise _Casualty("the process has no input pipe")
        try:
            process.stdin.write(line)
            process.stdin.flush()
        except OSError as error:
            raise _Casualty(f"the process no longer reads jobs ({error})") from error
        return self._report(process, timeout_s)

    def _start(self) -> subprocess.Popen[bytes]:
        self.log.parent.mkdir(parents=True, exist_ok=True)
        command = [sys.executable, "-m", "blender_scripts.worker", "--serve", str(self.threads)]
        environment = {**os.environ, **DENOISER, "OIDN_NUM_THREADS": str(self.threads)}
        with self.log.open("ab") as sink:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=sink,
                env=environment,
                start_new_session=True,  # Ctrl-C reaches us alone; we then stop the process.
            )
        self._served = 0
        self._report(self._process, START_TIMEOUT_S)
        return self._process

    def _report(self, process: subprocess.Popen[bytes], timeout_s: float) -> dict[str, Any]:
        """The next line that the process writes, as an object."""
        if process.stdout is None:
            raise _Casualty("the process has no output pipe")
        deadline = time.monotonic() + timeout_s
        with selectors.DefaultSelector() as selector:
            selector.register(process.stdout, selectors.EVENT_READ)
            while b"\n" not in self._pending:
                if selector.select(WATCH_EVERY_S):
                    chunk = os.read(process.stdout.fileno(), 1 << 16)
                    if not chunk:
                        raise _Casualty(_ending(process.wait()))
                    self._pending += chunk
                    continue
                self._check_memory(process.pid)
                if time.monotonic() > deadline:
                    raise _Casualty(f"no report after {timeout_s:g} s")
        line, _, self._pending = self._pending.partition(b"\n")
        return dict(json.loads(line))

    def _check_memory(self, pid: int) -> None:
        try:
            used = psutil.Process(pid).memory_info().rss / 2**20
        except psutil.NoSuchProcess:
            return  # Its closed pipe tells more.
        if used > self.memory_limit_mb:
            raise _Casualty(f"uses {used:.0f} MB, allowed {self.memory_limit_mb:g} MB")

    def _message(self, job: Mapping[str, Any], cause: str) -> str:
        tail = self.log.read_text(errors="replace")[-LOG_TAIL:] if self.log.exists() else ""
        kind = job.get("kind")
        return f"Blender job {kind!r} failed: {cause}; the log {self.log} ends with:\n{tail}"


def _ending(code: int) -> str:
    if code < 0:
        return f"the process was killed by {signal.Signals(-code).name}"
    return f"the process ended with exit code {code}"
