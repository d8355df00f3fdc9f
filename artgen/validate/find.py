"""Assets at or below paths: which files are bundles, URDF, MJCF or USD."""

import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.export.layout import MANIFEST
from artgen.validate.subject import Source

SUFFIXES = {".urdf": "urdf", ".usd": "usd", ".usda": "usd", ".usdc": "usd", ".usdz": "usd"}
SNIFFED = 4096
"""Bytes of an .xml file that are read to learn its root element."""


def found_sources(paths: Sequence[Path], root: Path | None = None) -> list[Source]:
    """Every asset at or below the paths, in order and once each; a bundle's files count as one.

    Args:
        root: the folder outside of which foreign files may not read; each file's own if None.

    Raises:
        UsageError: there is no path, or one does not exist or holds no asset.
    """
    if not paths:
        raise UsageError("artgen validate needs a path, for example out/assets")
    found: dict[Path, Source] = {}
    for path in paths:
        own = list(_below(path, root) if path.is_dir() else _at(path, root))
        if not own:
            raise UsageError(
                f"{path} holds no {MANIFEST}, URDF, MJCF or USD; name a bundle, a file, or a "
                "folder that holds some"
            )
        found |= {source.file: source for source in own}
    return list(found.values())


def _at(path: Path, root: Path | None) -> Iterator[Source]:
    if not path.is_file():
        raise UsageError(f"{path} does not exist")
    if path.name == MANIFEST:
        yield Source(format="bundle", file=path, root=path.parent)
    elif (format_ := _format(path)) is not None:
        yield Source(format=format_, file=path, root=root or path.parent)


def _below(folder: Path, root: Path | None) -> Iterator[Source]:
    for place, folders, files in os.walk(folder):
        folders.sort()
        if MANIFEST in files:
            folders.clear()
            yield from _at(Path(place) / MANIFEST, root)
            continue
        for file in sorted(files):
            if (Path(place) / file).is_file():
                yield from _at(Path(place) / file, root)


def _format(path: Path) -> str | None:
    """urdf, mjcf, usd, or None where it is none of them."""
    if path.suffix.lower() != ".xml":
        return SUFFIXES.get(path.suffix.lower())
    with path.open("rb") as stream:
        start = re.sub(
            rb"<\?.*?\?>|<!--.*?-->|<!DOCTYPE.*?>", b"", stream.read(SNIFFED), flags=re.S
        )
    root = re.search(rb"<([A-Za-z]+)", start)
    return {b"mujoco": "mjcf", b"robot": "urdf"}.get(root.group(1)) if root else None
