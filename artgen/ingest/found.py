"""Which objects lie at paths: folders of PartNet-Mobility, URDF files, static meshes."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.ingest.task import Kind, slug

MARKS = ("mobility_v2.json", "mobility.urdf", "meta.json", "result.json")
"""A folder with one of these is an object's, or claims to be."""
ARCHIVES = (
    ".zip", ".tar", ".gz", ".tgz", ".bz2", ".tbz", ".xz", ".txz", ".zst", ".7z", ".rar",
)  # fmt: skip
NO_FOLDERS = (
    f"holds no object folder (with {MARKS[0]}); name one such as partnet-mobility/45940, or the "
    "folder that holds them"
)
MISSING = "does not exist; check the path"
PREFIX = {"partnet": "pm", "urdf": "urdf", "static": "static"}


@dataclass(frozen=True, kw_only=True)
class Found:
    """An object's place; `problem` says why it cannot be read at all, `root` inside which folder
    its files may name others, None where that is its own."""

    path: Path
    problem: str | None = None
    root: Path | None = None


def found_folders(paths: Sequence[Path]) -> list[Found]:
    """Object folders at paths, or one level below them; what is none is told, not passed over.

    Raises:
        UsageError: there is no path.
    """
    if not paths:
        raise UsageError("artgen ingest partnet needs a folder, for example ~/partnet-mobility")
    return _once(entry for path in paths for entry in _folders(path))


def _folders(path: Path) -> Iterator[Found]:
    if not path.is_dir():
        yield Found(path=path, problem=_no_folder(path))
    elif _marked(path):
        yield Found(path=path)
    else:
        inner = [p for p in sorted(path.iterdir()) if not p.name.startswith(".")]
        found = [entry for place in inner if (entry := _claimed(place, path)) is not None]
        nothing = Found(path=path, problem=NO_FOLDERS)
        yield from found or [nothing]


def _claimed(place: Path, path: Path) -> Found | None:
    """What lies in a folder of many: folders, and what should have been some; None for other files
    that may lie there."""
    if place.is_dir():
        away = place.is_symlink() and not _within(place, path)
        problem = f"a link that leaves {path}; name it on its own" if away else None
        return Found(path=place, problem=problem)
    if _broken(place) or place.suffix.lower() in ARCHIVES:
        return Found(path=place, problem=_no_folder(place))
    return None


def _broken(place: Path) -> bool:
    """Whether it is a link that leads nowhere."""
    return place.is_symlink() and not place.exists()


def _marked(path: Path) -> bool:
    return any((path / name).exists() for name in MARKS)


def _within(place: Path, root: Path) -> bool:
    return place.resolve().is_relative_to(root.resolve())


def _no_folder(path: Path) -> str:
    if not path.exists():
        return "is a link that leads nowhere" if path.is_symlink() else MISSING
    return f"is a file ({path.suffix or 'no suffix'}), not a folder; unpack it first"


def found_files(
    paths: Sequence[Path], suffixes: Sequence[str], root: Path | None = None
) -> list[Found]:
    """Files of some kinds at or below paths; each may name others inside `root`, by default inside
    the path below which it was found.

    Raises:
        UsageError: there is no path, or `root` is no folder.
    """
    if not paths:
        raise UsageError(f"name a file ({', '.join(suffixes)}) or a folder that holds some")
    if root is not None and not root.is_dir():
        raise UsageError(f"--root {root} is no folder")
    return _once(entry for path in paths for entry in _files(path, suffixes, root))


def _files(path: Path, suffixes: Sequence[str], root: Path | None) -> Iterator[Found]:
    if path.is_dir():
        named = [p for p in sorted(path.rglob("*")) if p.suffix.lower() in suffixes]
        inner = [place for place in named if place.is_file() or _broken(place)]
        for place in inner:
            yield Found(path=place, problem=_astray(place, path), root=root or path)
        if not inner:
            yield Found(path=path, problem=f"holds no {', '.join(suffixes)} at any depth")
    elif not path.exists():
        yield Found(path=path, problem=MISSING)
    elif path.suffix.lower() not in suffixes:
        yield Found(path=path, problem=f"is no {', '.join(suffixes)}")
    else:
        yield Found(path=path, root=root)


def _astray(place: Path, path: Path) -> str | None:
    if _broken(place):
        return "is a link that leads nowhere"
    return None if _within(place, path) else f"a link that leaves {path}"


def _once(entries: Iterator[Found]) -> list[Found]:
    """Each place once, in order, however often and by whatever spelling it is named."""
    places: dict[str, Found] = {}
    for entry in entries:
        path = entry.path
        places.setdefault(os.path.realpath(path) if path.exists() else str(path.absolute()), entry)
    return list(places.values())


def named(found: Sequence[Found], kind: Kind) -> list[tuple[str, Found]]:
    """Objects with names of their own, made from the names of their folders or files; twins are
    numbered in the order of the paths."""
    taken: set[str] = set()
    listed = []
    for entry in found:
        name = f"{PREFIX[kind]}_{slug(_own_name(entry.path))}"
        number, own = 1, name
        while own in taken:
            number += 1
            own = f"{name}_{number}"
        taken.add(own)
        listed.append((own, entry))
    return listed


def _own_name(path: Path) -> str:
    """A folder's name; of a file, with that of its folder, as many files are called alike."""
    own = Path(os.path.normpath(path.absolute()))
    return f"{own.parent.name}_{own.stem}" if own.is_file() else own.name
