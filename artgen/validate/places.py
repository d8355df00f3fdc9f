"""Names of files in a stranger's asset: where they lead, and never outside its folder."""

from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from artgen.core.errors import ExportError

MAX_MESH_BYTES = 64 * 2**20
"""A mesh for one part; the parts of 200 foreign assets had 2 MB at most."""


def inside(root: Path, base: Path, text: str) -> Path:
    """The file that `text` names, seen from the folder `base`.

    `package://NAME/REST` is REST inside the nearest folder called NAME that holds it, among `base`,
    the folders above it up to `root`, and what lies beside them: the layout of ROS packages.

    Raises:
        ExportError: it is absolute, of another scheme, leads out of `root` (links followed), or is
            no file.
    """
    package = ""
    if text.startswith("package://"):
        package, _, text = text.removeprefix("package://").partition("/")
    elif text.startswith("file://"):
        text = text.removeprefix("file://")
    odd = any(letter in package + text for letter in "\0:")
    if not text or odd or PurePosixPath(text).is_absolute():
        raise ExportError(f"{text!r} is no relative path; name files from the asset's folder")
    text = text.replace("\\", "/")
    bases = [*_packages(root, base, package)] if package else [base]
    found = next(filter(None, (_resolved(own / text) for own in bases)), None)
    if found is None:
        raise ExportError(f"{text!r} does not exist")
    if not found.is_relative_to(root.resolve()):
        raise ExportError(
            f"{text!r} leads out of the asset's folder {root.absolute().name!r}; commands for URDF "
            "files take a wider one as --root"
        )
    if not found.is_file():
        raise ExportError(f"{text!r} is no file")
    return found


def _resolved(place: Path) -> Path | None:
    """Where a path leads, links followed; None where nothing is there."""
    try:
        return place.resolve(strict=True)
    except (OSError, RuntimeError):  # Also names that are too long, and links in a circle.
        return None


def _packages(root: Path, base: Path, name: str) -> Iterator[Path]:
    """Where a package may lie, the nearest first; one that is nowhere would lie in `root`."""
    whole, own = root.absolute(), base.absolute()
    if not own.is_relative_to(whole):  # One of them was named through a link.
        whole, own = root.resolve(), base.resolve()
    for place in (own, *own.parents):
        if place.is_relative_to(whole):
            if name in (place.name, place.resolve().name):
                yield place
            yield place / name
    yield root / name


def read_capped(path: Path, most: int = MAX_MESH_BYTES) -> bytes:
    """The bytes of a file.

    Raises:
        ExportError: there are more than `most`.
        OSError: it cannot be opened.
    """
    with path.open("rb") as stream:
        data = stream.read(most + 1)
    if len(data) > most:
        raise ExportError(f"{path.name} holds more than {most} bytes; decimate it")
    return data
