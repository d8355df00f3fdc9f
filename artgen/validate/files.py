"""L0: every file of the asset is there, readable, unchanged, and named so that others find it."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from artgen.core.jsonio import file_hash
from artgen.export.layout import MANIFEST, REPORT
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.report import Finding
from artgen.validate.stated import file_references
from artgen.validate.subject import Subject

EXPORT_ANEW = "export the asset anew"


def readable(subject: Subject) -> Iterator[Finding]:
    """The files that describe the asset can be parsed, and are of the kind that they claim."""
    for file, problem in subject.problems():
        yield Finding(
            check="files.readable",
            part=file,
            value=problem,
            bound="a readable file",
            cause="the asset is incomplete or was edited",
            remedy=EXPORT_ANEW,
        )


def hashes(subject: BundleSubject) -> Iterator[Finding]:
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
    return Finding(
        check=check,
        part=path,
        value=value,
        bound=bound,
        cause=f"the file {how} written with this manifest",
        remedy=EXPORT_ANEW,
    )


def _budget(subject: BundleSubject, present: set[str]) -> Iterator[Finding]:
    """The bundle stays within its count of files and bytes; a stranger's has as many as it has."""
    if subject.origin.foreign:
        return
    sizes = {path: (subject.folder / path).stat().st_size for path in present}
    largest = max(sizes, key=lambda path: sizes[path], default="")
    bounds = subject.bounds
    used = ((len(sizes), bounds.max_files), (sum(sizes.values()), bounds.max_bytes))
    for value, bound in used:
        if value > bound.value:
            yield Finding(
                check="files.budget",
                part="bundle",
                value=float(value),
                bound=bound.at_most(),
                cause=f"the largest file is {largest}",
                remedy="author boxes instead of hulls, or write smaller textures",
            )


def paths(subject: BundleSubject) -> Iterator[Finding]:
    """Files are named relative to the bundle, stay inside it, exist, and have base names of their
    own: loaders drop folders, and then take one mesh for another."""
    named = {*file_references(subject.urdf), *file_references(subject.mjcf)}
    for path in sorted({*named, *subject.manifest["files"]}):
        pure = PurePosixPath(path)
        if pure.is_absolute() or ".." in pure.parts or ":" in path or "\\" in path:
            yield _path_finding(path, "write it relative to the bundle")
        elif path not in subject.manifest["files"]:
            yield _file_finding("files.file", path, "named", "listed in the manifest", "was not")
    yield from twins(p for p in named if p.endswith((".obj", ".stl")))


def _path_finding(path: str, remedy: str) -> Finding:
    return Finding(
        check="files.path",
        part=path,
        value=path,
        bound="a relative path",
        cause="loaders resolve it differently or not at all",
        remedy=remedy,
    )


def twins(named: Iterable[str]) -> Iterator[Finding]:
    """Meshes in different folders whose base names are equal."""
    stems = Counter(PurePosixPath(path).stem for path in set(named))
    for stem, count in sorted(stems.items()):
        if count > 1:
            yield Finding(
                check="files.basename",
                part=stem,
                value=float(count),
                bound="1 file",
                cause="loaders that drop folders read one for the other",
                remedy="rename one",
            )
