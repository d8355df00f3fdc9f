"""A folder that appears whole: filled under a hidden name, renamed when done, swept when its filler
died."""

import errno
import glob
import os
import shutil
import socket
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: leftovers of killed tasks stay, which costs disk alone.
    fcntl = None

LOCK = ".lock"
ATTEMPTS = 5
"""Renames in the way of which others put the same folder."""


@contextmanager
def claimed(folder: Path) -> Iterator[Path]:
    """A new hidden folder beside `folder`, locked while in use; gone afterwards, unless published.

    Two tasks that fill the same folder have a hidden one each.
    """
    prefix = f".{folder.name}.{socket.gethostname()}."
    starting = Path(tempfile.mkdtemp(dir=folder.parent, prefix=prefix, suffix=".starting"))
    starting.chmod(0o755)  # Others read what a farm's user writes; mkdtemp would forbid it.
    partial = starting.with_suffix(".partial")
    with (starting / LOCK).open("w") as lock:
        if fcntl is not None:
            fcntl.flock(lock, fcntl.LOCK_EX)
        starting.rename(partial)  # Visible to `sweep` only now that it is locked.
        try:
            yield partial
        finally:
            shutil.rmtree(partial, ignore_errors=True)


def publish(partial: Path, folder: Path, *, taken: Callable[[], bool]) -> None:
    """Flush a filled folder to disk and rename it to `folder`, whole.

    Args:
        taken: another task has put a sound folder there, which is then kept.

    Raises:
        OSError: it cannot be renamed.
    """
    (partial / LOCK).unlink(missing_ok=True)
    for path in partial.iterdir():
        with path.open("rb+") as stream:
            os.fsync(stream.fileno())
    for _ in range(ATTEMPTS):
        try:
            partial.rename(folder)
            return
        except OSError as error:
            if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                raise
        if taken():
            return
        _remove(folder, partial.with_suffix(".stale"))
    raise OSError(errno.EBUSY, "other tasks keep putting damaged images there", str(folder))


def _remove(folder: Path, aside: Path) -> None:
    """Out of the way in one step, so that nobody finds it half removed."""
    try:
        folder.rename(aside)
    except FileNotFoundError:
        return  # Another task removed it.
    shutil.rmtree(aside, ignore_errors=True)


def sweep(out: Path, name: str) -> None:
    """Delete what tasks of this machine left of a folder when they were killed.

    A lock ends with the process that held it, even by kill -9. Locks of other machines may not be
    seen here, so their folders stay.
    """
    prefix = glob.escape(f".{name}.{socket.gethostname()}.")
    for partial in out.glob(f"{prefix}*.partial"):
        if _abandoned(partial / LOCK):
            shutil.rmtree(partial, ignore_errors=True)


def _abandoned(lock: Path) -> bool:
    if fcntl is None:
        return False
    try:
        with lock.open("r") as stream:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:  # Held, or not there: its task is about to publish.
        return False
    return True
