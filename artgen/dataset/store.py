"""Where shards lie: a local folder, or a prefix of an object store such as S3."""

import importlib
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from artgen.core.errors import ShardError, UsageError

Range = tuple[int, int]
"""Offset and size, bytes."""

NEAR = 1024
"""Ranges that are fewer bytes apart are read at once: between two members of a tar lie at most 511
bytes of padding and a header of 512."""


class Store(Protocol):
    """Files side by side; what readers need of a place, and no more."""

    def where(self, name: str = "") -> str:
        """A file's place, or that of them all, for messages."""

    def sizes(self) -> Mapping[str, int]:
        """Name to size of every file, sorted by name."""

    def size(self, name: str) -> int | None:
        """Of one file, bytes; None where it is not there."""

    def read(self, name: str) -> bytes:
        """A whole file.

        Raises:
            FileNotFoundError: it is not there.
        """

    def ranges(self, name: str, ranges: Sequence[Range]) -> list[bytes]:
        """The bytes of each range of a file; fewer where the file ends before.

        Raises:
            FileNotFoundError: it is not there.
        """


class Target(Store, Protocol):
    """A store to publish to."""

    def put(self, name: str, content: bytes | Path) -> None:
        """Write a file, replacing an older one; readers see all of it or nothing."""

    def put_new(self, name: str, content: bytes) -> bool:
        """Write a file unless there is one; whether it was written."""


@dataclass(frozen=True)
class LocalStore:
    """A folder; `ranges` reads with `pread`, near ranges at once."""

    folder: Path

    def where(self, name: str = "") -> str:
        """Path in the file system."""
        return str(self.folder / name)

    def sizes(self) -> Mapping[str, int]:
        """Of the files in the folder, not below it."""
        found = sorted(path for path in self.folder.glob("*") if path.is_file())
        return {path.name: path.stat().st_size for path in found}

    def size(self, name: str) -> int | None:
        """Of a file in the folder."""
        path = self.folder / name
        return path.stat().st_size if path.is_file() else None

    def read(self, name: str) -> bytes:
        """A whole file."""
        return (self.folder / name).read_bytes()

    def ranges(self, name: str, ranges: Sequence[Range]) -> list[bytes]:
        """One `pread` for each run of near ranges."""
        found: dict[Range, bytes] = {}
        handle = os.open(self.folder / name, os.O_RDONLY)
        try:
            for run in runs(ranges):
                start, stop = run[0][0], max(offset + size for offset, size in run)
                data = os.pread(handle, stop - start, start)
                found |= {(at, size): data[at - start : at - start + size] for at, size in run}
        finally:
            os.close(handle)
        return [found[wanted] for wanted in ranges]


def runs(ranges: Sequence[Range]) -> Iterator[list[Range]]:
    """Ranges in ascending order, cut where more than NEAR bytes lie between two."""
    run: list[Range] = []
    stop = 0
    for offset, size in sorted(set(ranges)):
        if run and offset > stop + NEAR:
            yield run
            run = []
        run.append((offset, size))
        stop = max(stop, offset + size)
    if run:
        yield run


def opened_store(place: Path | str) -> Store:
    """The store at a folder's path or at a URL such as `s3://bucket/prefix`.

    Raises:
        UsageError: a URL is given and the `s3` extra is not installed.
    """
    return opened_target(str(place)) if "://" in str(place) else LocalStore(Path(place))


def opened_target(url: str) -> Target:
    """The object store at a URL such as `s3://bucket/prefix`.

    Raises:
        UsageError: it is no URL, or the `s3` extra is not installed.
    """
    if "://" not in url:
        raise UsageError(f"{url}: is no URL; expected one such as s3://bucket/prefix")
    try:
        module = importlib.import_module("artgen.dataset.object_store")
    except ModuleNotFoundError as error:
        raise UsageError(
            f"{url}: object stores need {error.name}; install it with `pip install 'artgen[s3]'`"
        ) from error
    target: Target = module.ObjectStore(url.rstrip("/"))
    return target


def split_place(shard: Path | str) -> tuple[Store, str]:
    """The store that holds a file, and the file's name there."""
    folder, _, name = str(shard).rpartition("/")
    if not name:
        raise ShardError(f"{shard}: names a folder, expected a file in it")
    return opened_store(folder if folder or not str(shard).startswith("/") else "/"), name
