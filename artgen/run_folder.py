"""The output folder of a run: whose it is, what lies where, and the lock that admits one run."""

import json
import logging
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from filelock import FileLock, Timeout

from artgen import __version__
from artgen.core.errors import UsageError
from artgen.core.jsonio import write_json

SCHEMA = "artgen-run/1"
OURS = frozenset(
    {
        ".lock",
        "run.json",
        "assets",
        "failed",
        "bundles.json",
        "renders",
        "render_report.json",
        "samples",
        "shards",
        "catalog",
        "logs",
        "work",
        "summary.csv",
        "contact_sheet.png",
        "ingest_report.json",
        "ingest_report.txt",
    }
)
"""Names that a run may leave at the top of its folder."""


@dataclass(frozen=True)
class RunFolder:
    """Paths inside one output folder."""

    root: Path

    @property
    def assets(self) -> Path:
        """Bundles that passed: assets/<category>/<index>/."""
        return self.root / "assets"

    @property
    def failed(self) -> Path:
        """Bundles that did not: failed/<category>/<index>/, each with its report."""
        return self.root / "failed"

    @property
    def logs(self) -> Path:
        """run.log and the workers' own logs."""
        return self.root / "logs"

    @property
    def work(self) -> Path:
        """Scratch and caches; may be deleted between runs."""
        return self.root / "work"

    @property
    def summary(self) -> Path:
        """One line per asset."""
        return self.root / "summary.csv"

    @property
    def contact_sheet(self) -> Path:
        """All assets in one picture."""
        return self.root / "contact_sheet.png"


@contextmanager
def opened(root: Path, *, seed: int, need_bytes: int = 0) -> Iterator[RunFolder]:
    """The run folder, created or recognized, locked against a second run while in use.

    Raises:
        UsageError: another run holds it, it holds foreign files, another seed or schema, it cannot
            be written, or its disk has less than `need_bytes` left.
    """
    created = not root.exists()
    _make_writable(root)
    try:
        with locked(root):
            _recognise(root, seed)
            _check_space(root, need_bytes)
            yield RunFolder(root)
    finally:
        if created and {path.name for path in root.iterdir()} <= {".lock"}:
            shutil.rmtree(root)


@contextmanager
def locked(root: Path) -> Iterator[None]:
    """Hold the folder's lock; within one process it may be taken again.

    Raises:
        UsageError: another process holds it.
    """
    try:
        with FileLock(root / ".lock", timeout=0, is_singleton=True):
            yield
    except Timeout as error:
        raise UsageError(
            f"{root}: another artgen run is writing here; wait for it or choose another --out"
        ) from error


def settled(staged: Path, *, home: Path, other: Path) -> None:
    """Move a staged folder home by one rename; what stood there before is removed first, and what
    an earlier run left in the other place afterwards."""
    home.parent.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(home, ignore_errors=True)
    staged.rename(home)
    shutil.rmtree(other, ignore_errors=True)


def run_log(folder: RunFolder) -> logging.Logger:
    """The logger that appends to logs/run.log."""
    folder.logs.mkdir(parents=True, exist_ok=True)
    record = logging.getLogger(f"artgen.run.{folder.root.resolve()}")
    record.setLevel(logging.INFO)
    record.propagate = False
    if not record.handlers:
        handler = logging.FileHandler(folder.logs / "run.log", encoding="utf-8")
        handler.setFormatter(logging.Formatter("%(asctime)s %(message)s"))
        record.addHandler(handler)
    return record


def _make_writable(root: Path) -> None:
    try:
        root.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError) as error:
        raise UsageError(f"{root}: is a file; --out needs a folder") from error
    except OSError as error:
        raise UsageError(
            f"{root}: cannot be created ({error.strerror}); choose another --out"
        ) from error
    if not os.access(root, os.W_OK | os.X_OK):
        raise UsageError(f"{root}: not writable; choose another --out or mend its permissions")


def _recognise(root: Path, seed: int) -> None:
    """Write run.json into a new folder, or check that an old one is ours and of this seed."""
    record = root / "run.json"
    if foreign := sorted({path.name for path in root.iterdir()} - OURS):
        raise UsageError(
            f"{root}: holds {', '.join(foreign[:5])}, which artgen did not make; "
            "choose an empty or new folder"
        )
    if not record.exists():
        write_json(record, {"schema": SCHEMA, "seed": seed, "artgen": __version__})
        return
    try:
        found = json.loads(record.read_text(encoding="utf-8"))
    except ValueError as error:
        raise UsageError(
            f"{record}: not valid JSON ({error}); delete the folder or choose another"
        ) from error
    if found.get("schema") != SCHEMA:
        raise UsageError(
            f"{record}: schema {found.get('schema')!r}, this artgen writes {SCHEMA!r}; "
            "choose a new --out, old runs are not converted"
        )
    if found.get("seed") != seed:
        raise UsageError(
            f"{root}: was begun with seed {found.get('seed')}, not {seed}; "
            "use that seed or choose another --out"
        )


def _check_space(root: Path, need_bytes: int) -> None:
    free = shutil.disk_usage(root).free
    if free < need_bytes:
        raise UsageError(
            f"{root}: {free / 1e6:.0f} MB free, about {need_bytes / 1e6:.0f} MB needed; "
            "free some space or choose another --out"
        )
