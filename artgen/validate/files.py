"""L0: every file of the bundle is there, readable, unchanged, and named so that others find it."""

import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from artgen.core.jsonio import file_hash
from artgen.export.layout import MANIFEST, MJCF, URDF
from artgen.export.manifest import SCHEMA
from artgen.validate import bounds
from artgen.validate.report import Finding
from artgen.validate.shape import misshapen
from artgen.validate.stated import file_references
from artgen.validate.subject import Subject

REPORT = "report.json"


def readable(subject: Subject) -> Iterator[Finding]:
    """Manifest, URDF and MJCF can be parsed, and the manifest has our schema."""
    for file in (MANIFEST, URDF, MJCF):
        if (problem := _problem(subject, file)) is not None:
            yield Finding(
                check="files.readable",
                part=file,
                value=problem,
                bound="a readable file",
                message="the bundle is incomplete or was edited; export the asset anew",
            )


def _problem(subject: Subject, file: str) -> str | None:
    """What keeps a file from being read, or None."""
    try:
        if file == MANIFEST:
            return _manifest_problem(subject.manifest)
        tag = (subject.urdf if file == URDF else subject.mjcf).tag
        expected = "robot" if file == URDF else "mujoco"
        return None if tag == expected else f"root element <{tag}> instead of <{expected}>"
    except OSError as error:
        return f"cannot be opened: {error.strerror}"
    except (ET.ParseError, ValueError) as error:
        return f"cannot be parsed: {error}"


def _manifest_problem(manifest: object) -> str | None:
    if not isinstance(manifest, Mapping):
        return "is not a JSON object"
    if (schema := manifest.get("schema")) != SCHEMA:
        return f"schema {schema!r} instead of {SCHEMA!r}"
    if wrong := list(misshapen(manifest)):
        return f"{len(wrong)} keys are missing or of another kind: {', '.join(wrong[:5])}"
    return None


def hashes(subject: Subject) -> Iterator[Finding]:
    """Every file of the manifest is there with its bytes; nothing else is."""
    listed: Mapping[str, Mapping[str, Any]] = subject.manifest["files"]
    present = {p.relative_to(subject.folder).as_posix() for p in _files_below(subject.folder)}
    for path, entry in sorted(listed.items()):
        if path not in present:
            yield _file_finding("files.file", path, "missing", "present", "was deleted or never")
        elif (found := file_hash(subject.folder / path)) != entry.get("sha256"):
            expected = f"sha256 {str(entry.get('sha256'))[:12]}..."
            yield _file_finding("files.hash", path, found[:12], expected, "changed after it was")
    for path in sorted(present - set(listed) - {MANIFEST, REPORT}):
        yield _file_finding("files.file", path, "not listed", "listed in the manifest", "was not")
    yield from _budget(subject, present - {REPORT})


def _files_below(folder: Path) -> Iterable[Path]:
    return (path for path in folder.rglob("*") if path.is_file())


def _file_finding(check: str, path: str, value: str, bound: str, how: str) -> Finding:
    message = f"the file {how} written with this manifest; export the asset anew"
    return Finding(check=check, part=path, value=value, bound=bound, message=message)


def _budget(subject: Subject, present: set[str]) -> Iterator[Finding]:
    """The bundle stays within its count of files and bytes."""
    sizes = {path: (subject.folder / path).stat().st_size for path in present}
    largest = max(sizes, key=lambda path: sizes[path], default="")
    used = ((len(sizes), bounds.MAX_FILES), (sum(sizes.values()), bounds.MAX_BYTES))
    for value, bound in used:
        if value > bound.value:
            yield Finding(
                check="files.budget",
                part="bundle",
                value=float(value),
                bound=bound.at_most(),
                message=f"the largest file is {largest}; author boxes instead of hulls, "
                "or write smaller textures",
            )


def paths(subject: Subject) -> Iterator[Finding]:
    """Files are named relative to the bundle, stay inside it, exist, and have base names of their
    own: loaders drop folders, and then take one mesh for another."""
    named = {*file_references(subject.urdf), *file_references(subject.mjcf)}
    for path in sorted({*named, *subject.manifest["files"]}):
        pure = PurePosixPath(path)
        if pure.is_absolute() or ".." in pure.parts or ":" in path or "\\" in path:
            message = (
                "loaders resolve it differently or not at all; write it relative to the bundle"
            )
            yield Finding(
                check="files.path", part=path, value=path, bound="a relative path", message=message
            )
        elif path not in subject.manifest["files"]:
            yield _file_finding("files.file", path, "named", "listed in the manifest", "was not")
    stems = Counter(PurePosixPath(p).stem for p in named if p.endswith((".obj", ".stl")))
    for stem, count in sorted(stems.items()):
        if count > 1:
            message = "loaders that drop folders read one for the other; rename one"
            yield Finding(
                check="files.basename",
                part=stem,
                value=float(count),
                bound="1 file",
                message=message,
            )
