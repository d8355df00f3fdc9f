"""Names of files in a stranger's asset: where they lead, and never outside its folder."""

from pathlib import Path, PurePosixPath

from artgen.core.errors import ExportError

MAX_MESH_BYTES = 64 * 2**20
"""A mesh for one part; the parts of 200 foreign assets had 2 MB at most."""


def inside(root: Path, base: Path, text: str) -> Path:
    """The file that `text` names, seen from the folder `base`.

    `package://NAME/REST` is REST inside `root` where the root's folder is called NAME, and
    NAME/REST inside it where not.

    Raises:
        ExportError: it is absolute, of another scheme, leads out of `root` (links followed), or is
            no file.
    """
    if text.startswith("package://"):
        name, _, rest = text.removeprefix("package://").partition("/")
        base, text = root, rest if root.resolve().name == name else f"{name}/{rest}"
    elif text.startswith("file://"):
        text = text.removeprefix("file://")
    if not text or "\0" in text or ":" in text or PurePosixPath(text).is_absolute():
        raise ExportError(f"{text!r} is no relative path; name files from the asset's folder")
    place = base / text.replace("\\", "/")
    try:
        found = place.resolve(strict=True)
    except (OSError, RuntimeError) as error:
        raise ExportError(f"{text!r} does not exist") from error
    if not found.is_relative_to(root.resolve()):
        raise ExportError(f"{text!r} leads out of the asset's folder; give that folder as --root")
    if not found.is_file():
        raise ExportError(f"{text!r} is no file")
    return found


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
