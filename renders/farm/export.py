"""Job files of render managers, from templates; frame k is item k of the manifest everywhere."""

import json
import os
import re
import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from string import Template

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes
from artgen.farm_manifest import count_items

TEMPLATES = resources.files("renders.farm") / "templates"
BLENDER = ("-b", "--factory-startup", "--python-exit-code", "1", "-P")
"""Without `--python-exit-code`, and before `-P`, Blender ends with 0 when a script raises."""


@dataclass(frozen=True, kw_only=True)
class JobFile:
    """What every manager is told.

    Attributes:
        manifest, blender, script: as the machines of the farm see them.
        chunk: items a task.

    Raises:
        UsageError: a value that no job file can hold.
    """

    manifest: Path
    blender: str
    script: Path
    chunk: int

    def __post_init__(self) -> None:
        if self.chunk < 1:
            raise UsageError(f"--chunk {self.chunk}: expected at least 1")
        for option, value in (("manifest", self.manifest), ("blender", self.blender)):
            if not str(value) or set(str(value)) & set('\n\r"'):
                raise UsageError(f"--{option} {value!r}: expected a name without quotes and breaks")

    @property
    def command(self) -> list[str]:
        """The program and its arguments, but for those that name items."""
        python = Path(self.blender).name.startswith("python")
        call = [self.blender, *(() if python else BLENDER), self.script.as_posix()]
        return [*call, *(() if python else ("--",)), "--manifest", self.place]

    @property
    def place(self) -> str:
        """The manifest, absolute: managers start tasks in folders of their own."""
        return self.manifest.absolute().as_posix()

    @property
    def name(self) -> str:
        """Of the job: the folder that holds the manifest, in letters that every manager takes."""
        return f"artgen-{re.sub(r'[^A-Za-z0-9_-]+', '_', self.manifest.absolute().parent.name)}"


class _Slots(Template):
    """`@{slot}`: the languages of job files use the dollar themselves."""

    delimiter = "@"


Fill = Callable[[JobFile, int, Path], Mapping[str, str]]
"""From a job, its number of items and the file to write to the text of each slot."""


def write_job(kind: str, job: JobFile, out: Path) -> list[Path]:
    """Write the files of a job; where they lie.

    Raises:
        UsageError: the manifest cannot be read.
    """
    items = count_items(job.manifest)
    written = []
    for template, suffix, fill in KINDS[kind]:
        text = (TEMPLATES / template).read_text(encoding="utf-8")
        path = out.with_name(f"{out.stem}{suffix}{out.suffix}") if suffix else out
        write_bytes(path, _Slots(text).substitute(fill(job, items, out)).encode())
        written.append(path)
    return written


def _python(job: JobFile, items: int, _: Path) -> dict[str, str]:
    return {
        "name": repr(job.name),
        "command": repr(job.command),
        "last": str(items - 1),
        "chunk": str(job.chunk),
    }


def _bash(job: JobFile, items: int, _: Path) -> dict[str, str]:
    return {
        "name": shlex.quote(job.name),
        "command": shlex.join(job.command),
        "last_task": str((items - 1) // job.chunk),
        "chunk": str(job.chunk),
    }


def _json(job: JobFile, items: int, _: Path) -> dict[str, str]:
    """JSON is JavaScript, and YAML, as it stands."""
    return {
        "name": json.dumps(job.name),
        "program": json.dumps(job.command[0]),
        "arguments": json.dumps(job.command[1:]),
        "items": str(items),
        "last": str(items - 1),
        "chunk": str(job.chunk),
    }


def _openjd(job: JobFile, items: int, out: Path) -> dict[str, str]:
    """The folder is a parameter, so that it can be mapped or uploaded; its default must be relative
    to the template."""
    folder, manifest = os.path.split(job.place)
    words = [f"{{{{Param.Farm}}}}/{manifest}" if w == job.place else w for w in job.command[1:]]
    return {
        **_json(job, items, out),
        "folder": json.dumps(Path(os.path.relpath(folder, out.absolute().parent)).as_posix()),
        "arguments": _listed(words),
    }


def _listed(words: Sequence[str]) -> str:
    return "\n".join(f"            - {json.dumps(word)}" for word in words)


def _deadline(job: JobFile, items: int, _: Path) -> dict[str, str]:
    """Deadline splits arguments at spaces, but for those in double quotes."""
    return {
        "name": job.name,
        "program": job.command[0],
        "arguments": " ".join(_quoted(word) for word in job.command[1:]),
        "last": str(items - 1),
        "chunk": str(job.chunk),
    }


def _quoted(word: str) -> str:
    return f'"{word}"' if " " in word else word


KINDS: Mapping[str, Sequence[tuple[str, str, Fill]]] = {
    "opencue": [("opencue.py.txt", "", _python)],
    "slurm": [("slurm.sh", "", _bash)],
    "flamenco": [("flamenco.js", "", _json)],
    "deadline": [
        ("deadline_job.txt", "", _deadline),
        ("deadline_plugin.txt", "_plugin", _deadline),
    ],
    "openjd": [("openjd.yaml", "", _openjd)],
}
"""Templates of each manager, what tells the second file's name from the first's, and what fills
the slots."""
