"""The embedded library, built once a machine: kept in a cache folder, checked before it is used."""

import logging
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from artgen.assembly.build import build_library
from artgen.assembly.harvest import embedded
from artgen.core.errors import ArtgenError
from artgen.core.jsonio import content_hash, file_hash, plain, read_object, write_json
from artgen.export.manifest import versions
from artgen.progress import Show

log = logging.getLogger(__name__)

PLACE = "ARTGEN_CACHE"
"""Environment variable that names the cache folder."""
ROOT = Path(__file__).parents[2]
"""Where our packages lie."""
MADE_BY = ("artgen", "blender_scripts", "category_rules")
"""Packages whose files decide what the embedded library is."""
SUMS = "files.json"
"""In a kept library: the hash of every other file, written last."""
MOST = 4
"""Libraries that stay, those used last; others go once they are idle."""
IDLE_S = 3600.0
"""By how much longer than the newest a library has not been used before it may go."""


def cache_folder(environment: Mapping[str, str]) -> Path | None:
    """Where this machine's user keeps what programs can make again: $ARTGEN_CACHE, or artgen/ in
    $XDG_CACHE_HOME or ~/.cache (XDG base directories, which ignore relative paths); None where
    there is no such place."""
    if own := environment.get(PLACE):
        return Path(own)
    given, home = (environment.get(name, "") for name in ("XDG_CACHE_HOME", "HOME"))
    if Path(given).is_absolute():
        return Path(given) / "artgen"
    return Path(home) / ".cache" / "artgen" if Path(home).is_absolute() else None


def embedded_library(
    cache: Path | None, *, own: Path, workers: int, show: Show, sharp: bool = False
) -> Path:
    """The embedded library, built in the cache folder unless it is there whole.

    Its folder is named by all that it depends on. It appears under that name by one rename, when
    every file of it is written; one whose files are not what they were then is built anew. Of two
    processes that need it at once, the second waits for the first.

    Args:
        cache: shared by all runs of this machine's user; None for no such place.
        own: folder of the run, used where the cache cannot be written.

    Raises:
        ArtgenError: one of its sources could not be made; it is never used in part.
    """
    name = f"library-{made_of()[:16]}" + "-sharp" * sharp
    if cache is not None and is_whole(cache / name):
        _used(cache / name)
        return cache / name
    place = cache if cache is not None and _writable(cache) else own
    place.mkdir(parents=True, exist_ok=True)
    with _alone(place / f"{name}.lock"):
        if not is_whole(place / name):
            _build(place / name, workers=workers, show=show, sharp=sharp)
    _forget_idle(place, place / name)
    return place / name


def made_of() -> str:
    """Hash of all that the embedded library depends on: the sources of what builds it, its
    categories and seed, and the versions of the libraries that shape it."""
    files = {
        path.relative_to(ROOT).as_posix(): file_hash(path)
        for package in MADE_BY
        for path in (ROOT / package).rglob("*")
        if path.suffix in (".py", ".toml")
    }
    return content_hash([versions(), [plain(one) for one in embedded()], files])


def is_whole(home: Path) -> bool:
    """Whether a kept library is there with every file as it was written."""
    try:
        sums = read_object(home / SUMS, remedy="build it anew")
        return sums == _sums(home)
    except (ArtgenError, OSError):
        return False


def _sums(home: Path) -> dict[str, str]:
    return {
        path.relative_to(home).as_posix(): file_hash(path)
        for path in home.rglob("*")
        if path.is_file() and path != home / SUMS
    }


def _build(home: Path, *, workers: int, show: Show, sharp: bool) -> None:
    """Build beside the place, then rename; an interrupted build goes on."""
    partial = home.with_name(f"{home.name}.partial")
    _, faults = build_library(
        partial, made=embedded(), bundles=(), workers=workers, show=show, sharp=sharp
    )
    if faults:
        raise ArtgenError(
            f"{partial}: {len(faults)} sources of the embedded library are missing "
            f"({faults[0].task}: {faults[0].fault}); run again to make them"
        )
    shutil.rmtree(partial / "scratch", ignore_errors=True)
    write_json(partial / SUMS, _sums(partial))
    shutil.rmtree(home, ignore_errors=True)
    partial.rename(home)


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """Hold the lock at a path; where another process holds it, say so and wait."""
    lock = FileLock(path)
    try:
        lock.acquire(timeout=0)
    except Timeout:
        log.warning("another artgen builds %s; waiting for it", path.with_suffix(""))
        lock.acquire()
    try:
        yield
    finally:
        lock.release()


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK | os.X_OK)


def _used(home: Path) -> None:
    """Note that a library was used; no matter where nothing may be written there."""
    with suppress(OSError):
        os.utime(home)


def _forget_idle(place: Path, newest: Path) -> None:
    """Remove libraries of other code that have not been used for a while, finished or not."""
    _used(newest)
    now = newest.stat().st_mtime
    others = [path for path in place.glob("library-*") if path.is_dir() and path != newest]
    others.sort(key=lambda path: path.stat().st_mtime, reverse=True)
    for path in others[MOST - 1 :]:
        if now - path.stat().st_mtime > IDLE_S:
            shutil.rmtree(path, ignore_errors=True)
