"""One foreign object to one bundle: read, built, written, judged; and what became of it."""

import dataclasses
import os
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from artgen.core.errors import ArtgenError
from artgen.core.jsonio import fill_folder_atomically, write_json
from artgen.export import write_bundle
from artgen.ingest.build import Built, build
from artgen.ingest.foreign import ForeignObject
from artgen.ingest.grips import with_grips
from artgen.ingest.options import Options
from artgen.ingest.partnet.folder import read_partnet
from artgen.ingest.passages import with_passages
from artgen.ingest.static import read_static
from artgen.ingest.urdf import read_urdf
from artgen.pipeline import Toolbox
from artgen.run_folder import settled
from artgen.validate import Report, validate_bundle

Kind = Literal["partnet", "urdf", "static"]
Status = Literal["valid", "flawed", "refused"]
BROKEN = (ET.ParseError, ValueError, LookupError, TypeError, ArithmeticError, RecursionError)
"""What damaged input makes libraries raise beyond our own errors."""
MOST_SAID = 3
"""Findings that a line of the report quotes."""


@dataclass(frozen=True, kw_only=True)
class IngestTask:
    """One object of a run; `root` is the folder inside which its files may name others, where
    that is not its own."""

    kind: Kind
    path: Path
    asset_id: str
    options: Options
    root: Path | None = None


READERS: Mapping[Kind, Callable[[IngestTask], ForeignObject]] = {
    "partnet": lambda task: read_partnet(task.path),
    "urdf": lambda task: read_urdf(task.path, turn_deg=task.options.turn_deg, root=task.root),
    "static": lambda task: read_static(task.path, up=task.options.up, most=task.options.max_parts),
}
"""Kind of source to the function that reads one object of it."""


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What became of an object.

    Attributes:
        status: valid: no finding; flawed: a bundle whose report has findings about how the source
            moves or overlaps; refused: no bundle, or one that no simulator can use, set aside.
        message: one line: why it is flawed or refused.
        said: what was mended, dropped and doubted.
    """

    asset_id: str
    source: str
    status: Status
    category: str = ""
    parts: int = 0
    joints: int = 0
    message: str = ""
    said: Mapping[str, Any] = dataclasses.field(default_factory=dict)


def category_name(word: str) -> str:
    """A source's category as a name of ours: StorageFurniture is storage_furniture."""
    return slug(re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", word)) or "unknown"


def slug(text: str) -> str:
    """Lower-case ASCII letters, digits and single underscores: fit for file and link names."""
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")


def ingest(task: IngestTask, tools: Toolbox) -> Outcome:
    """Read, build, write and judge one object; a bundle lands in assets/, or in failed/ where no
    simulator can use it. Input that cannot be used is an outcome, not an error."""
    try:
        foreign = READERS[task.kind](task)
        category = category_name(foreign.category)
        built = build(foreign, task.options, asset_id=task.asset_id, category=category)
        return _written(task, built, tools)
    except ArtgenError as error:
        return refused(task, str(error))
    except OSError as error:
        return refused(task, f"{error.strerror or error}: {error.filename}")
    except MemoryError:
        return refused(task, "it takes more memory than there is")
    except BROKEN as error:
        return refused(task, f"its files cannot be understood: {error!r}")


def refused(task: IngestTask, message: str) -> Outcome:
    """The outcome of an object that cannot be used."""
    line = " ".join(message.split())
    return Outcome(
        asset_id=task.asset_id, source=str(task.path), status="refused", message=line[:500]
    )


def _written(task: IngestTask, built: Built, tools: Toolbox) -> Outcome:
    """The bundle on disk and its verdict."""
    obj, folder = with_grips(with_passages(built.obj)), tools.folder
    for spec, images in built.images:
        tools.textures.keep(spec, images)
    staged = folder.work / "staged" / f"{task.asset_id}_{os.getpid()}"
    reports: list[Report] = []

    def fill(partial: Path) -> None:
        write_bundle(obj, partial, library=tools.textures, worker=tools.blender)
        reports.append(validate_bundle(partial))
        write_json(partial / "report.json", reports[0].as_json())

    fill_folder_atomically(staged, fill)
    status, message = verdict(reports[0])
    homes = (
        folder.assets / obj.category / task.asset_id,
        folder.failed / obj.category / task.asset_id,
    )
    home, other = reversed(homes) if status == "refused" else homes
    settled(staged, home=home, other=other)
    keys = (
        "source", "licence", "scale", "joints_read", "grips_read", "mended", "dropped", "doubts",
        "art",
    )  # fmt: skip
    return Outcome(
        asset_id=task.asset_id,
        source=str(task.path),
        status=status,
        category=obj.category,
        parts=len(obj.parts),
        joints=len(obj.joints),
        message=message,
        said={key: obj.provenance[key] for key in keys},
    )


NEEDED = ("files", "structure", "mesh", "inertia", "compile")
"""Findings of these kinds keep a bundle from being used; others tell how the source is."""


def verdict(report: Report) -> tuple[Status, str]:
    """Status and one line that a report amounts to."""
    if report.ok:
        return "valid", ""
    grave = [f for f in report.findings if f.check.split(".")[0] in NEEDED]
    shown = (grave or list(report.findings))[:MOST_SAID]
    more = len(report.findings) - len(shown)
    line = "; ".join(str(finding) for finding in shown) + (f"; {more} more" if more else "")
    return ("refused" if grave else "flawed"), line
