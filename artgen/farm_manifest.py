"""The manifest of a render farm: line k is all that a machine needs to render item k.

Standard library alone: Blender's own Python on a render farm need not have anything else.
"""

import hashlib
import json
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

from artgen.core.errors import RenderError, UsageError
from artgen.render_job import RenderJob

SCHEMA = "artgen-farm-item/1"
DONE = "done.json"
"""Written last among the files of an item: which images belong to it, their sizes and sha256."""


@dataclass(frozen=True, kw_only=True)
class Item:
    """One line of a manifest.

    Attributes:
        name: of the item and of the folder that receives its images.
        job: a RenderJob in plain JSON whose paths are relative to the manifest's folder, and whose
            own `folder` is empty.
        inputs: sha256 of every file that the job names, by its relative path.
        digest: sha256 of the line; images of another line are not images of this item.
    """

    name: str
    job: Mapping[str, Any]
    inputs: Mapping[str, str]
    digest: str

    @classmethod
    def stated(cls, name: str, job: Mapping[str, Any], inputs: Mapping[str, str]) -> Self:
        """An item from its contents."""
        line = _line(name, job, inputs)
        return cls(name=name, job=job, inputs=inputs, digest=_digest(line))

    @property
    def line(self) -> str:
        """As it stands in a manifest, without the end of line."""
        return _line(self.name, self.job, self.inputs)

    @property
    def files(self) -> list[str]:
        """Names of the images."""
        return [shot["file"] for shot in self.job["shots"]]

    def render_job(self, root: Path, folder: Path) -> RenderJob:
        """The job on this machine.

        Args:
            root: the manifest's folder.
            folder: an existing folder that receives the images.

        Raises:
            RenderError: an input is missing or not the one that was planned, or the job asks for
                what cannot be rendered.
        """
        for relative, expected in self.inputs.items():
            path = root / relative
            if not path.is_file():
                raise RenderError(f"{path} is missing; copy the whole folder {root}")
            if (found := file_digest(path)) != expected:
                raise RenderError(
                    f"{path} has sha256 {found[:12]}, planned was {expected[:12]}; copy it again"
                )
        job = RenderJob.from_plain(self.job)
        environment = job.rig.environment
        if environment is not None:
            environment = replace(environment, file=str((root / environment.file).resolve()))
        return replace(
            job,
            glb=str((root / job.glb).resolve()),
            folder=str(folder.resolve()),
            rig=replace(job.rig, environment=environment),
        )


def read_items(manifest: Path, wanted: Container[int]) -> Iterator[tuple[int, Item]]:
    """The wanted lines of a manifest, numbered from 0.

    Raises:
        UsageError: the manifest, or a wanted line of it, cannot be read.
    """
    with _opened(manifest) as lines:
        for number, line in enumerate(lines):
            if number in wanted:
                yield number, _item(line, f"{manifest}: line {number} (from 0)")


def count_items(manifest: Path) -> int:
    """How many lines a manifest has.

    Raises:
        UsageError: it cannot be read, or is empty.
    """
    with _opened(manifest) as lines:
        count = sum(1 for _ in lines)
    if count == 0:
        raise UsageError(f"{manifest}: is empty; write it anew with `artgen farm plan`")
    return count


def damage(folder: Path, item: Item) -> str | None:
    """What is wrong with the images of an item in `folder`; None where all is as it should be."""
    try:
        done = json.loads((folder / DONE).read_text(encoding="utf-8"))
        digest, images = done["item"], dict(done["images"])
    except FileNotFoundError:
        return f"{folder}: is not rendered"
    except (OSError, ValueError, KeyError, TypeError) as error:
        return f"{folder / DONE}: is damaged ({error})"
    if digest != item.digest:
        return f"{folder}: was rendered for another plan"
    if sorted(images) != sorted(item.files):
        return f"{folder / DONE}: names {len(images)} images, planned were {len(item.files)}"
    for name, expected in images.items():
        try:
            found = image_record(folder / name)
        except OSError as error:
            return f"{folder / name}: cannot be read ({error.strerror})"
        if found != expected:
            return f"{folder / name}: is not the image that was rendered"
    return None


def image_record(path: Path) -> dict[str, Any]:
    """Size in bytes and sha256 of an image, as `done.json` states them."""
    return {"bytes": path.stat().st_size, "sha256": file_digest(path)}


def file_digest(path: Path) -> str:
    """sha256 of a file's bytes, as 64 hex digits."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _opened(manifest: Path) -> Any:
    try:
        return manifest.open("rb")
    except OSError as error:
        raise UsageError(
            f"{manifest}: cannot be read ({error.strerror}); name the manifest.jsonl that "
            "`artgen farm plan` wrote"
        ) from error


def _item(line: bytes, where: str) -> Item:
    try:
        stated = json.loads(line)
        if stated["schema"] != SCHEMA:
            raise ValueError(f"schema {stated['schema']!r}, expected {SCHEMA}")
        return Item(
            name=_name(stated["name"]),
            job=dict(stated["job"]),
            inputs=dict(stated["inputs"]),
            digest=_digest(line.decode().rstrip("\r\n")),
        )
    except (ValueError, KeyError, TypeError) as error:
        raise UsageError(
            f"{where} is no item ({type(error).__name__}: {error}); write the manifest anew with "
            "`artgen farm plan`"
        ) from error


def _name(name: Any) -> str:
    """A name is one of a folder beside others: never a path, never hidden."""
    if not isinstance(name, str) or not name or name.startswith(".") or set(name) & set("/\\:"):
        raise ValueError(f"name {name!r} is no name for a folder")
    return name


def _line(name: str, job: Mapping[str, Any], inputs: Mapping[str, str]) -> str:
    stated = {"schema": SCHEMA, "name": name, "job": job, "inputs": inputs}
    return json.dumps(stated, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _digest(line: str) -> str:
    return hashlib.sha256(line.encode()).hexdigest()
